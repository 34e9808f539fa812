// One entry of the object dictionary set to a value: read first, written only when it differs. The identifier of an SDO
// server (1201h to 127Fh) must not change while it is valid (CiA 301 7.5.2.33): it is switched off first.
#pragma once

#include <cstdint>

#include "canopen/dictionary_text.h"
#include "canopen/node_config.h"
#include "canopen/sdo_request.h"

namespace nord_driver::canopen {

class ComparedWrite {
 public:
  /// `what` names the entry in sentences and lives as long as this. `zero_may_miss`: when the value is 0, an object
  /// that does not exist is as good.
  void begin(const char* what, const SetupWrite& entry, bool zero_may_miss = false) noexcept;

  SdoRequest request() const noexcept;
  /// `answer`: to `request()`, and no time-out.
  Progress handle(const SdoAnswer& answer) noexcept;
  /// Why it failed.
  const Sentence& reason() const noexcept { return reason_; }

 private:
  bool isValidServerId(std::uint32_t value) const noexcept;

  const char* what_ = "";
  SetupWrite entry_;
  bool zero_may_miss_ = false;
  enum class Step : std::uint8_t { kRead, kSwitchOff, kWrite };
  Step step_ = Step::kRead;
  std::uint32_t present_ = 0;
  Sentence reason_;
};

}  // namespace nord_driver::canopen
