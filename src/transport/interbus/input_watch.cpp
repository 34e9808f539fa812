#include "transport/interbus/input_watch.h"

namespace nord_driver {

namespace {

InputWorth judge(const link::RegisterInputs& inputs, Duration age, Duration timeout) noexcept {
  if (inputs.number == 0) return InputWorth::kNone;
  if (age > timeout) return InputWorth::kOld;
  return inputs.bus_runs ? InputWorth::kGood : InputWorth::kRingStands;
}

}  // namespace

void InputWatch::handle(const link::RegisterInputs& newest, Instant now) noexcept {
  const bool was_good = isGood();
  age_ = newest.number == 0 ? Duration::zero() : newest.age(now);
  worth_ = judge(newest, age_, timeout_);
  fresh_ = isGood() && newest.number != number_;
  number_ = newest.number;
  interruption_ = Interruption::kNone;
  if (!was_good || isGood()) return;
  interruption_ = worth_ == InputWorth::kRingStands ? Interruption::kUnasked : Interruption::kSilent;
}

}  // namespace nord_driver
