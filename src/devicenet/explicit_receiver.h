// A fragmented explicit message on its way in. Each fragment is acknowledged; one that comes again, because its
// acknowledge was lost, is acknowledged again and not stored twice.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/explicit_message.h"
#include "devicenet/fragment.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::devicenet {

class ExplicitReceiver {
 public:
  enum class Result : std::uint8_t {
    kAccepted,  ///< to be acknowledged; more follows
    kRepeated,  ///< to be acknowledged; was stored before
    kComplete,  ///< to be acknowledged; `body()` is whole
    kTooLong,   ///< to be acknowledged with "too much data"; what there was is dropped
    kStray      ///< belongs to nothing: neither stored nor acknowledged
  };

  /// What was being put together is dropped. A repetition of the last fragment is still known.
  void reset() noexcept { assembling_ = false; }
  /// Nothing is known any more.
  void forget() noexcept {
    assembling_ = false;
    last_.reset();
  }
  /// `data`: behind the fragment byte, not empty: a message of empty fragments would have no end. `expected`: somebody waits for a message with this transaction id.
  Result handle(bool xid, Fragment fragment, ByteView data, bool expected) noexcept;
  const ExplicitBody& body() const noexcept { return body_; }

 private:
  struct Accepted {
    bool xid = false;
    std::uint8_t byte = 0;
  };

  bool assembling_ = false;
  std::optional<Accepted> last_;
  std::uint8_t next_count_ = 0;
  ExplicitBody body_;
};

}  // namespace nord_driver::devicenet
