#include "sim/devicenet/ac_drive.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::sim {

namespace {

constexpr double kPi = 3.14159265358979323846;

// Byte 0 of instances 20 and 21.
constexpr unsigned kRunForward = 1u << 0;
constexpr unsigned kRunReverse = 1u << 1;
constexpr unsigned kFaultReset = 1u << 2;
constexpr unsigned kNetControl = 1u << 5;
constexpr unsigned kNetReference = 1u << 6;

// Byte 0 of instances 70 and 71.
constexpr unsigned kFaulted = 1u << 0;
constexpr unsigned kWarning = 1u << 1;
constexpr unsigned kRunningForward = 1u << 2;
constexpr unsigned kRunningReverse = 1u << 3;
constexpr unsigned kReady = 1u << 4;
constexpr unsigned kControlFromNet = 1u << 5;
constexpr unsigned kReferenceFromNet = 1u << 6;
constexpr unsigned kAtReference = 1u << 7;

constexpr Word kStop = stw::kDataValid | stw::kNoOff2 | stw::kNoOff3 | stw::kEnableOperation | stw::kRampEnable |
                       stw::kRampRun | stw::kSetpointEnable;  // 047E, OFF1

std::int16_t saturated(double value) noexcept {
  return static_cast<std::int16_t>(std::clamp(std::round(value), -32768.0, 32767.0));
}

}  // namespace

double dnRpmOf(double frequency, const DriveUnit& drive) noexcept {
  return frequency * 60.0 / drive.config().motor.pole_pairs;
}

double dnFrequencyOf(double rpm, const DriveUnit& drive) noexcept {
  return rpm * drive.config().motor.pole_pairs / 60.0;
}

std::int16_t dnActualRpm(const DriveUnit& drive) noexcept {
  return saturated(drive.shaftSpeed() * 30.0 / kPi);
}

void AcDrive::take(ByteView bytes, DnProfile profile) noexcept {
  ByteReader reader{bytes};
  const unsigned bits = reader.u8();
  reader.u8();
  command.rpm = toSigned(reader.u16le());
  command.run_forward = (bits & kRunForward) != 0;
  command.fault_reset = (bits & kFaultReset) != 0;
  const bool extended = profile == DnProfile::kAcDriveExtended;
  command.run_reverse = extended && (bits & kRunReverse) != 0;
  // Instance 20 has neither bit: it is there to be driven from the net.
  command.net_control = !extended || (bits & kNetControl) != 0;
  command.net_reference = !extended || (bits & kNetReference) != 0;
}

ProcessData AcDrive::words(const DriveUnit& drive) noexcept {
  ProcessData data;
  data.carried = 1;
  if (command.net_reference) {
    const double maximum = drive.parameters().scaled(105);
    const double share = maximum > 0.0 ? dnFrequencyOf(command.rpm, drive) / maximum : 0.0;
    reference_ = toWord(saturated(std::clamp(share, -1.0, 1.0) * kFullScale));
  }
  data.setpoints[0] = reference_;
  if (!command.net_control) return data;
  const bool run = command.run_forward != command.run_reverse;
  const InverterModel& inverter = drive.inverter();
  const bool faulty = inverter.faultNumber() != 0 || !inverter.powered();
  if (run && !ran_ && !faulty) started_ = true;
  if (!run || faulty) started_ = false;
  ran_ = run;
  unsigned control = kStop;
  // "Switch-on disabled" is left by OFF1 only.
  if (started_ && inverter.state() != InverterState::kSwitchOnDisabled) control |= stw::kOn;
  if (command.run_reverse && !command.run_forward) control |= stw::kLeft;
  if (command.fault_reset) control |= stw::kAcknowledge;
  data.control = static_cast<Word>(control);
  return data;
}

AcDriveState AcDrive::state(const DriveUnit& drive) const noexcept {
  switch (drive.inverter().state()) {
    case InverterState::kOff:
    case InverterState::kNotReadyToSwitchOn:
      return AcDriveState::kStartUp;
    case InverterState::kSwitchOnDisabled:
      return AcDriveState::kNotReady;
    case InverterState::kReadyToSwitchOn:
    case InverterState::kSwitchedOn:
      return AcDriveState::kReady;
    case InverterState::kOperationEnabled:
      return started_ ? AcDriveState::kEnabled : AcDriveState::kStopping;
    case InverterState::kQuickStopActive:
      return AcDriveState::kStopping;
    case InverterState::kFaultReactionActive:
      return AcDriveState::kFaultStop;
    case InverterState::kFault:
      return AcDriveState::kFaulted;
  }
  return AcDriveState::kStartUp;
}

FixedBytes<4> AcDrive::status(const DriveUnit& drive, DnProfile profile) const noexcept {
  const Word word = drive.inverter().statusWord();
  const AcDriveState now = state(drive);
  const bool running = (word & zsw::kOperationEnabled) != 0;
  const bool reverse = drive.inverter().frequency() < 0.0;
  unsigned bits = 0;
  if ((word & zsw::kFault) != 0) bits |= kFaulted;
  if (running && !reverse) bits |= kRunningForward;
  const bool extended = profile == DnProfile::kAcDriveExtended;
  if (extended) {
    if ((word & zsw::kWarning) != 0) bits |= kWarning;
    if (running && reverse) bits |= kRunningReverse;
    if (now == AcDriveState::kReady || now == AcDriveState::kEnabled || now == AcDriveState::kStopping) bits |= kReady;
    if (command.net_control) bits |= kControlFromNet;
    if (command.net_reference) bits |= kReferenceFromNet;
    if ((word & zsw::kSetpointReached) != 0) bits |= kAtReference;
  }
  FixedBytes<4> bytes;
  ByteWriter<4> writer{bytes};
  writer.u8(static_cast<std::uint8_t>(bits));
  writer.u8(extended ? static_cast<std::uint8_t>(now) : std::uint8_t{0});
  writer.u16le(toWord(dnActualRpm(drive)));
  return bytes;
}

}  // namespace nord_driver::sim
