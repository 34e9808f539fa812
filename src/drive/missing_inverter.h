// An inverter that is off behind a bus module that lives: since when the module says so.
#pragma once

#include <algorithm>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::drive {

class MissingInverter {
 public:
  /// `timeout` > 0: the silence after which a module, or what it said, counts as gone.
  explicit MissingInverter(Duration timeout) noexcept : timeout_(timeout) {}

  /// The module took part in this cycle, and says that the inverter behind it does not. `last_answer`: the inverter's.
  void handle(Instant last_answer, Instant now) noexcept {
    const Instant heard = last_told_ ? std::max(last_answer, *last_told_) : last_answer;
    if (now - heard > timeout_) module_back_ = now;
    last_told_ = now;
  }

  /// The module says so now, and had time to find the inverter after a silence of its own: before that, the inverter
  /// might be turning in a set of its own.
  bool isCertain(Instant now) const noexcept {
    if (!last_told_ || now - *last_told_ > timeout_) return false;
    return !module_back_ || now - *module_back_ > timeout_;
  }

 private:
  Duration timeout_;
  std::optional<Instant> last_told_;
  std::optional<Instant> module_back_;
};

}  // namespace nord_driver::drive
