// Tells our own telegrams that an adapter hands back from those of a second master with our address.
#pragma once

#include <cstddef>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_vector.h"
#include "profibus/telegram.h"

namespace nord_driver::profibus {

/// What comes back is what was sent, once for each sending, in this order, and before its answer. The link takes echoes
/// out; some pass it: a late one, or those of an adapter that is said to have none.
class EchoWatch {
 public:
  /// The line was opened anew, or a request that was sent once was answered: what has not come back by then does not.
  void forget() noexcept { sent_.clear(); }
  /// The answer may be one to an earlier request: what was sent last may come back still.
  void forgetAllButLast() noexcept {
    if (sent_.size() > 1) sent_.eraseFront(sent_.size() - 1);
  }
  /// Nothing is to come back any more.
  bool empty() const noexcept { return sent_.empty(); }
  void handleSent(ByteView frame) noexcept {
    if (sent_.full()) sent_.eraseFront(1);
    Frame kept;
    for (const std::uint8_t byte : frame) kept.push_back(byte);
    sent_.push_back(kept);
  }
  /// True when it may be one of ours.
  bool takes(const Telegram& heard) noexcept {
    for (std::size_t i = 0; i < sent_.size(); ++i) {
      if (!isSame(parse(sent_[i]).telegram, heard)) continue;
      sent_.eraseFront(i + 1);
      return true;
    }
    return false;
  }

 private:
  static bool isSame(const Telegram& one, const Telegram& other) noexcept {
    return one.kind == other.kind && one.da == other.da && one.sa == other.sa && one.fc == other.fc &&
           one.dsap == other.dsap && one.ssap == other.ssap && one.data == other.data;
  }

  FixedVector<Frame, 4> sent_;  // two broadcasts, and a request that was repeated
};

}  // namespace nord_driver::profibus
