#include "profile/cia402.h"

#include <algorithm>
#include <cmath>

#include "profile/control_word.h"
#include "profile/scaling.h"
#include "profile/status_word.h"

namespace nord_driver::profile {

namespace {

// Bits 0 to 7 mean the same in both profiles; "operation enabled" needs 0 to 6 in both (BU 2700 6.4.3 no. 4).
constexpr Word kCommonBits = 0x00FF;

constexpr Word kControlLeft = 1u << 11;  // BU 0070 6.4.2: 0 = right
constexpr Word kStatusRemote = 1u << 9;
constexpr Word kStatusReached = 1u << 10;
constexpr Word kStatusLeft = 1u << 14;

std::int16_t toInt16(double value) noexcept {
  return static_cast<std::int16_t>(std::lround(std::min(32767.0, std::max(-32768.0, value))));
}

}  // namespace

double Cia402Scaling::rpmOfHundredPercent() const noexcept {
  return max_frequency_ ? 60.0 * max_frequency_->value / pole_pairs_ : 0.0;
}

std::optional<Cia402Output> Cia402Scaling::toCia402(const ProcessOutput& output) const noexcept {
  if ((output.control_word & control_bit::kDataValid) == 0) return std::nullopt;
  Cia402Output to;
  to.control_word = output.control_word & kCommonBits;
  const bool left = (output.control_word & (control_bit::kRight | control_bit::kLeft)) == control_bit::kLeft;
  if (left) to.control_word |= kControlLeft;
  to.target_velocity = toInt16(atLeastOneRpm(rpmOfHundredPercent() * output.setpoints[0] / kHundredPercent));
  return to;
}

ProcessInput Cia402Scaling::fromCia402(const Cia402Input& input) const noexcept {
  ProcessInput to;
  if (input.status_word == 0) return to;
  to.status_word = input.status_word & kCommonBits;
  if ((input.status_word & kStatusReached) != 0) to.status_word |= status_bit::kReached;
  if ((input.status_word & kStatusRemote) != 0) to.status_word |= status_bit::kBusControl;
  to.status_word |= (input.status_word & kStatusLeft) != 0 ? status_bit::kLeft : status_bit::kRight;
  const double full = rpmOfHundredPercent();
  if (full > 0.0) to.actual_values[0] = toInt16(kHundredPercent * input.actual_velocity / full);
  return to;
}

}  // namespace nord_driver::profile
