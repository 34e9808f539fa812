#include "sim/devicenet/dn_parameter_objects.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr unsigned kFirstClass = 100;
constexpr unsigned kClassesOfOne = 10;
constexpr unsigned kThousand = 8;  // classes 100 to 107: P000 to P799
constexpr std::uint8_t kModuleClass = 181;
constexpr unsigned kModuleBase = 180;
constexpr std::uint8_t kIndexClass = 199;

// Attributes of class 199.
constexpr std::uint8_t kNumber = 1;
constexpr std::uint8_t kSubIndex = 2;
constexpr std::uint8_t kShortValue = 3;
constexpr std::uint8_t kLongValue = 4;

CipStatus statusOf(ParameterError error) noexcept {
  switch (error) {
    case ParameterError::kInvalidNumber:
      return CipStatus::kNoAttribute;
    case ParameterError::kNotChangeable:
      return CipStatus::kNotSettable;
    case ParameterError::kLimits:
      return CipStatus::kInvalidValue;
    case ParameterError::kSubIndex:
    case ParameterError::kNoArray:
      return CipStatus::kNoObject;
    case ParameterError::kDataType:
      return CipStatus::kTooMuchData;
    default:
      return CipStatus::kVendorSpecific;
  }
}

bool isInverterClass(std::uint8_t class_id) noexcept {
  return class_id >= kFirstClass && class_id < kFirstClass + 4 * kClassesOfOne &&
         (class_id - kFirstClass) % kClassesOfOne < kThousand;
}

}  // namespace

bool DnParameterObjects::hasClass(std::uint8_t class_id) const noexcept {
  return isInverterClass(class_id) || class_id == kIndexClass || (class_id == kModuleClass && module_ != nullptr);
}

DriveUnit* DnParameterObjects::driveOf(const CipAddress& at) noexcept {
  if (isInverterClass(at.class_id)) return process_.drive((at.class_id - kFirstClass) / kClassesOfOne);
  if (at.class_id == kModuleClass || at.instance == 0 || at.instance > DnProcess::kInverters) return nullptr;
  return process_.drive(at.instance - 1u);
}

DnParameterObjects::Place DnParameterObjects::findIn(ParameterStore& store, unsigned number,
                                                     unsigned sub_index) noexcept {
  Place place;
  place.store = &store;
  place.definition = store.find(number);
  if (place.definition == nullptr) {
    place.refusal = CipStatus::kNoAttribute;
    return place;
  }
  const bool per_set = place.definition->per_set;
  place.set = per_set ? sub_index % ParameterStore::kSets : 0;
  place.element = per_set ? sub_index / ParameterStore::kSets : sub_index;
  place.size = place.definition->double_word ? 4 : 2;
  if (place.element >= std::max<unsigned>(place.definition->elements, 1)) place.refusal = CipStatus::kNoObject;
  return place;
}

// "If parameters are accessed for FIs which are not connected, the bus module responds with Resource unavailable"
// (BU 0280 4.1.2).
DnParameterObjects::Place DnParameterObjects::findIn(std::size_t inverter, unsigned number,
                                                     unsigned sub_index) noexcept {
  Place place;
  DriveUnit* drive = process_.drive(inverter);
  if (!process_.present(inverter)) {
    place.refusal = CipStatus::kResourceUnavailable;
    return place;
  }
  const ParameterSwitches& switches = drive->parameterSwitches();
  if (const auto code = switches.busRefusal(number)) {
    place.refusal = static_cast<CipStatus>(*code);
    return place;
  }
  if (switches.refuse && (!switches.refuse->number || *switches.refuse->number == number)) {
    place.refusal = statusOf(static_cast<ParameterError>(switches.refuse->error));
    return place;
  }
  return findIn(drive->parameters(), number, sub_index);
}

