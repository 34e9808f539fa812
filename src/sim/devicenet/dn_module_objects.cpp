// What a module tells of itself: identity, DeviceNet object, assemblies, connections, acknowledge handler.
// BU 0280 4.3.1 to 4.3.4 and 4.3.8.

#include "sim/devicenet/dn_module.h"
#include "sim/drive_unit.h"

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kIdentity = 1;
constexpr std::uint8_t kDeviceNet = 3;
constexpr std::uint8_t kAssembly = 4;
constexpr std::uint8_t kConnection = 5;
constexpr std::uint8_t kAcknowledgeHandler = 43;

constexpr std::uint8_t kData = 3;  // the only attribute of an assembly
constexpr std::uint8_t kPacketRate = 9;

// Bits of the device status.
constexpr unsigned kOwned = 1u << 0;
constexpr unsigned kConfigured = 1u << 2;
constexpr unsigned kInverterFault = 1u << 8;

constexpr std::size_t kPathLength = 6;

bool isAssembly(std::uint8_t instance) noexcept {
  switch (instance) {
    case 20:
    case 21:
    case 70:
    case 71:
    case 100:
    case 101:
    case 102:
    case 110:
    case 111:
    case 112:
    case 120:
    case 130:
      return true;
    default:
      return false;
  }
}

/// Of those that there are.
bool isInput(std::uint8_t instance) noexcept {
  return instance == 70 || instance == 71 || (instance >= 110 && instance <= 112) || instance == 130;
}

}  // namespace

bool DnModule::hasClass(std::uint8_t class_id) const noexcept {
  return class_id == kIdentity || (class_id >= kDeviceNet && class_id <= kConnection) ||
         class_id == kAcknowledgeHandler;
}

CipStatus DnModule::get(const CipAddress& at, CipBytes& value) noexcept {
  if (at.class_id == kConnection) {
    if (at.instance == 0 || at.instance > kDnConnections) return CipStatus::kNoObject;
    return getConnection(static_cast<DnConnectionKind>(at.instance - 1u), at.attribute, value);
  }
  if (at.class_id == kAssembly) {
    if (!isAssembly(at.instance)) return CipStatus::kNoObject;
    if (at.attribute != kData) return CipStatus::kNoAttribute;
    // "Reading and writing can only be carried out for the active instance" (BU 0280 4.3.3).
    const DnLayout active = layout();
    if (at.instance == dnInputInstanceOf(active.instance)) {
      for (const std::uint8_t byte : process_.inputs(active)) value.push_back(byte);
      return CipStatus::kOk;
    }
    if (at.instance != active.instance) return CipStatus::kStateConflict;
    for (const std::uint8_t byte : process_.outputs()) value.push_back(byte);
    value.resize(active.outputs());
    return CipStatus::kOk;
  }
  if (at.instance != 1) return CipStatus::kNoObject;
  if (at.class_id == kIdentity) return getIdentity(at.attribute, value);
  if (at.class_id == kDeviceNet) return getDeviceNet(at.attribute, value);
  switch (at.attribute) {
    case 1:
      put(value, acknowledge_time_, 2);
      return CipStatus::kOk;
    case 2:
      put(value, retry_limit_, 1);
      return CipStatus::kOk;
    case 3:
      put(value, 4, 2);
      return CipStatus::kOk;
    default:
      return CipStatus::kNoAttribute;
  }
}

