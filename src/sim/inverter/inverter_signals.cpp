// Terminals and single bits of the inverter: bus I/O bits with their functions in P480, and what it shows of its inputs.
// BU 0020 6.1, 6.2, 7.3.7; BU 0220 5.1.3, 7.2.1.7; BU 0280 5.1.2.

#include <array>

#include "sim/inverter/inverter_model.h"

namespace nord_driver::sim {

namespace {

// "Bus I/O in bits 0-7" in P546 to P548.
constexpr std::int32_t kBits = 17;           // SK 5xxE, and P547 and P548 of SK 300E and 7x0E
constexpr std::int32_t kDecentralBits = 20;  // SK 1x0E and 2xxE, as BU 0220 has it
constexpr std::int32_t kOlderFirstBits = 7;  // P546 of SK 300E and 7x0E
// P480, as the digital inputs.
constexpr std::int32_t kEnableRight = 1, kEnableLeft = 2, kAcknowledge = 12;
constexpr unsigned kBusBits = 8;
constexpr unsigned kBit8Element = 10, kBit9Element = 11;

}  // namespace

bool InverterModel::carriesBits(unsigned n) const noexcept {
  const unsigned place = setpointPlace(n);
  std::int32_t expected = parameters_.device().isDecentral() ? kDecentralBits : kBits;
  if (place == 0 && parameters_.device().isOlderSeries()) expected = kOlderFirstBits;
  return busFunction(546, place) == expected;
}

std::uint8_t InverterModel::busInBits() const noexcept {
  unsigned bits = 0;
  for (unsigned n = 0; n < data_.setpoints.size(); ++n) {
    if (carriesBits(n)) bits |= data_.setpoints[n] & 0xFFu;
  }
  return static_cast<std::uint8_t>(bits);
}

// Something on the bus is high whose function is this one.
bool InverterModel::busBitIs(std::int32_t function) const noexcept {
  const unsigned bits = busInBits();
  for (unsigned bit = 0; bit < kBusBits; ++bit) {
    if ((bits >> bit & 1u) != 0 && parameters_.value(480, set_, bit) == function) return true;
  }
  if (parameters_.device().isOlderSeries()) return false;  // eight elements
  return ((data_.control & stw::kBit8) != 0 && parameters_.value(480, set_, kBit8Element) == function) ||
         ((data_.control & stw::kBit9) != 0 && parameters_.value(480, set_, kBit9Element) == function);
}

// A bit that the bus carries has this function, high or low.
bool InverterModel::busBitHasFunction(std::int32_t function) const noexcept {
  bool word = false;
  for (unsigned n = 0; n < data_.carried; ++n) word = word || carriesBits(n);
  for (unsigned element = 0; element < kBusBits; ++element) {
    if (word && parameters_.value(480, set_, element) == function) return true;
  }
  return !parameters_.device().isOlderSeries() && (parameters_.value(480, set_, kBit8Element) == function ||
                                                   parameters_.value(480, set_, kBit9Element) == function);
}

// Past the control word: the bits are perceived as digital inputs.
bool InverterModel::busBitsEnable() const noexcept {
  return commanded_ && (busBitIs(kEnableRight) || busBitIs(kEnableLeft));
}

bool InverterModel::busBitsAcknowledge() const noexcept {
  return commanded_ && busBitIs(kAcknowledge);
}

double InverterModel::busBitFrequency() const noexcept {
  return busBitIs(kEnableRight) ? terminals_.frequency : -terminals_.frequency;
}

}  // namespace nord_driver::sim
