#include "canopen/compared_write.h"

#include "canopen/sdo_abort.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint16_t kFirstServer = 0x1200, kLastServer = 0x127F;  // the first one's identifiers are fixed
constexpr std::uint32_t kOff = 0x80000000;                            // bit 31: it does not exist

}  // namespace

void ComparedWrite::begin(const char* what, const SetupWrite& entry, bool zero_may_miss) noexcept {
  what_ = what;
  entry_ = entry;
  zero_may_miss_ = zero_may_miss;
  step_ = Step::kRead;
  reason_.clear();
}

SdoRequest ComparedWrite::request() const noexcept {
  if (step_ == Step::kRead) return sdoRead(0, entry_.index, entry_.sub_index);
  const std::uint32_t value = step_ == Step::kSwitchOff ? present_ | kOff : entry_.value;
  return sdoWrite(0, entry_.index, entry_.sub_index, value, entry_.size);
}

bool ComparedWrite::isValidServerId(std::uint32_t value) const noexcept {
  const bool server = entry_.index > kFirstServer && entry_.index <= kLastServer;
  return server && (entry_.sub_index == 1 || entry_.sub_index == 2) && (value & kOff) == 0;
}

Progress ComparedWrite::handle(const SdoAnswer& answer) noexcept {
  const bool missing = answer.abort_code == sdo_abort::kNoObject || answer.abort_code == sdo_abort::kNoSubIndex;
  if (!answer.ok() && missing && zero_may_miss_ && entry_.value == 0) return Progress::kDone;
  if (step_ == Step::kSwitchOff) {
    // Where it cannot be switched off it may change as it is.
    step_ = Step::kWrite;
    return Progress::kGoOn;
  }
  if (step_ == Step::kWrite) {
    if (answer.ok()) return Progress::kDone;
    reason_ = refusalText(what_, request(), answer);
    return Progress::kFailed;
  }
  const auto value = numberOf(answer, entry_.size);
  if (answer.ok() && value == entry_.value) return Progress::kDone;
  if (!answer.ok() && missing) {
    reason_ = refusalText(what_, request(), answer);
    return Progress::kFailed;
  }
  // What cannot be read may still be written.
  present_ = value.value_or(0);
  step_ = answer.ok() && value && isValidServerId(*value) ? Step::kSwitchOff : Step::kWrite;
  return Progress::kGoOn;
}

}  // namespace nord_driver::canopen
