#include "sim/devicenet/dn_drive_objects.h"

#include <cmath>

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kMotorData = 40;
constexpr std::uint8_t kSupervisor = 41;
constexpr std::uint8_t kAsynchronous = 7;  // motor type
constexpr double kMilli = 1000.0;

std::uint32_t rounded(double value) noexcept {
  return static_cast<std::uint32_t>(std::lround(value));
}

}  // namespace

CipStatus DnDriveObjects::get(const CipAddress& at, CipBytes& value) noexcept {
  if (at.instance == 0 || at.instance > DnProcess::kInverters) return CipStatus::kNoObject;
  const std::size_t place = at.instance - 1u;
  if (!process_.present(place)) return CipStatus::kResourceUnavailable;
  if (at.class_id == kMotorData) return getMotor(place, at.attribute, value);
  return at.class_id == kSupervisor ? getSupervisor(place, at.attribute, value) : getDrive(place, at.attribute, value);
}

CipStatus DnDriveObjects::set(const CipAddress& at, ByteView value, CipBytes& /*answer*/) noexcept {
  if (at.instance == 0 || at.instance > DnProcess::kInverters) return CipStatus::kNoObject;
  const std::size_t place = at.instance - 1u;
  if (!process_.present(place)) return CipStatus::kResourceUnavailable;
  if (at.class_id == kMotorData) return setMotor(place, at.attribute, value);
  return at.class_id == kSupervisor ? setSupervisor(place, at.attribute, value) : setDrive(place, at.attribute, value);
}

CipStatus DnDriveObjects::getMotor(std::size_t place, std::uint8_t attribute, CipBytes& value) noexcept {
  const DnMotorData& motor = motors_[place];
  switch (attribute) {
    case 3:
      put(value, kAsynchronous, 1);
      return CipStatus::kOk;
    case 6:
      put(value, motor.current, 2);
      return CipStatus::kOk;
    case 7:
      put(value, motor.voltage, 2);
      return CipStatus::kOk;
    case 8:
      put(value, motor.power, 4);
      return CipStatus::kOk;
    case 9:
      put(value, motor.frequency, 2);
      return CipStatus::kOk;
    case 12:
      put(value, 2u * static_cast<unsigned>(process_.drive(place)->config().motor.pole_pairs), 2);
      return CipStatus::kOk;
    default:
      return CipStatus::kNoAttribute;
  }
}

CipStatus DnDriveObjects::setMotor(std::size_t place, std::uint8_t attribute, ByteView value) noexcept {
  DnMotorData& motor = motors_[place];
  const bool is_power = attribute == 8;
  if (attribute == 3 || attribute == 12) return CipStatus::kNotSettable;
  if (attribute < 6 || attribute > 9) return CipStatus::kNoAttribute;
  const CipStatus size = checkSize(value, is_power ? 4 : 2);
  if (size != CipStatus::kOk) return size;
  const std::uint32_t bits = number(value);
  const auto word = static_cast<std::uint16_t>(bits & 0xFFFFu);
  if (attribute == 6) motor.current = word;
  if (attribute == 7) motor.voltage = word;
  if (is_power) motor.power = bits;
  if (attribute == 9) motor.frequency = word;
  return CipStatus::kOk;
}

CipStatus DnDriveObjects::getSupervisor(std::size_t place, std::uint8_t attribute, CipBytes& value) noexcept {
  const DriveUnit& drive = *process_.drive(place);
  const AcDrive& ac = process_.acDrive(place);
  const Word word = drive.inverter().statusWord();
  const bool running = (word & zsw::kOperationEnabled) != 0;
  const bool reverse = drive.inverter().frequency() < 0.0;
  const AcDriveState state = ac.state(drive);
  const auto boolean = [&](bool is) {
    put(value, is ? 1 : 0, 1);
    return CipStatus::kOk;
  };
  switch (attribute) {
    case 3:
    case 4:
    case 5:
    case 12:
      return CipStatus::kNoAttribute;  // printed as "Set" only
    case 6:
      put(value, static_cast<unsigned>(state), 1);
      return CipStatus::kOk;
    case 7:
      return boolean(running && !reverse);
    case 8:
      return boolean(running && reverse);
    case 9:
      return boolean(state == AcDriveState::kReady || state == AcDriveState::kEnabled ||
                     state == AcDriveState::kStopping);
    case 10:
      return boolean((word & zsw::kFault) != 0);
    case 11:
      return boolean((word & zsw::kWarning) != 0);
    case 13: {  // "the current or last active error code"
      const std::uint16_t fault = drive.inverter().faultNumber();
      put(value, fault != 0 ? fault : static_cast<std::uint32_t>(drive.parameters().value(701)), 2);
      return CipStatus::kOk;
    }
    case 15:
      return boolean(ac.command.net_control);
    default:
      return CipStatus::kNoAttribute;
  }
}

