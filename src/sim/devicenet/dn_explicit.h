// Explicit messages of a simulated module as frames: requests put together, answers taken apart, every fragment
// acknowledged, repeated once, then given up.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "sim/devicenet/dn_identifiers.h"
#include "sim/devicenet/dn_objects.h"

namespace nord_driver::sim {

using DnFrameData = FixedBytes<8>;

/// Service, class, instance and what follows of one request; its header without the fragment bit.
struct DnRequest {
  std::uint8_t header = 0;
  CipBytes body;
};

/// Puts requests together.
class DnExplicitReceiver {
 public:
  struct Heard {
    std::optional<DnFrameData> acknowledge;  ///< to be sent at once
    bool complete = false;                   ///< `request()` is one
    bool acknowledged = false;               ///< it was the master's acknowledge of this count
    std::uint8_t count = 0;
  };
  Heard receive(ByteView data) noexcept;
  const DnRequest& request() const noexcept { return request_; }
  void reset() noexcept { collecting_ = false; }

 private:
  Heard fragment(ByteView data) noexcept;

  DnRequest request_;
  bool collecting_ = false;
  std::uint8_t count_ = 0;
};

/// Sends one answer, in fragments when it is longer than a frame.
class DnExplicitSender {
 public:
  static constexpr Duration kAcknowledgeTime = std::chrono::seconds(1);

  /// `body`: service with bit 7, and data. The first frame of it.
  DnFrameData begin(std::uint8_t header, const CipBytes& body) noexcept;
  /// The acknowledge of a fragment; the next one, if there is any.
  std::optional<DnFrameData> acknowledged(std::uint8_t count) noexcept;
  struct Waited {
    std::optional<DnFrameData> again;
    bool missed = false;  ///< a second went by without an acknowledge
  };
  Waited advance(Duration span) noexcept;
  bool busy() const noexcept { return busy_; }
  void reset() noexcept { busy_ = false; }

 private:
  DnFrameData frame() const noexcept;

  std::uint8_t header_ = 0;
  CipBytes body_;
  std::size_t offset_ = 0;
  std::uint8_t count_ = 0;
  bool busy_ = false;
  bool repeated_ = false;
  Duration waited_{0};
};

}  // namespace nord_driver::sim
