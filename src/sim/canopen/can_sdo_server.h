// One SDO server of a simulated node: expedited and segmented transfers, block upload (CiA 301 7.2.4).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "sim/canopen/can_object.h"

namespace nord_driver::sim {

/// The eight bytes of a request or an answer.
using SdoBytes = std::array<std::uint8_t, 8>;

class CanSdoServer {
 public:
  /// The answer, if the request gets one: it gets none while segments of a block are sent, and none to an abort.
  std::optional<SdoBytes> handle(const SdoBytes& request, CanObjects& objects) noexcept;
  /// Forgets a transfer that was begun.
  void reset() noexcept { transfer_ = Transfer::kNone; }

  /// The object the last initiate request named.
  ObjectId object() const noexcept { return id_; }

 private:
  enum class Transfer : std::uint8_t { kNone, kUpload, kDownload };

  SdoBytes initiateDownload(const SdoBytes& request, CanObjects& objects) noexcept;
  SdoBytes downloadSegment(const SdoBytes& request, CanObjects& objects) noexcept;
  SdoBytes initiateUpload(CanObjects& objects) noexcept;
  SdoBytes uploadSegment(const SdoBytes& request) noexcept;
  SdoBytes abort(SdoAbort code) noexcept;
  SdoBytes head(unsigned command) const noexcept;
  void name(const SdoBytes& request) noexcept;

  ObjectId id_;
  Transfer transfer_ = Transfer::kNone;
  bool toggle_ = false;
  ObjectBytes buffer_;
  std::size_t position_ = 0;  // of an upload
  std::size_t expected_ = 0;  // of a download, when the client told; else 0
};

}  // namespace nord_driver::sim
