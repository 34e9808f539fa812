#include "transport/canopen/module_link.h"

#include "profile/status_word.h"

namespace nord_driver {

namespace {

constexpr std::uint16_t kModuleLink = 0x5000;

}  // namespace

void ModuleLink::handleEmergency(std::uint16_t code, Instant at) noexcept {
  forget();
  if (code == kModuleLink) told_at_ = at;
}

void ModuleLink::handleBootUp(std::optional<Instant> at) noexcept {
  if (told_at_ && at && *at > *told_at_) forget();
}

void ModuleLink::handleWords(Word status, ByteView values, Instant at, Instant now) noexcept {
  if (!told_at_) return;
  const profile::StatusWord word{status};
  if (!word.isUseful() || at <= *told_at_) {
    good_since_.reset();
    return;
  }
  if (!known_) {
    known_ = true;
    for (const std::uint8_t byte : values) values_.push_back(byte);
  }
  changed_ = changed_ || !(values == ByteView{values_});
  if (word.operationEnabled() && !changed_) {
    good_since_.reset();
    return;
  }
  if (!good_since_) good_since_ = now;
  if (now - *good_since_ >= kEmergencyIsLate) forget();
}

}  // namespace nord_driver
