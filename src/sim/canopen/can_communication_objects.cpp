#include "sim/canopen/can_communication_objects.h"

#include <cstring>

namespace nord_driver::sim {

namespace {

constexpr std::uint32_t kSave = 0x65766173;  // "save"
constexpr std::uint32_t kLoad = 0x64616F6C;  // "load"
constexpr std::uint32_t kStoresOnCommand = 1;
constexpr std::uint32_t kExtendedFrame = 0x20000000;  // bit 29: no use of that in NORD's modules

const char* nameOf(CanConnection connection) noexcept {
  switch (connection) {
    case CanConnection::kOption:
      return "SK TU3-CAO";
    case CanConnection::kOnboard:
      return "SK 5xxE CANopen";
    case CanConnection::kGateway:
      return "SK TU4-CAO";
    case CanConnection::kSystemBus:
      return "NORD system bus";
  }
  return "";
}

ObjectBytes textBytes(const char* text) noexcept {
  ObjectBytes bytes;
  for (const char* c = text; *c != '\0'; ++c) bytes.push_back(static_cast<std::uint8_t>(*c));
  return bytes;
}

bool isText(std::uint16_t index) noexcept {
  return index >= 0x1008 && index <= 0x100A;
}

}  // namespace

const char* toString(CanConnection connection) noexcept {
  switch (connection) {
    case CanConnection::kOption:
      return "option";
    case CanConnection::kOnboard:
      return "onboard";
    case CanConnection::kGateway:
      return "gateway";
    case CanConnection::kSystemBus:
      return "system_bus";
  }
  return "?";
}

SdoAbort CanCommunicationObjects::read(ObjectId id, ObjectBytes& bytes) noexcept {
  if (isText(id.index)) {
    if (id.sub != 0) return SdoAbort::kNoSubIndex;
    bytes = textBytes(id.index == 0x1008 ? nameOf(connection_) : id.index == 0x1009 ? "1.0" : "2.0 R0 simulated");
    return SdoAbort::kNone;
  }
  std::uint32_t value = 0;
  std::size_t length = 0;
  const SdoAbort refusal = readNumber(id, value, length);
  if (refusal == SdoAbort::kNone) bytes = objectBytes(value, length);
  return refusal;
}

SdoAbort CanCommunicationObjects::readNumber(ObjectId id, std::uint32_t& value, std::size_t& length) const noexcept {
  const auto give = [&](std::uint32_t number, std::size_t bytes) {
    value = number;
    length = bytes;
    return SdoAbort::kNone;
  };
  const auto plain = [&](std::uint32_t number, std::size_t bytes) {
    return id.sub == 0 ? give(number, bytes) : SdoAbort::kNoSubIndex;
  };
  switch (id.index) {
    case 0x1000:
      return plain(device_type_, 4);
    case 0x1001:
      return plain(emergency_.errorRegister(), 1);
    case 0x1003:
      if (id.sub == 0) return give(emergency_.count(), 1);
      return id.sub <= emergency_.count() ? give(emergency_.entry(id.sub - 1u), 4) : SdoAbort::kNoSubIndex;
    case 0x1005:
      return plain(communication_.sync_cob_id, 4);
    case 0x100C:
      return plain(communication_.guard_time, 2);
    case 0x100D:
      return plain(communication_.life_factor, 1);
    case 0x1010:
    case 0x1011:
      if (!stores()) return SdoAbort::kNoObject;
      if (id.sub > 1) return SdoAbort::kNoSubIndex;
      return id.sub == 0 ? give(1, 1) : give(kStoresOnCommand, 4);
    case 0x1014:
      return plain(communication_.emergency_cob_id, 4);
    case 0x1015:
      return plain(communication_.emergency_inhibit, 2);
    case 0x1016:
      if (id.sub == 0) return give(CanCommunication::kConsumers, 1);
      return id.sub <= CanCommunication::kConsumers ? give(communication_.consumers[id.sub - 1u], 4)
                                                    : SdoAbort::kNoSubIndex;
    case 0x1017:
      return plain(communication_.heartbeat, 2);
    case 0x1018: {
      const std::array<std::uint32_t, 4> numbers{identity_.vendor, identity_.product, identity_.revision,
                                                 identity_.serial};
      if (id.sub == 0) return give(4, 1);
      return id.sub <= 4 ? give(numbers[id.sub - 1u], 4) : SdoAbort::kNoSubIndex;
    }
    default:
      break;
  }
  if (id.index < 0x1200 || id.index >= 0x1200 + communication_.servers.size()) return SdoAbort::kNoObject;
  const SdoCobIds& server = communication_.servers[id.index - 0x1200u];
  if (id.sub == 0) return give(2, 1);
  if (id.sub > 2) return SdoAbort::kNoSubIndex;
  return give(id.sub == 1 ? server.request : server.answer, 4);
}

SdoAbort CanCommunicationObjects::write(ObjectId id, ByteView bytes) noexcept {
  ObjectBytes now;
  const SdoAbort missing = read(id, now);
  if (missing != SdoAbort::kNone) return missing;
  if (isText(id.index)) return SdoAbort::kReadOnly;
  if (bytes.size() != now.size()) return SdoAbort::kTypeOrLength;
  const std::uint32_t value = objectNumber(bytes);
  switch (id.index) {
    case 0x1003:
      if (id.sub != 0) return SdoAbort::kReadOnly;
      if (value != 0) return SdoAbort::kValueRange;  // only emptied
      emergency_.forget();
      return SdoAbort::kNone;
    case 0x1005:
      if ((value & kExtendedFrame) != 0 || (value & ~0x40000000u) > kCobIdMask) return SdoAbort::kValueRange;
      communication_.sync_cob_id = value;
      return SdoAbort::kNone;
    case 0x100C:
      communication_.guard_time = static_cast<std::uint16_t>(value);
      return SdoAbort::kNone;
    case 0x100D:
      communication_.life_factor = static_cast<std::uint8_t>(value);
      return SdoAbort::kNone;
    case 0x1010:
      if (id.sub == 0) return SdoAbort::kReadOnly;
      if (value != kSave) return SdoAbort::kNotStored;
      saved_ = communication_;
      return SdoAbort::kNone;
    case 0x1011:
      if (id.sub == 0) return SdoAbort::kReadOnly;
      if (value != kLoad) return SdoAbort::kNotStored;
      saved_ = factory_;  // from the next reset on (CiA 301 7.5.2.14)
      return SdoAbort::kNone;
    case 0x1014:
      if ((value & kExtendedFrame) != 0) return SdoAbort::kValueRange;
      communication_.emergency_cob_id = value;
      return SdoAbort::kNone;
    case 0x1015:
      communication_.emergency_inhibit = static_cast<std::uint16_t>(value);
      return SdoAbort::kNone;
    case 0x1016:
      return writeConsumer(id, value);
    case 0x1017:
      communication_.heartbeat = static_cast<std::uint16_t>(value);
      return SdoAbort::kNone;
    default:
      return id.index >= 0x1200 ? writeServer(id, value) : SdoAbort::kReadOnly;
  }
}

SdoAbort CanCommunicationObjects::writeConsumer(ObjectId id, std::uint32_t value) noexcept {
  if (id.sub == 0) return SdoAbort::kReadOnly;
  const std::uint32_t node = value >> 16;
  if (node > 127) return SdoAbort::kValueRange;
  communication_.consumers[id.sub - 1u] = value;
  return SdoAbort::kNone;
}

// The first server is always the default one (CiA 301 7.5.2.33); the others are the master's to set.
SdoAbort CanCommunicationObjects::writeServer(ObjectId id, std::uint32_t value) noexcept {
  if (id.sub == 0 || id.index == 0x1200) return SdoAbort::kReadOnly;
  if (!pre_operational_) return SdoAbort::kNotStored;
  const bool on = (value & kCobIdOff) == 0;
  if (on && (value > kCobIdMask || value < 0x180)) return SdoAbort::kValueRange;
  SdoCobIds& server = communication_.servers[id.index - 0x1200u];
  std::uint32_t& entry = id.sub == 1 ? server.request : server.answer;
  if (on && (entry & kCobIdOff) == 0 && entry != value) return SdoAbort::kNotStored;
  entry = value;
  return SdoAbort::kNone;
}

}  // namespace nord_driver::sim
