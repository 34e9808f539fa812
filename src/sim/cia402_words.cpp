#include "sim/cia402_words.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::sim {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Word kCommandBits = 0x00FF;  // bits 0-7 are those of NORD's own control and status word
constexpr Word kLeftCommand = 1u << 11;
constexpr Word kRemote = 1u << 9;
constexpr Word kReached = 1u << 10;
constexpr Word kLimit = 1u << 11;
constexpr Word kTurnsLeft = 1u << 14;

std::int16_t saturated(double value) noexcept {
  return static_cast<std::int16_t>(std::clamp(std::round(value), -32768.0, 32767.0));
}

}  // namespace

double rpmOf(double frequency, const DriveUnit& drive) noexcept {
  return frequency * 60.0 / drive.config().motor.pole_pairs;
}

double frequencyOf(double rpm, const DriveUnit& drive) noexcept {
  return rpm * drive.config().motor.pole_pairs / 60.0;
}

ProcessData fromCia402(Word control, std::int16_t rpm, const DriveUnit& drive) noexcept {
  ProcessData data;
  data.carried = 1;
  const bool left = (control & kLeftCommand) != 0;
  data.control = static_cast<Word>((control & kCommandBits) | stw::kDataValid | (left ? stw::kLeft : 0u));
  const double maximum = drive.parameters().scaled(105);
  const double share = maximum > 0.0 ? frequencyOf(rpm, drive) / maximum : 0.0;
  data.setpoints[0] = toWord(saturated(std::clamp(share, -1.0, 1.0) * kFullScale));
  return data;
}

Word cia402Status(const DriveUnit& drive, std::int16_t rpm_setpoint) noexcept {
  if (!drive.inverter().powered()) return 0;
  const Word nord = drive.inverter().statusWord();
  unsigned word = nord & kCommandBits;
  if ((nord & zsw::kBusControl) != 0) word |= kRemote;
  if ((nord & zsw::kSetpointReached) != 0) word |= kReached;
  if ((nord & zsw::kLeft) != 0) word |= kTurnsLeft;
  const double asked = std::fabs(frequencyOf(rpm_setpoint, drive));
  const ParameterStore& parameters = drive.parameters();
  if (asked > parameters.scaled(105) || asked < parameters.scaled(104)) word |= kLimit;
  return static_cast<Word>(word);
}

std::int16_t behindRamp(const DriveUnit& drive) noexcept {
  return saturated(rpmOf(drive.inverter().frequency(), drive));
}

std::int16_t actualSpeed(const DriveUnit& drive) noexcept {
  return saturated(drive.shaftSpeed() * 30.0 / kPi);
}

}  // namespace nord_driver::sim