CipStatus DnModule::set(const CipAddress& at, ByteView value, CipBytes& answer) noexcept {
  if (at.class_id == kConnection) {
    if (at.instance == 0 || at.instance > kDnConnections) return CipStatus::kNoObject;
    return setConnection(static_cast<DnConnectionKind>(at.instance - 1u), at.attribute, value, answer);
  }
  if (at.class_id == kAssembly) {
    if (!isAssembly(at.instance)) return CipStatus::kNoObject;
    if (at.attribute != kData) return CipStatus::kNoAttribute;
    const DnLayout active = layout();
    if (isInput(at.instance)) return CipStatus::kNotSettable;
    if (at.instance != active.instance) return CipStatus::kStateConflict;
    const CipStatus size = checkSize(value, active.outputs());
    if (size != CipStatus::kOk) return size;
    running_layout_ = active;
    take(value, false);
    return CipStatus::kOk;
  }
  if (at.instance != 1) return CipStatus::kNoObject;
  if (at.class_id == kIdentity)
    return at.attribute >= 1 && at.attribute <= 7 ? CipStatus::kNotSettable : CipStatus::kNoAttribute;
  if (at.class_id == kDeviceNet) {
    if (at.attribute != 4)
      return at.attribute >= 1 && at.attribute <= 9 ? CipStatus::kNotSettable : CipStatus::kNoAttribute;
    const CipStatus size = checkSize(value, 1);
    if (size != CipStatus::kOk) return size;
    if (value[0] != 0) return CipStatus::kInvalidValue;  // only 0, to reset it
    bus_off_counter_ = 0;
    return CipStatus::kOk;
  }
  if (at.attribute == 3) return CipStatus::kNotSettable;
  if (at.attribute != 1 && at.attribute != 2) return CipStatus::kNoAttribute;
  const CipStatus size = checkSize(value, at.attribute == 1 ? 2 : 1);
  if (size != CipStatus::kOk) return size;
  if (number(value) == 0 && at.attribute == 1) return CipStatus::kInvalidValue;
  if (at.attribute == 1) acknowledge_time_ = static_cast<std::uint16_t>(number(value));
  if (at.attribute == 2) retry_limit_ = static_cast<std::uint8_t>(number(value));
  return CipStatus::kOk;
}

CipStatus DnModule::getIdentity(std::uint8_t attribute, CipBytes& value) noexcept {
  const DnIdentity& identity = settings_.identity;
  switch (attribute) {
    case 1:
      put(value, identity.vendor, 2);
      return CipStatus::kOk;
    case 2:
      put(value, identity.device_type, 2);
      return CipStatus::kOk;
    case 3:
      put(value, identity.product, 2);
      return CipStatus::kOk;
    case 4:
      put(value, identity.major, 1);
      put(value, identity.minor, 1);
      return CipStatus::kOk;
    case 5: {
      unsigned status = connections_.owner() == dn::kNoMac ? 0u : kOwned;
      for (unsigned place = 0; place < kPlaces; ++place) {
        if (!present(place)) continue;
        status |= kConfigured;
        if (driveAt(place)->inverter().faultNumber() != 0) status |= kInverterFault;
      }
      put(value, status, 2);
      return CipStatus::kOk;
    }
    case 6:
      put(value, identity.serial, 4);
      return CipStatus::kOk;
    case 7:
      put(value, static_cast<std::uint32_t>(settings_.name.size()), 1);
      for (const char letter : settings_.name) value.push_back(static_cast<std::uint8_t>(letter));
      return CipStatus::kOk;
    default:
      return CipStatus::kNoAttribute;
  }
}

std::uint8_t DnModule::bitRateCode() const noexcept {
  return settings_.bit_rate == 125000 ? 0 : settings_.bit_rate == 250000 ? 1 : 2;
}

CipStatus DnModule::getDeviceNet(std::uint8_t attribute, CipBytes& value) noexcept {
  const auto byte = [&](unsigned number) {
    put(value, number, 1);
    return CipStatus::kOk;
  };
  switch (attribute) {
    case 1:
    case 8:
      return byte(mac());
    case 2:
    case 9:
      return byte(bitRateCode());
    case 3:  // BOI: it stays off the bus
    case 6:
    case 7:
      return byte(0);
    case 4:
      return byte(bus_off_counter_);
    case 5:
      put(value, connections_.choice(), 1);
      return byte(connections_.owner());
    default:
      return CipStatus::kNoAttribute;
  }
}

