#include "sim/canopen/can_parameter_objects.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr unsigned kObjectOffset = 0x2000;

SdoAbort abortOf(ParameterError error, const ParameterDefinition& definition, std::int32_t raw) noexcept {
  switch (error) {
    case ParameterError::kInvalidNumber:
      return SdoAbort::kNoObject;
    case ParameterError::kNotChangeable:
      return SdoAbort::kReadOnly;
    case ParameterError::kLimits:
      return raw > definition.maximum ? SdoAbort::kTooHigh : SdoAbort::kTooLow;
    case ParameterError::kSubIndex:
    case ParameterError::kNoArray:
      return SdoAbort::kNoSubIndex;
    case ParameterError::kDataType:
      return SdoAbort::kTypeOrLength;
    default:
      return SdoAbort::kNotStored;
  }
}

/// The refusal an experimenter chose by the error number of the parameter channel (BU 0020 7.5.1).
SdoAbort abortOf(Word error) noexcept {
  if (error == static_cast<Word>(ParameterError::kLimits)) return SdoAbort::kTooHigh;
  return abortOf(static_cast<ParameterError>(error), ParameterDefinition{}, 0);
}

std::size_t lengthOf(const ParameterDefinition& definition) noexcept {
  return definition.double_word ? 4 : 2;
}

/// Hexadecimal parameters use all 16 bits without a sign.
std::int32_t rawOf(ByteView bytes, const ParameterDefinition& definition) noexcept {
  const std::uint32_t bits = objectNumber(bytes);
  if (definition.double_word) return static_cast<std::int32_t>(bits);
  return definition.maximum > 0x7FFF ? static_cast<std::int32_t>(bits) : toSigned(static_cast<Word>(bits));
}

}  // namespace

SdoAbort CanParameterObjects::absence(unsigned number) const noexcept {
  if (drive_ == nullptr) return SdoAbort::kNone;
  const ParameterSwitches& switches = drive_->parameterSwitches();
  if (const auto code = switches.busRefusal(number)) return static_cast<SdoAbort>(*code);
  if (switches.refuse && (!switches.refuse->number || *switches.refuse->number == number)) {
    return abortOf(switches.refuse->error);
  }
  return drive_->inverter().powered() && drive_->inverterLink() ? SdoAbort::kNone : SdoAbort::kHardware;
}

CanParameterObjects::Place CanParameterObjects::find(ObjectId id) const noexcept {
  Place place;
  const unsigned number = id.index - kObjectOffset;
  const auto refused = [&](SdoAbort refusal) {
    place.refusal = refusal;
    return place;
  };
  const SdoAbort absent = absence(number);
  if (absent != SdoAbort::kNone) return refused(absent);
  place.definition = parameters_.find(number);
  if (place.definition == nullptr) return refused(SdoAbort::kNoObject);
  const bool per_set = place.definition->per_set;
  const unsigned elements = place.definition->elements;
  if (!per_set && elements == 0) return id.sub == 0 ? place : refused(SdoAbort::kNoSubIndex);
  if (id.sub == 0) {
    place.is_count = true;
    return place;
  }
  const unsigned from_zero = id.sub - 1u;
  const bool by_table = per_set || array_sub_by_table_;
  place.set = per_set ? from_zero % ParameterStore::kSets : 0;
  place.element = by_table ? from_zero / ParameterStore::kSets : from_zero;
  const bool in_column = per_set || !by_table || from_zero % ParameterStore::kSets == 0;
  if (!in_column || place.element >= std::max(elements, 1u)) return refused(SdoAbort::kNoSubIndex);
  return place;
}

SdoAbort CanParameterObjects::read(ObjectId id, ObjectBytes& bytes) noexcept {
  const Place place = find(id);
  if (place.refusal != SdoAbort::kNone) return place.refusal;
  const ParameterDefinition& definition = *place.definition;
  if (place.is_count) {  // the highest sub-index, as CiA 301 has it; the manuals do not say
    const unsigned elements = std::max<unsigned>(definition.elements, 1);
    const bool by_table = definition.per_set || array_sub_by_table_;
    bytes = objectBytes(by_table ? elements * ParameterStore::kSets : elements, 1);
    return SdoAbort::kNone;
  }
  const std::int32_t raw = parameters_.value(definition.number, place.set, place.element);
  bytes = objectBytes(static_cast<std::uint32_t>(raw), lengthOf(definition));
  return SdoAbort::kNone;
}

SdoAbort CanParameterObjects::write(ObjectId id, ByteView bytes) noexcept {
  const Place place = find(id);
  if (place.refusal != SdoAbort::kNone) return place.refusal;
  const ParameterDefinition& definition = *place.definition;
  if (place.is_count) return SdoAbort::kReadOnly;
  if (bytes.size() != lengthOf(definition)) return SdoAbort::kTypeOrLength;
  const std::int32_t raw = rawOf(bytes, definition);
  // An SDO has no way to say "not into the EEPROM" but P560, and that is the inverter's.
  const bool to_ram = parameters_.find(560) != nullptr && parameters_.value(560) == 0;
  const Storage storage = to_ram ? Storage::kRam : Storage::kEeprom;
  const auto error = parameters_.write(definition.number, place.set, place.element, raw, storage);
  return error ? abortOf(*error, definition, raw) : SdoAbort::kNone;
}

}  // namespace nord_driver::sim
