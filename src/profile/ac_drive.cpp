#include "profile/ac_drive.h"

#include <algorithm>
#include <cmath>

#include "profile/control_word.h"
#include "profile/scaling.h"
#include "profile/status_word.h"

namespace nord_driver::profile {

namespace {

// Byte 0 of assemblies 20 and 21.
constexpr unsigned kRunForward = 1u << 0, kRunReverse = 1u << 1, kFaultReset = 1u << 2, kNetControl = 1u << 5,
                   kNetReference = 1u << 6;
// Byte 0 of assemblies 70 and 71.
constexpr unsigned kFaulted = 1u << 0, kWarning = 1u << 1, kRunning1 = 1u << 2, kRunning2 = 1u << 3,
                   kControlFromNet = 1u << 5, kReferenceFromNet = 1u << 6, kAtReference = 1u << 7;

// States of a status word (BU 2700 6.4.3).
constexpr unsigned kNordNotReady = 0x0030, kNordSwitchOnDisabled = 0x0070, kNordReady = 0x0031, kNordEnabled = 0x0037,
                   kNordFaultReaction = 0x003F, kNordFault = 0x0038;

// "Operation enabled" needs bits 0 to 6 (BU 2700 6.4.3 no. 4), and bit 10.
constexpr Word kRuns = 0x007F;

std::int16_t symmetricInt16(double value) noexcept {
  return static_cast<std::int16_t>(std::lround(std::min(32767.0, std::max(-32767.0, value))));
}

}  // namespace

// "Stopping" is a motor that is still on its ramp: NORD's words say "operation enabled" there.
Word statusOfSupervisor(std::uint8_t state) noexcept {
  switch (state) {
    case 1:  // start
      return static_cast<Word>(kNordNotReady | status_bit::kBusControl);
    case 2:  // not ready
      return static_cast<Word>(kNordSwitchOnDisabled | status_bit::kBusControl);
    case 3:  // ready
      return static_cast<Word>(kNordReady | status_bit::kBusControl);
    case 4:  // enabled
    case 5:  // stopping
      return static_cast<Word>(kNordEnabled | status_bit::kBusControl);
    case 6:  // fault stop
      return static_cast<Word>(kNordFaultReaction | status_bit::kBusControl);
    case 7:  // faulted
      return static_cast<Word>(kNordFault | status_bit::kBusControl);
    default:
      return 0;
  }
}

double AcDriveScaling::rpmOfHundredPercent() const noexcept {
  return max_frequency_ ? 60.0 * max_frequency_->value / pole_pairs_ : 0.0;
}

AcDriveOutput AcDriveScaling::toAcDrive(const ProcessOutput& output) const noexcept {
  const bool extended = kind_ == AcDriveKind::kExtended;
  AcDriveOutput to;
  unsigned control = extended ? kNetControl | kNetReference : 0u;
  const Word word = output.control_word;
  const bool valid = (word & control_bit::kDataValid) != 0;
  if (valid && (word & control_bit::kAcknowledge) != 0) control |= kFaultReset;
  if (valid && (word & kRuns) == kRuns) {
    const bool left = (word & (control_bit::kRight | control_bit::kLeft)) == control_bit::kLeft;
    const double share = (left ? -1.0 : 1.0) * output.setpoints[0] / kHundredPercent;
    const std::int16_t speed = symmetricInt16(atLeastOneRpm(rpmOfHundredPercent() * share));
    control |= extended && speed < 0 ? kRunReverse : kRunForward;
    // Without a reverse 0 rpm is nearest; where P104 > 0 would turn the motor at that, Drive stops it (DriveConfig).
    to.speed = speed >= 0 ? speed : extended ? static_cast<std::int16_t>(-speed) : std::int16_t{0};
  }
  to.control = static_cast<std::uint8_t>(control);
  return to;
}

Word AcDriveScaling::statusWord(const AcDriveInput& input) const noexcept {
  const unsigned status = input.status;
  const bool forward = (status & kRunning1) != 0;
  if (kind_ == AcDriveKind::kBasic) {
    const unsigned state = (status & kFaulted) != 0 ? kNordFault : forward ? kNordEnabled : kNordReady;
    return static_cast<Word>(state | status_bit::kBusControl | status_bit::kRight);
  }
  if (status == 0 && input.state == 0) return 0;
  const bool reverse = (status & kRunning2) != 0;
  unsigned word = statusOfSupervisor(input.state) & ~status_bit::kBusControl;
  if (word == 0) {
    // No state that is known: the bits alone decide.
    word = (status & kFaulted) != 0 ? kNordFault : forward || reverse ? kNordEnabled : kNordNotReady;
  }
  const unsigned from_net = kControlFromNet | kReferenceFromNet;
  if ((status & from_net) == from_net) word |= status_bit::kBusControl;
  if ((status & kWarning) != 0) word |= status_bit::kWarning;
  if ((status & kAtReference) != 0) word |= status_bit::kReached;
  return static_cast<Word>(word | (reverse ? status_bit::kLeft : status_bit::kRight));
}

ProcessInput AcDriveScaling::fromAcDrive(const AcDriveInput& input) const noexcept {
  ProcessInput to;
  to.status_word = statusWord(input);
  const double full = rpmOfHundredPercent();
  if (to.status_word == 0 || full <= 0.0) return to;
  // Whether the speed has a sign in reverse is in no manual: where it has none, the direction tells.
  const bool reverse = kind_ == AcDriveKind::kExtended && (input.status & kRunning2) != 0;
  const double speed = reverse && input.speed > 0 ? -1.0 * input.speed : 1.0 * input.speed;
  to.actual_values[0] = symmetricInt16(kHundredPercent * speed / full);
  return to;
}

}  // namespace nord_driver::profile
