#include "sim/canopen/can_process_objects.h"

#include <algorithm>
#include <cmath>

#include "sim/canopen/can_emergency.h"
#include "sim/cia402_words.h"

namespace nord_driver::sim {

namespace {

constexpr unsigned kWords = 3;  // setpoints and actual values of one inverter
// SW1 and IW1 as 32 bits: the manual's list of sub-indices was not to be had, this one is the simulator's.
constexpr unsigned kWide = 4;
// Digital inputs and outputs of the gateway: the objects up to 3005h are not printed in what could be read.
constexpr std::uint16_t kModuleInputs = 0x3004;
constexpr std::uint16_t kModuleOutputs = 0x3005;

}  // namespace

CanProcessObjects::CanProcessObjects(const Drives& drives, CanConnection connection) noexcept
    : drives_(drives), connection_(connection) {}

bool CanProcessObjects::has(std::uint16_t index) const noexcept {
  if (cia402_) return index >= 0x603F && index <= 0x6049;
  return index >= 0x3000 && index <= 0x3005;
}

CanProcessObjects::Field CanProcessObjects::find(ObjectId id) const noexcept {
  return cia402_ ? findCia402(id) : findNord(id);
}

CanProcessObjects::Field CanProcessObjects::findNord(ObjectId id) const noexcept {
  Field field;
  const bool gateway = connection_ == CanConnection::kGateway;
  const std::size_t inverters = gateway ? kInverters : 1;
  const auto missing = [&] {
    field.refusal = SdoAbort::kNoSubIndex;
    return field;
  };
  switch (id.index) {
    case 0x3000:
    case 0x3001: {
      if (gateway && id.sub == 0) return {Kind::kCount, 0, kInverters, 8, false, false};
      const std::size_t inverter = gateway ? id.sub - 1u : id.sub;
      if (inverter >= inverters) return missing();
      const bool control = id.index == 0x3000;
      return {control ? Kind::kControl : Kind::kStatus, inverter, 0, 16, control};
    }
    case 0x3002:
    case 0x3003: {
      const unsigned words = static_cast<unsigned>(inverters) * kWords;
      const bool setpoint = id.index == 0x3002;
      if (id.sub == 0) return {Kind::kCount, 0, gateway ? words : kWide, 8, false, false};
      if (!gateway && id.sub == kWide) {
        return {setpoint ? Kind::kWideSetpoint : Kind::kWideActual, 0, 0, 32, setpoint};
      }
      if (id.sub > words) return missing();
      const unsigned n = id.sub - 1u;
      return {setpoint ? Kind::kSetpoint : Kind::kActual, n / kWords, n % kWords, 16, setpoint};
    }
    case kModuleInputs:
    case kModuleOutputs:
      if (!gateway) return field;
      if (id.sub == 0) return {Kind::kCount, 0, 1, 8, false, false};
      if (id.sub > 1) return missing();
      if (id.index == kModuleInputs) return {Kind::kInputs, 0, 0, 8, false};
      return {Kind::kOutputs, 0, 0, 8, true};
    default:
      return field;
  }
}

// BU 0070 6.3.2 and the objects of BU 0060 p. 65.
CanProcessObjects::Field CanProcessObjects::findCia402(ObjectId id) const noexcept {
  Field field;
  const auto plain = [&](Kind kind, unsigned bits, bool writable, bool mappable = true) {
    if (id.sub != 0) {
      field.refusal = SdoAbort::kNoSubIndex;
      return field;
    }
    return Field{kind, 0, 0, bits, writable, mappable};
  };
  switch (id.index) {
    case 0x603F:
      return plain(Kind::kErrorCode, 32, false, false);
    case 0x6040:
      return plain(Kind::kControl, 16, true);
    case 0x6041:
      return plain(Kind::kStatus, 16, false);
    case 0x6042:
      return plain(Kind::kRpmSetpoint, 16, true);
    case 0x6043:
      return plain(Kind::kRpmBehindRamp, 16, false);
    case 0x6044:
      return plain(Kind::kRpmActual, 16, false);
    case 0x6046:
      if (id.sub == 0) return {Kind::kCount, 0, 2, 8, false, false};
      if (id.sub <= 2) return {Kind::kRpmLimit, 0, id.sub - 1u, 32, true, false};
      break;
    case 0x6048:
    case 0x6049:
      if (id.sub == 0) return {Kind::kCount, 0, 2, 8, false, false};
      if (id.sub <= 2) {
        const unsigned ramp = id.index == 0x6048 ? 0 : 2;
        return {Kind::kRamp, 0, ramp + id.sub - 1u, id.sub == 1 ? 32u : 16u, true, false};
      }
      break;
    default:
      return field;
  }
  field.refusal = SdoAbort::kNoSubIndex;
  return field;
}

unsigned CanProcessObjects::mappableBits(ObjectId id, bool receive) const noexcept {
  if (!has(id.index)) return 0;
  const Field field = find(id);
  if (field.kind == Kind::kNone || !field.mappable) return 0;
  return receive == field.writable ? field.bits : 0;
}

std::uint32_t CanProcessObjects::value(const Field& field) const noexcept {
  const Outputs& outputs = outputs_[field.inverter];
  switch (field.kind) {
    case Kind::kCount:
      return field.n;
    case Kind::kControl:
      return outputs.control;
    case Kind::kSetpoint:
      return outputs.setpoints[field.n];
    case Kind::kWideSetpoint:
      if (const DriveUnit* const drive = drives_[0]; drive != nullptr && drive->inverter().wideSetpoint()) {
        const WideField& wide = drive->inverter().wideField();
        return std::uint32_t{outputs.setpoints[wide.high]} << 16 | outputs.setpoints[wide.low];
      }
      return static_cast<std::uint32_t>(std::int32_t{toSigned(outputs.setpoints[0])});
    case Kind::kRpmSetpoint:
      return outputs.setpoints[0];
    case Kind::kInputs:
      return module_inputs_;
    case Kind::kOutputs:
      return module_outputs_;
    default:
      break;
  }
  const DriveUnit* drive = drives_[field.inverter];
  if (drive == nullptr || !drive->plugged() || !drive->inverterLink()) return 0;
  const InverterModel& inverter = drive->inverter();
  switch (field.kind) {
    case Kind::kStatus:
      return cia402_ ? cia402Status(*drive, toSigned(outputs.setpoints[0])) : inverter.statusWord();
    case Kind::kActual:
      return inverter.actualValue(field.n);
    case Kind::kWideActual:
      if (inverter.wideActual()) {
        const WideField& wide = inverter.wideField();
        return std::uint32_t{inverter.actualValue(wide.high)} << 16 | inverter.actualValue(wide.low);
      }
      return static_cast<std::uint32_t>(std::int32_t{toSigned(inverter.actualValue(0))});
    case Kind::kRpmBehindRamp:
      return toWord(behindRamp(*drive));
    case Kind::kRpmActual:
      return toWord(actualSpeed(*drive));
    case Kind::kErrorCode:
      return inverter.faultNumber() == 0 ? 0 : emergencyCode(inverter.faultNumber());
    case Kind::kRpmLimit:
    case Kind::kRamp:
      return rampValue(field);
    default:
      return 0;
  }
}

// 6046h is P104 and P105; of a ramp the speed is P105 and the time P102 or P103, which are from 0 Hz to P105.
std::uint32_t CanProcessObjects::rampValue(const Field& field) const noexcept {
  const DriveUnit& drive = *drives_[field.inverter];
  const ParameterStore& parameters = drive.parameters();
  if (field.kind == Kind::kRpmLimit) {
    return static_cast<std::uint32_t>(std::lround(rpmOf(parameters.scaled(field.n == 0 ? 104 : 105), drive)));
  }
  if (field.n % 2 == 0) return static_cast<std::uint32_t>(std::lround(rpmOf(parameters.scaled(105), drive)));
  return static_cast<std::uint32_t>(std::lround(parameters.scaled(field.n < 2 ? 102 : 103)));
}

SdoAbort CanProcessObjects::writeRamp(const Field& field, std::uint32_t value) noexcept {
  DriveUnit& drive = *drives_[field.inverter];
  ParameterStore& parameters = drive.parameters();
  unsigned number = 0;
  double in_unit = value;
  if (field.kind == Kind::kRpmLimit) {
    number = field.n == 0 ? 104 : 105;
    in_unit = frequencyOf(value, drive);
  } else if (field.n % 2 == 0) {  // a ramp over another speed would need another time: only P105 can be said
    return value == rampValue(field) ? SdoAbort::kNone : SdoAbort::kValueRange;
  } else {
    number = field.n < 2 ? 102 : 103;
  }
  const double raw = std::round(in_unit * parameters.find(number)->divisor);
  if (raw > 1e9) return SdoAbort::kTooHigh;
  const Storage storage = parameters.value(560) == 0 ? Storage::kRam : Storage::kEeprom;
  return parameters.write(number, 0, 0, static_cast<std::int32_t>(raw), storage) ? SdoAbort::kTooHigh : SdoAbort::kNone;
}

SdoAbort CanProcessObjects::read(ObjectId id, ObjectBytes& bytes) noexcept {
  const Field field = find(id);
  if (field.kind == Kind::kNone) return field.refusal;
  bytes = objectBytes(value(field), field.bits / 8);
  return SdoAbort::kNone;
}

SdoAbort CanProcessObjects::write(ObjectId id, ByteView bytes) noexcept {
  const Field field = find(id);
  if (field.kind == Kind::kNone) return field.refusal;
  if (!field.writable) return SdoAbort::kReadOnly;
  if (bytes.size() != field.bits / 8) return SdoAbort::kTypeOrLength;
  const std::uint32_t number = objectNumber(bytes);
  const auto word = static_cast<Word>(number & 0xFFFFu);
  Outputs& outputs = outputs_[field.inverter];
  switch (field.kind) {
    case Kind::kOutputs:
      module_outputs_ = static_cast<std::uint8_t>(number);
      return SdoAbort::kNone;
    case Kind::kRpmLimit:
    case Kind::kRamp:
      return drives_[0]->inverter().powered() ? writeRamp(field, number) : SdoAbort::kHardware;
    case Kind::kControl:
      outputs.control = word;
      break;
    case Kind::kSetpoint:
      outputs.setpoints[field.n] = word;
      break;
    case Kind::kWideSetpoint:
      outputs.setpoints[0] = word;
      if (const DriveUnit* const drive = drives_[0]; drive != nullptr && drive->inverter().wideSetpoint()) {
        const WideField& wide = drive->inverter().wideField();
        outputs.setpoints[wide.low] = word;
        outputs.setpoints[wide.high] = static_cast<Word>(number >> 16);
      }
      break;
    default:
      outputs.setpoints[0] = word;
      break;
  }
  outputs.written = true;
  return SdoAbort::kNone;
}

CanProcessObjects::Commit CanProcessObjects::commit() noexcept {
  Commit commit;
  for (std::size_t i = 0; i < kInverters; ++i) {
    Outputs& outputs = outputs_[i];
    if (!outputs.written) continue;
    outputs.written = false;
    const bool valid = cia402_ || (outputs.control & stw::kDataValid) != 0;
    DriveUnit* drive = drives_[i];
    const bool there = drive != nullptr && drive->inverterLink() && drive->inverter().powered();
    commit.zero = commit.zero || (!valid && outputs.valid_seen && there);
    commit.valid = commit.valid || valid;
    outputs.valid_seen = there && (outputs.valid_seen || valid);  // one that comes back begins anew, too
    if (drive == nullptr || !drive->inverterLink()) continue;
    if (cia402_) {
      drive->inverter().receive(fromCia402(outputs.control, toSigned(outputs.setpoints[0]), *drive));
    } else {
      drive->inverter().receive({outputs.control, outputs.setpoints});
    }
  }
  return commit;
}

void CanProcessObjects::beginExchange() noexcept {
  for (Outputs& outputs : outputs_) outputs.valid_seen = false;
}

void CanProcessObjects::clear() noexcept {
  outputs_ = {};
  module_outputs_ = 0;
}

}  // namespace nord_driver::sim
