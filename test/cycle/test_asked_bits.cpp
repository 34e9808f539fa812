// What P480 and P481 have to say of the bits of a position control.
#include <gtest/gtest.h>

#include <string>

#include "cycle/asked_bits.h"

namespace nord_driver::cycle {
namespace {

using Carrier = PositionBit::Carrier;
using profile::Series;

std::string listed(const PositionSetup& setup, Series series = Series::kSk5xxe) {
  std::string all;
  for (const AskedBit& bit : askedBits(setup, series)) {
    all += "P" + std::to_string(bit.number) + "[" + std::to_string(bit.element) + "]=" + std::to_string(bit.function) +
           " " + bit.key + "; ";
  }
  return all;
}

TEST(AskedBits, AreNoneWhereNoneIsConfigured) {
  EXPECT_EQ("", listed({}));
}

TEST(AskedBits, AreThoseThatAreConfigured) {
  PositionSetup setup;
  setup.home = PositionBit{Carrier::kControlBit, 8, 22};
  setup.reset = PositionBit{Carrier::kBusBit, 7, 61};
  setup.referenced = SignalSetup{};
  setup.referenced->source = SignalSource::kBusOutBit;
  setup.referenced->number = 2;
  EXPECT_EQ("P480[11]=22 position/home; P480[8]=61 position/reset; P481[3]=20 position/referenced; ", listed(setup));
}

TEST(AskedBits, OfTheArrayAreThoseThatAreEverHigh) {
  PositionSetup setup;
  const PositionBit array{Carrier::kBusBit, 2, 55};
  setup.teach = TeachSetup{{Carrier::kBusBit, 0, 24}, {Carrier::kBusBit, 1, 25}, array, 5};
  EXPECT_EQ(
      "P480[1]=24 position/teach_in; P480[2]=25 position/quit_teach_in; "
      "P480[3]=55 position/array_bit; P480[5]=57 position/array_bit; ",
      listed(setup));
  setup.teach.reset();
  setup.array = array;
  EXPECT_EQ("", listed(setup)) << "targets go in the words";
  setup.axis.by_element = true;
  setup.elements = 4;
  EXPECT_EQ("P480[3]=55 position/array_bit; P480[4]=56 position/array_bit; P480[5]=57 position/array_bit; ",
            listed(setup));
}

// POSICON bits have their places in the word: no parameter says what they are (BU 0020 7.3.5).
TEST(AskedBits, OfSk700eAreNotInAParameter) {
  PositionSetup setup;
  setup.home = PositionBit{Carrier::kPosicon, 0, 22};
  EXPECT_EQ("", listed(setup, Series::kSk700e));
}

}  // namespace
}  // namespace nord_driver::cycle