CipStatus DnModule::getConnection(DnConnectionKind kind, std::uint8_t attribute, CipBytes& value) noexcept {
  const DnConnection& connection = connections_[kind];
  if (connection.state == DnConnectionState::kNone) return CipStatus::kNoObject;
  const bool is_explicit = kind == DnConnectionKind::kExplicit;
  const bool produces_itself = kind == DnConnectionKind::kChangeOfState;
  const bool strobe = kind == DnConnectionKind::kStrobe;
  // Of change of state and cyclic: what acknowledges our data, and what takes acknowledges alone.
  const bool acknowledges = kind == DnConnectionKind::kPoll && !connections_.has(dn::kChoicePoll);
  const bool is_acknowledged = produces_itself && connections_.taking() != kind;
  const auto number = [&](std::uint32_t what, std::size_t size) {
    put(value, what, size);
    return CipStatus::kOk;
  };
  const auto path = [&](unsigned instance) {
    for (const unsigned byte : {0x20u, 0x04u, 0x24u, instance, 0x30u, 0x03u}) put(value, byte, 1);
    return CipStatus::kOk;
  };
  switch (attribute) {
    case 1:
      return number(static_cast<unsigned>(connection.state), 1);
    case 2:
      return number(is_explicit ? 0 : 1, 1);
    case 3: {  // an explicit server, an I/O server, a client that wants acknowledges or does not
      const bool quiet = connections_.has(dn::kChoiceNoAcknowledge);
      const bool cyclic = connections_.has(dn::kChoiceCyclic);
      const unsigned client = (cyclic ? 0x00u : 0x10u) | (quiet ? 0x00u : 0x03u);
      const unsigned server = acknowledges && quiet ? 0x80 : 0x82;
      return number(is_explicit ? 0x83 : produces_itself ? client : server, 1);
    }
    case 4: {
      const unsigned message = strobe ? dn::kStrobeResponse : produces_itself ? dn::kChangeOfState : dn::kPollResponse;
      return number(is_explicit ? dn::group2(dn::kSlaveExplicit, mac()) : dn::group1(message, mac()), 2);
    }
    case 5: {
      if (strobe) return number(dn::group2(dn::kStrobeCommand, connections_.owner()), 2);
      const unsigned message = is_explicit ? dn::kMasterExplicit : is_acknowledged ? dn::kAcknowledge : dn::kPoll;
      return number(dn::group2(message, mac()), 2);
    }
    case 6:
      return number(is_explicit ? 0x21 : strobe ? 0x02 : 0x01, 1);
    case 7:
      return number(connection.produced, 2);
    case 8:
      return number(connection.consumed, 2);
    case kPacketRate:
      return number(connection.packet_rate, 2);
    case 12:  // auto delete; time out
      return number(is_explicit ? 1 : 0, 1);
    case 13:
      return number(is_explicit || acknowledges ? 0 : kPathLength, 2);
    case 14:
      return is_explicit || acknowledges ? CipStatus::kOk : path(dnInputInstanceOf(running_layout_.instance));
    case 15:
      return number(is_explicit || is_acknowledged ? 0 : kPathLength, 2);
    case 16:
      return is_explicit || is_acknowledged ? CipStatus::kOk : path(running_layout_.instance);
    case 17:
      return number(0, 2);
    default:
      return CipStatus::kNoAttribute;
  }
}

// Only the expected packet rate can be set; the answer tells to what it was rounded.
CipStatus DnModule::setConnection(DnConnectionKind kind, std::uint8_t attribute, ByteView value,
                                  CipBytes& answer) noexcept {
  if (connections_[kind].state == DnConnectionState::kNone) return CipStatus::kNoObject;
  if (attribute != kPacketRate) {
    const bool known = (attribute >= 1 && attribute <= 8) || (attribute >= 12 && attribute <= 17);
    return known ? CipStatus::kNotSettable : CipStatus::kNoAttribute;
  }
  const CipStatus size = checkSize(value, 2);
  if (size != CipStatus::kOk) return size;
  if (!connections_.setPacketRate(kind, static_cast<std::uint16_t>(number(value)))) return CipStatus::kStateConflict;
  put(answer, connections_[kind].packet_rate, 2);
  return CipStatus::kOk;
}

}  // namespace nord_driver::sim
