#include "transport/canopen/canopen_map.h"

#include "nord_driver/core/time.h"
#include "profile/module_parameters.h"
#include "profile/parameter_shape.h"

namespace nord_driver {

namespace {

using canopen::PdoConfig;
using canopen::PdoMapping;

constexpr std::uint16_t kControlWord = 0x3000, kStatusWord = 0x3001, kSetpoints = 0x3002, kActualValues = 0x3003;
constexpr std::uint16_t kCia402ControlWord = 0x6040, kCia402StatusWord = 0x6041, kCia402TargetVelocity = 0x6042,
                        kCia402ActualVelocity = 0x6044;
constexpr std::uint32_t kFirstTransmitPdo = 0x180, kFirstReceivePdo = 0x200, kNextPdo = 0x100;
constexpr std::uint8_t kBits = 16;
constexpr std::uint8_t kWithEverySync = 1, kAtOnce = 255;  // CiA 301 tables 66, 69; BU 0060 p. 58
constexpr std::uint16_t kMaxParameter = 999;
constexpr std::uint8_t kValuesPerInverter = 3;

bool isGateway(const CanopenDrive& drive) noexcept {
  return drive.connection == CanopenConnection::kGateway;
}

// The PDO of the pre-defined connection set the drive uses, 1..4.
std::uint16_t pdoNumber(const CanopenDrive& drive) noexcept {
  if (isGateway(drive)) return drive.inverter;
  return drive.process_values == 1 ? 1 : 2;
}

// The word (1..) of value 0..2 in the PDO.
std::size_t wordOf(const CanopenDrive& drive, std::size_t value) noexcept {
  return drive.third_before_second && value > 0 ? 3 - value : value;
}

FixedVector<PdoMapping, canopen::kMaxMappedObjects> mapping(const CanopenDrive& drive, std::uint16_t word,
                                                            std::uint16_t values) {
  FixedVector<PdoMapping, canopen::kMaxMappedObjects> entries;
  const auto inverter = static_cast<std::uint8_t>(isGateway(drive) ? drive.inverter : 0);
  const auto first = static_cast<std::uint8_t>(isGateway(drive) ? kValuesPerInverter * (drive.inverter - 1) : 0);
  entries.push_back({word, inverter, kBits});
  for (std::size_t i = 0; i < drive.process_values; ++i) {
    // The word order of a series is its own inverse: what stands in word i is also value wordOf(i).
    entries.push_back({values, static_cast<std::uint8_t>(first + wordOf(drive, i) + 1), kBits});
  }
  return entries;
}

FixedVector<PdoMapping, canopen::kMaxMappedObjects> cia402Mapping(std::uint16_t word, std::uint16_t value) {
  FixedVector<PdoMapping, canopen::kMaxMappedObjects> entries;
  entries.push_back({word, 0, kBits});
  entries.push_back({value, 0, kBits});
  return entries;
}

std::uint32_t cobId(std::uint32_t first, std::uint16_t number, std::uint8_t node) noexcept {
  return first + kNextPdo * (number - 1u) + node;
}

template <typename Unit>
std::uint16_t countOf(Duration time) noexcept {
  return static_cast<std::uint16_t>(std::chrono::round<Unit>(time).count());
}

using HundredMicroseconds = std::chrono::duration<std::int64_t, std::ratio<1, 10'000>>;

PdoConfig disabledPdo(std::uint16_t number, std::uint32_t cob_id) {
  PdoConfig pdo;
  pdo.number = number;
  pdo.enabled = false;
  pdo.cob_id = cob_id;
  return pdo;
}

}  // namespace

void addPdos(CanopenDrive& drive, const CanopenPdoOptions& pdo, canopen::NodeConfig& node) {
  const bool cia402 = drive.drive_profile == DriveProfile::kCia402;
  const std::uint16_t number = pdoNumber(drive);
  const std::uint8_t type = pdo.synchronous ? kWithEverySync : kAtOnce;

  PdoConfig receive;
  receive.number = number;
  receive.cob_id = cobId(kFirstReceivePdo, number, node.id);
  receive.transmission_type = type;
  PdoConfig transmit;
  transmit.number = number;
  transmit.cob_id = cobId(kFirstTransmitPdo, number, node.id);
  transmit.transmission_type = type;
  if (!pdo.synchronous && pdo.inhibit_time) transmit.inhibit_time = countOf<HundredMicroseconds>(*pdo.inhibit_time);
  if (!pdo.synchronous && pdo.event_time) transmit.event_timer = countOf<std::chrono::milliseconds>(*pdo.event_time);
  if (pdo.write_mapping) {
    receive.mapping =
        cia402 ? cia402Mapping(kCia402ControlWord, kCia402TargetVelocity) : mapping(drive, kControlWord, kSetpoints);
    transmit.mapping =
        cia402 ? cia402Mapping(kCia402StatusWord, kCia402ActualVelocity) : mapping(drive, kStatusWord, kActualValues);
  }
  // Switched off before its successor is switched on, in the manual's order (BU 0060 p. 59).
  if (number == 2 && !isGateway(drive)) {
    node.transmit_pdos.push_back(disabledPdo(1, cobId(kFirstTransmitPdo, 1, node.id)));
  }
  drive.receive_pdo = node.receive_pdos.size();
  drive.transmit_pdo = node.transmit_pdos.size();
  node.receive_pdos.push_back(receive);
  node.obeys_predefined_pdos = !isGateway(drive);  // a gateway's may be of inverters that are not ours
  node.transmit_pdos.push_back(transmit);
}

PdoBytes packPdo(const CanopenDrive& drive, const profile::ProcessOutput& output) noexcept {
  PdoBytes bytes;
  ByteWriter writer{bytes};
  writer.u16le(output.control_word);
  for (std::size_t i = 0; i < drive.process_values; ++i) writer.u16le(toWord(output.setpoints[wordOf(drive, i)]));
  return bytes;
}

bool unpackPdo(const CanopenDrive& drive, ByteView bytes, profile::ProcessInput& input) noexcept {
  if (bytes.size() / 2 < 1u + drive.process_values) return false;
  ByteReader reader{bytes};
  input = {};
  input.status_word = reader.u16le();
  for (std::size_t i = 0; i < drive.process_values; ++i) {
    input.actual_values[wordOf(drive, i)] = toSigned(reader.u16le());
  }
  return true;
}

PdoBytes packCia402(const profile::Cia402Output& output) noexcept {
  PdoBytes bytes;
  ByteWriter writer{bytes};
  writer.u16le(output.control_word);
  writer.u16le(toWord(output.target_velocity));
  return bytes;
}

bool unpackCia402(ByteView bytes, profile::Cia402Input& input) noexcept {
  if (bytes.size() < 4) return false;
  ByteReader reader{bytes};
  input.status_word = reader.u16le();
  input.actual_velocity = toSigned(reader.u16le());
  return true;
}

std::optional<ObjectAddress> parameterObject(const CanopenDrive& drive,
                                             const profile::ParameterRequest& request) noexcept {
  using Shape = profile::ParameterShape;
  const unsigned set = request.parameter_set, element = request.index;
  const bool has_set = profile::hasSets(request.shape);
  const bool has_element = profile::isArray(request.shape);
  if (request.number > kMaxParameter || (has_set && (set < 1 || set > 4)) || (has_element && element < 1)) {
    return std::nullopt;
  }
  unsigned sub_index = 0;
  switch (request.shape) {
    case Shape::kPlain:
      break;
    case Shape::kPerSet:
      sub_index = set;
      break;
    case Shape::kArray:
      sub_index = drive.array_sub_index == ArraySubIndex::kElement ? element : 4 * (element - 1) + 1;
      break;
    case Shape::kArrayPerSet:
      sub_index = 4 * (element - 1) + set;  // BU 0060 p. 61
      break;
  }
  if (sub_index > 255) return std::nullopt;
  // The module's own have no offset of an inverter (its EtherCAT sibling: BU 0570 p. 25).
  const std::uint16_t base = profile::isOfModule(request.number) ? kParameterBase : drive.parameter_base;
  return ObjectAddress{static_cast<std::uint16_t>(base + request.number), static_cast<std::uint8_t>(sub_index)};
}

}  // namespace nord_driver
