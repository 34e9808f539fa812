#include "cycle/position_bits.h"

#include <algorithm>

namespace nord_driver::cycle {

namespace {

// BU 0020 7.3.5, BU 0070 6.1: and bits 0 to 5 choose the element of the array.
constexpr unsigned kPosiconReferenceRun = 1u << 6, kPosiconTeachIn = 1u << 8, kPosiconQuitTeachIn = 1u << 9,
                   kPosiconResetPosition = 1u << 10;

std::int16_t withBits(std::int16_t word, unsigned bits) noexcept {
  return toSigned(static_cast<Word>(toWord(word) | bits));
}

}  // namespace

PositionBits::PositionBits(const std::optional<PositionSetup>& setup, profile::Series series, std::size_t carried)
    : series_(series), carried_(std::min(carried, profile::kMaxProcessValues)) {
  if (!setup) return;
  home_ = setup->home;
  teach_ = setup->teach;
  reset_ = setup->reset;
  if (setup->axis.by_element) array_ = setup->array;
  elements_ = setup->elements;
  scale_ = setup->axis.scale;
  referenced_ = setup->referenced;
  referenced_function_ = setup->referenced_function;
  referenced_element_ = referencedElement(*setup, series);
}

std::optional<std::size_t> PositionBits::placeOf(const WordNeed& need, const DeviceData& device,
                                                 std::uint8_t set) const noexcept {
  if (set < 1 || set > device.word_functions.size()) return std::nullopt;
  for (std::size_t place = need.first; place <= carried_ && place <= need.last; ++place) {
    if (carries(place, need, device.word_functions[set - 1u], series_)) return place - 1;
  }
  return std::nullopt;
}

Sentence PositionBits::bitRefusal(const char* drive, const PositionBit& bit, const Meaning& meaning,
                                  const DeviceData& device, std::uint8_t set) const noexcept {
  Sentence text;
  if (bit.carrier != PositionBit::Carrier::kControlBit && !placeOf(needOf(bit), device, set)) {
    text.format("drive %s: no setpoint carries the bit of %s", drive, meaning.key);
    return text;
  }
  const auto element = elementOf(bit);
  if (!element) return text;
  const bool known = *element <= device.bus_bit_functions.size();
  const std::uint16_t function = known ? device.bus_bit_functions[*element - 1u] : kUnknownFunction;
  if (function == bit.function) return text;
  FixedText<24> found;
  found.format(function == kUnknownFunction ? "could not be read" : "is %u", unsigned{function});
  text.format("drive %s: P480[-%02u] %s; set it to %u (%s), or %s to what its manual says", drive, unsigned{*element},
              found.c_str(), unsigned{bit.function}, meaning.name, meaning.function_key);
  return text;
}

Sentence PositionBits::homeRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept {
  Sentence text;
  if (home_) {
    text = bitRefusal(drive, *home_, {"position/home", "position/home_function", "reference run"}, device, set);
    if (!text.empty() || showsReference(device)) return text;
    FixedText<24> found;
    found.format(device.out_bit_function ? "is %u" : "could not be read",
                 unsigned{device.out_bit_function.value_or(0)});
    text.format(
        "drive %s: P481[-%02u] %s; set it to %u (reference known), or position/referenced_function to what its "
        "manual says",
        drive, unsigned{referenced_element_}, found.c_str(), unsigned{referenced_function_});
    return text;
  }
  text.format("drive %s: position/home is not configured: nobody knows by which bit it is asked for a reference run",
              drive);
  return text;
}

Sentence PositionBits::teachRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept {
  Sentence text;
  if (!teach_) {
    text.format("drive %s: position/teach_in is not configured: nobody knows by which bits it takes its position",
                drive);
    return text;
  }
  text =
      bitRefusal(drive, teach_->teach_in, {"position/teach_in", "position/teach_in_function", "teach-in"}, device, set);
  if (text.empty()) {
    text = bitRefusal(drive, teach_->quit,
                      {"position/quit_teach_in", "position/quit_teach_in_function", "quit teach-in"}, device, set);
  }
  if (text.empty() && teach_->array) text = arrayRefusal(drive, *teach_->array, teach_->element, device, set);
  return text;
}

Sentence PositionBits::resetRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept {
  if (reset_) {
    return bitRefusal(drive, *reset_, {"position/reset", "position/reset_function", "reset position"}, device, set);
  }
  Sentence text;
  text.format("drive %s: position/reset is not configured: nobody knows by which bit it sets its count anew", drive);
  return text;
}

Sentence PositionBits::arrayRefusal(const char* drive, const PositionBit& array, std::uint8_t element,
                                    const DeviceData& device, std::uint8_t set) const noexcept {
  Sentence text;
  for (unsigned bit = 0; text.empty() && bit < kArrayBits; ++bit) {
    if ((element >> bit & 1u) == 0) continue;
    FixedText<32> name;
    name.format("bit %u of the position array", bit);
    text = bitRefusal(drive, arrayBit(array, bit), {"position/array_bit", "position/array_function", name.c_str()},
                      device, set);
  }
  return text;
}

Sentence PositionBits::elementRefusal(const char* drive, std::uint8_t element, const DeviceData& device,
                                      std::uint8_t set) const noexcept {
  Sentence text;
  if (element < 1 || element > elements_) {
    text.format("drive %s: of its array elements 1 to %u are used (position/elements)", drive, unsigned{elements_});
  } else if (array_) {
    text = arrayRefusal(drive, *array_, element, device, set);
  }
  return text;
}

void PositionBits::putElement(std::uint8_t element, profile::ProcessOutput& output, const DeviceData& device,
                              std::uint8_t set) const noexcept {
  if (array_ && element != 0) put(*array_, element, element, output, device, set);
}

double PositionBits::inJoint(std::int32_t raw) const noexcept {
  return profile::toJoint(raw, profile::arrayScale(scale_), profile::kArrayField);
}

void PositionBits::put(const PositionBit& bit, unsigned value, unsigned posicon, profile::ProcessOutput& output,
                       const DeviceData& device, std::uint8_t set) const noexcept {
  if (output.control_word == 0) return;
  if (bit.carrier == PositionBit::Carrier::kControlBit) {
    output.control_word = static_cast<Word>(output.control_word | value << bit.number);
    return;
  }
  const auto place = placeOf(needOf(bit), device, set);
  if (!place) return;
  const bool in_posicon = bit.carrier == PositionBit::Carrier::kPosicon;
  output.setpoints[*place] = withBits(output.setpoints[*place], in_posicon ? posicon : value << bit.number);
}

void PositionBits::putHome(profile::ProcessOutput& output, const DeviceData& device, std::uint8_t set) const noexcept {
  if (home_) put(*home_, 1, kPosiconReferenceRun, output, device, set);
}

void PositionBits::putTeach(const drive::TeachBits& bits, profile::ProcessOutput& output, const DeviceData& device,
                            std::uint8_t set) const noexcept {
  if (!teach_ || !bits.teach_in) return;
  put(teach_->teach_in, 1, kPosiconTeachIn, output, device, set);
  if (teach_->array) put(*teach_->array, teach_->element, teach_->element, output, device, set);
  if (bits.quit) put(teach_->quit, 1, kPosiconQuitTeachIn, output, device, set);
}

void PositionBits::putReset(profile::ProcessOutput& output, const DeviceData& device, std::uint8_t set) const noexcept {
  if (reset_) put(*reset_, 1, kPosiconResetPosition, output, device, set);
}

std::int32_t PositionBits::inArray(double joint) const noexcept {
  return profile::toSteps(joint, profile::arrayScale(scale_), profile::kArrayField).value_or(0);
}

std::optional<bool> PositionBits::referenced(const profile::ProcessInput& input, const DeviceData& device,
                                             std::uint8_t set) const noexcept {
  if (!referenced_ || !showsReference(device)) return std::nullopt;
  if (referenced_->source == SignalSource::kStatusBit) return (input.status_word >> referenced_->number & 1u) != 0;
  const auto place = placeOf({true, profile::WordUse::kBusBits}, device, set);
  if (!place) return std::nullopt;
  return (toWord(input.actual_values[*place]) >> referenced_->number & 1u) != 0;
}

}  // namespace nord_driver::cycle
