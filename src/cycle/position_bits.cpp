#include "cycle/position_bits.h"

#include <algorithm>

namespace nord_driver::cycle {

namespace {

constexpr unsigned kPosiconReferenceRun = 1u << 6;  // BU 0020 7.3.5

std::int16_t withBits(std::int16_t word, unsigned bits) noexcept {
  return toSigned(static_cast<Word>(toWord(word) | bits));
}

}  // namespace

PositionBits::PositionBits(const std::optional<PositionSetup>& setup, profile::Series series, std::size_t carried)
    : series_(series), carried_(std::min(carried, profile::kMaxProcessValues)) {
  if (!setup) return;
  home_ = setup->home;
  referenced_ = setup->referenced;
}

std::optional<std::size_t> PositionBits::placeOf(const WordNeed& need, const DeviceData& device,
                                                 std::uint8_t set) const noexcept {
  if (set < 1 || set > device.word_functions.size()) return std::nullopt;
  for (std::size_t place = need.first; place <= carried_ && place <= need.last; ++place) {
    if (carries(place, need, device.word_functions[set - 1u], series_)) return place - 1;
  }
  return std::nullopt;
}

Sentence PositionBits::homeRefusal(const char* drive, const DeviceData& device, std::uint8_t set) const noexcept {
  Sentence text;
  if (!home_) {
    text.format("drive %s: position/home is not configured: nobody knows by which bit it is asked for a reference run",
                drive);
    return text;
  }
  if (home_->carrier != HomeBit::Carrier::kControlBit && !placeOf(needOf(*home_), device, set)) {
    text.format("drive %s: no setpoint carries the bit of position/home", drive);
    return text;
  }
  const auto element = elementOf(*home_);
  if (!element) return text;
  const bool known = *element <= device.bus_bit_functions.size();
  const std::uint16_t function = known ? device.bus_bit_functions[*element - 1u] : kUnknownFunction;
  if (function == home_->function) return text;
  FixedText<24> found;
  found.format(function == kUnknownFunction ? "could not be read" : "is %u", unsigned{function});
  text.format(
      "drive %s: P480[-%02u] %s; set it to %u (reference run), or position/home_function to what its manual says",
      drive, unsigned{*element}, found.c_str(), unsigned{home_->function});
  return text;
}

void PositionBits::putHome(profile::ProcessOutput& output, const DeviceData& device, std::uint8_t set) const noexcept {
  if (!home_ || output.control_word == 0) return;
  if (home_->carrier == HomeBit::Carrier::kControlBit) {
    output.control_word = static_cast<Word>(output.control_word | 1u << home_->number);
    return;
  }
  const auto place = placeOf(needOf(*home_), device, set);
  if (!place) return;
  const bool posicon = home_->carrier == HomeBit::Carrier::kPosicon;
  output.setpoints[*place] = withBits(output.setpoints[*place], posicon ? kPosiconReferenceRun : 1u << home_->number);
}

std::optional<bool> PositionBits::referenced(const profile::ProcessInput& input, const DeviceData& device,
                                             std::uint8_t set) const noexcept {
  if (!referenced_) return std::nullopt;
  if (referenced_->source == SignalSource::kStatusBit) return (input.status_word >> referenced_->number & 1u) != 0;
  const auto place = placeOf({true, profile::WordUse::kBusBits, 2, 3}, device, set);
  if (!place) return std::nullopt;
  return (toWord(input.actual_values[*place]) >> referenced_->number & 1u) != 0;
}

}  // namespace nord_driver::cycle