DnParameterObjects::Place DnParameterObjects::find(const CipAddress& at) noexcept {
  Place place;
  if (at.class_id == kIndexClass) {
    if (at.instance == 0 || at.instance > DnProcess::kInverters) {
      place.refusal = CipStatus::kNoObject;
      return place;
    }
    const Index& index = index_[at.instance - 1u];
    place.size = at.attribute == kLongValue ? 4 : 2;
    place.nothing = index.number == 0;
    if (place.nothing) return place;
    place = findIn(at.instance - 1u, index.number, index.sub_index);
    const std::size_t asked = at.attribute == kLongValue ? 4 : 2;
    // "An error message for an incorrect parameter size" (BU 0280 4.3.10).
    if (place.refusal == CipStatus::kOk && place.size != asked) {
      place.refusal = asked > place.size ? CipStatus::kTooMuchData : CipStatus::kNotEnoughData;
    }
    return place;
  }
  if (at.instance == 0) {
    place.refusal = CipStatus::kNoObject;
    return place;
  }
  const unsigned sub_index = at.instance - 1u;
  if (at.class_id == kModuleClass) {
    place = findIn(*module_, (kModuleClass - kModuleBase) * 100u + at.attribute, sub_index);
    place.of_module = true;
    return place;
  }
  const unsigned row = at.class_id - kFirstClass;
  return findIn(row / kClassesOfOne, row % kClassesOfOne * 100u + at.attribute, sub_index);
}

CipStatus DnParameterObjects::get(const CipAddress& at, CipBytes& value) noexcept {
  if (at.class_id == kIndexClass && (at.attribute == kNumber || at.attribute == kSubIndex)) {
    if (at.instance == 0 || at.instance > DnProcess::kInverters) return CipStatus::kNoObject;
    const Index& index = index_[at.instance - 1u];
    at.attribute == kNumber ? put(value, index.number, 2) : put(value, index.sub_index, 1);
    return CipStatus::kOk;
  }
  if (at.class_id == kIndexClass && at.attribute != kShortValue && at.attribute != kLongValue) {
    return CipStatus::kNoAttribute;
  }
  const Place place = find(at);
  if (place.refusal != CipStatus::kOk) return place.refusal;
  const std::int32_t raw = place.nothing ? 0 : place.store->value(place.definition->number, place.set, place.element);
  put(value, static_cast<std::uint32_t>(raw), place.size);
  return CipStatus::kOk;
}

CipStatus DnParameterObjects::set(const CipAddress& at, ByteView value, CipBytes& /*answer*/) noexcept {
  if (at.class_id == kIndexClass && (at.attribute == kNumber || at.attribute == kSubIndex)) {
    if (at.instance == 0 || at.instance > DnProcess::kInverters) return CipStatus::kNoObject;
    const CipStatus size = checkSize(value, at.attribute == kNumber ? 2 : 1);
    if (size != CipStatus::kOk) return size;
    Index& index = index_[at.instance - 1u];
    if (at.attribute == kNumber) index.number = static_cast<std::uint16_t>(number(value));
    if (at.attribute == kSubIndex) index.sub_index = static_cast<std::uint8_t>(number(value));
    return CipStatus::kOk;
  }
  if (at.class_id == kIndexClass && at.attribute != kShortValue && at.attribute != kLongValue) {
    return CipStatus::kNoAttribute;
  }
  const Place place = find(at);
  if (place.refusal != CipStatus::kOk) return place.refusal;
  const CipStatus size = checkSize(value, place.size);
  if (size != CipStatus::kOk) return size;
  if (place.nothing) return CipStatus::kOk;
  const ParameterDefinition& definition = *place.definition;
  const std::uint32_t bits = number(value);
  // Hexadecimal parameters use all 16 bits without a sign.
  const bool is_signed = place.size == 2 && definition.maximum <= 0x7FFF;
  const std::int32_t raw = is_signed ? toSigned(static_cast<Word>(bits)) : static_cast<std::int32_t>(bits);
  const bool to_ram = !place.of_module && place.store->find(560) != nullptr && place.store->value(560) == 0;
  const auto error =
      place.store->write(definition.number, place.set, place.element, raw, to_ram ? Storage::kRam : Storage::kEeprom);
  return error ? statusOf(*error) : CipStatus::kOk;
}

}  // namespace nord_driver::sim
