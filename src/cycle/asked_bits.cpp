#include "cycle/asked_bits.h"

#include "cycle/word_needs.h"

namespace nord_driver::cycle {

namespace {

constexpr std::uint16_t kBusInBits = 480, kBusOutBits = 481;

void addBit(const PositionBit& bit, const char* key, std::vector<AskedBit>& to) {
  const auto element = elementOf(bit);
  if (element) to.push_back({kBusInBits, *element, bit.function, key});
}

/// `high`: the bits of the element's number that may be.
void addArray(const PositionBit& array, unsigned high, std::vector<AskedBit>& to) {
  for (unsigned bit = 0; bit < kArrayBits; ++bit) {
    if ((high >> bit & 1u) != 0) addBit(arrayBit(array, bit), "position/array_bit", to);
  }
}

}  // namespace

std::vector<AskedBit> askedBits(const PositionSetup& setup, profile::Series series) {
  std::vector<AskedBit> asked;
  if (setup.home) addBit(*setup.home, "position/home", asked);
  if (setup.reset) addBit(*setup.reset, "position/reset", asked);
  if (setup.teach) {
    addBit(setup.teach->teach_in, "position/teach_in", asked);
    addBit(setup.teach->quit, "position/quit_teach_in", asked);
  }
  if (setup.axis.by_element && setup.array) {
    addArray(*setup.array, allBits(setup.elements), asked);
  } else if (setup.teach && setup.teach->array) {
    addArray(*setup.teach->array, setup.teach->element, asked);
  }
  const std::uint8_t referenced = referencedElement(setup, series);
  if (referenced != 0) asked.push_back({kBusOutBits, referenced, setup.referenced_function, "position/referenced"});
  return asked;
}

}  // namespace nord_driver::cycle