CipStatus DnDriveObjects::setSupervisor(std::size_t place, std::uint8_t attribute, ByteView value) noexcept {
  AcDrive::Command& command = process_.acDrive(place).command;
  bool* const flag = attribute == 3    ? &command.run_forward
                     : attribute == 4  ? &command.run_reverse
                     : attribute == 5  ? &command.net_control
                     : attribute == 12 ? &command.fault_reset
                                       : nullptr;
  if (flag == nullptr) {
    const bool known = (attribute >= 6 && attribute <= 11) || attribute == 13 || attribute == 15;
    return known ? CipStatus::kNotSettable : CipStatus::kNoAttribute;
  }
  const CipStatus size = checkSize(value, 1);
  if (size != CipStatus::kOk) return size;
  if (value[0] > 1) return CipStatus::kInvalidValue;
  *flag = value[0] == 1;
  process_.commit(place, false);
  return CipStatus::kOk;
}

CipStatus DnDriveObjects::getDrive(std::size_t place, std::uint8_t attribute, CipBytes& value) noexcept {
  const DriveUnit& drive = *process_.drive(place);
  const AcDrive::Command& command = process_.acDrive(place).command;
  const ParameterStore& parameters = drive.parameters();
  const auto word = [&](std::uint32_t number) {
    put(value, number, 2);
    return CipStatus::kOk;
  };
  const auto byte = [&](unsigned number) {
    put(value, number, 1);
    return CipStatus::kOk;
  };
  switch (attribute) {
    case 3:
      return byte((drive.inverter().statusWord() & zsw::kSetpointReached) != 0 ? 1 : 0);
    case 4:
    case 29:
      return byte(command.net_reference ? 1 : 0);
    case 6:
      return byte(0);
    case 7:
      return word(toWord(dnActualRpm(drive)));
    case 8:
      return word(toWord(command.rpm));
    case 9:  // current, power and voltages are not simulated
    case 15:
    case 16:
    case 17:
      return word(0);
    case 18:
      return word(rounded(parameters.scaled(102) * kMilli));
    case 19:
      return word(rounded(parameters.scaled(103) * kMilli));
    case 20:
      return word(rounded(dnRpmOf(parameters.scaled(104), drive)));
    case 21:
      return word(rounded(dnRpmOf(parameters.scaled(105), drive)));
    default:
      return CipStatus::kNoAttribute;
  }
}

CipStatus DnDriveObjects::setDrive(std::size_t place, std::uint8_t attribute, ByteView value) noexcept {
  AcDrive::Command& command = process_.acDrive(place).command;
  const DriveUnit& drive = *process_.drive(place);
  switch (attribute) {
    case 3:
    case 6:
    case 7:
    case 9:
    case 15:
    case 16:
    case 17:
    case 29:
      return CipStatus::kNotSettable;
    case 4:
    case 8:
    case 18:
    case 19:
    case 20:
    case 21:
      break;
    default:
      return CipStatus::kNoAttribute;
  }
  const CipStatus size = checkSize(value, attribute == 4 ? 1 : 2);
  if (size != CipStatus::kOk) return size;
  const std::uint32_t bits = number(value);
  switch (attribute) {
    case 18:
      return setParameter(place, 102, bits / kMilli);
    case 19:
      return setParameter(place, 103, bits / kMilli);
    case 20:
      return setParameter(place, 104, dnFrequencyOf(bits, drive));
    case 21:
      return setParameter(place, 105, dnFrequencyOf(bits, drive));
    case 4:
      if (bits > 1) return CipStatus::kInvalidValue;
      command.net_reference = bits == 1;
      break;
    default:
      command.rpm = toSigned(static_cast<Word>(bits));
      break;
  }
  process_.commit(place, false);
  return CipStatus::kOk;
}

CipStatus DnDriveObjects::setParameter(std::size_t place, unsigned number, double in_unit) noexcept {
  ParameterStore& parameters = process_.drive(place)->parameters();
  const auto raw = static_cast<std::int32_t>(std::lround(in_unit * parameters.find(number)->divisor));
  const Storage storage = parameters.value(560) == 0 ? Storage::kRam : Storage::kEeprom;
  return parameters.write(number, 0, 0, raw, storage) ? CipStatus::kInvalidValue : CipStatus::kOk;
}

}  // namespace nord_driver::sim
