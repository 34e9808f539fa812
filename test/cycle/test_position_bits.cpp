// The bits that ask something of a position control, in the words that carry them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/position_bits.h"
#include "cycle/taught_position.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using ::testing::HasSubstr;
using Carrier = PositionBit::Carrier;

class PositionBitsTest : public ::testing::Test {
 protected:
  PositionBitsTest() {
    device_.word_functions[0].setpoints = {21, 22, 17};
    for (const int function : {24, 25, 55, 56, 0, 0, 0, 0, 0, 0, 25, 22}) {
      device_.bus_bit_functions.push_back(static_cast<std::uint16_t>(function));
    }
    setup_.teach =
        TeachSetup{{Carrier::kBusBit, 0, 24}, {Carrier::kControlBit, 8, 25}, PositionBit{Carrier::kBusBit, 2, 55}, 3};
    output_.control_word = 0x047E;
    output_.setpoints = {1, 2, 0};
  }
  PositionBits bits(Series series = Series::kSk5xxe) const { return {setup_, series, 3}; }
  std::string refusal() const { return bits().teachRefusal("lift", device_, 1).str(); }

  PositionSetup setup_;
  DeviceData device_;
  profile::ProcessOutput output_;
};

TEST_F(PositionBitsTest, ArePutWhereTheyBelong) {
  EXPECT_EQ("", refusal());
  bits().putTeach({true, false}, output_, device_, 1);
  EXPECT_EQ(0x047E, output_.control_word);
  EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0x000D}), output_.setpoints) << "teach-in, and element 3";
  bits().putTeach({true, true}, output_, device_, 1);
  EXPECT_EQ(0x057E, output_.control_word) << "quit";
  EXPECT_EQ(0x000D, output_.setpoints[2]);
}

TEST_F(PositionBitsTest, SetTheCountAnew) {
  EXPECT_THAT(bits().resetRefusal("lift", device_, 1).str(), HasSubstr("position/reset is not configured"));
  bits().putReset(output_, device_, 1);
  EXPECT_EQ(0, output_.setpoints[2]);
  setup_.reset = PositionBit{Carrier::kBusBit, 5, 61};
  EXPECT_THAT(bits().resetRefusal("lift", device_, 1).str(),
              HasSubstr("P480[-06] is 0; set it to 61 (reset position), or position/reset_function"));
  device_.bus_bit_functions[5] = 61;
  EXPECT_EQ("", bits().resetRefusal("lift", device_, 1).str());
  bits().putReset(output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0x0020}), output_.setpoints);
}

TEST_F(PositionBitsTest, AreLowOtherwise) {
  bits().putTeach({}, output_, device_, 1);
  EXPECT_EQ(0x047E, output_.control_word);
  EXPECT_EQ(0, output_.setpoints[2]);
  output_.control_word = 0;  // heeded by nobody
  bits().putTeach({true, true}, output_, device_, 1);
  EXPECT_EQ(0, output_.control_word);
  EXPECT_EQ(0, output_.setpoints[2]);
}

// BU 0020 7.3.5: bits 0 to 5, 8 and 9 of one word.
TEST_F(PositionBitsTest, OfSk700eAreOneWord) {
  const PositionBit posicon{Carrier::kPosicon, 0, 0};
  setup_.teach = TeachSetup{posicon, posicon, posicon, 37};
  device_.word_functions[0].setpoints = {3, 12, 0};
  output_.setpoints = {};
  const PositionBits old = bits(Series::kSk700e);
  EXPECT_EQ("", old.teachRefusal("lift", device_, 1).str()) << "P480 has no say in it";
  old.putTeach({true, true}, output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{0, 0x0325, 0}), output_.setpoints);
  output_.setpoints = {};
  setup_.reset = posicon;
  EXPECT_EQ("", bits(Series::kSk700e).resetRefusal("lift", device_, 1).str());
  bits(Series::kSk700e).putReset(output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{0, 0x0400, 0}), output_.setpoints) << "bit 10";
}

TEST_F(PositionBitsTest, AreRefusedWithTheParameterAndItsValue) {
  device_.bus_bit_functions[3] = 1;
  EXPECT_THAT(refusal(), HasSubstr("P480[-04] is 1; set it to 56 (bit 1 of the position array), or "
                                   "position/array_function"));
  device_.bus_bit_functions[2] = 1;
  EXPECT_THAT(refusal(), HasSubstr("P480[-03] is 1; set it to 55 (bit 0 of the position array)"));
  device_.bus_bit_functions[10] = kUnknownFunction;
  EXPECT_THAT(refusal(), HasSubstr("P480[-11] could not be read; set it to 25 (quit teach-in)"));
  device_.bus_bit_functions[0] = 22;
  EXPECT_THAT(refusal(), HasSubstr("P480[-01] is 22; set it to 24 (teach-in)"));
  device_.word_functions[0].setpoints = {1, 21, 22};
  EXPECT_THAT(refusal(), HasSubstr("no setpoint carries the bit of position/teach_in"));
  setup_.teach.reset();
  EXPECT_THAT(refusal(), HasSubstr("position/teach_in is not configured"));
}

// Where targets stand in words an element has no bits; element 0 is none.
TEST_F(PositionBitsTest, ChooseAnElementOnlyWhereTheyAreToDoSo) {
  setup_.array = PositionBit{Carrier::kBusBit, 2, 55};
  bits().putElement(5, output_, device_, 1);
  EXPECT_EQ(0, output_.setpoints[2]);
  setup_.axis.by_element = true;
  bits().putElement(0, output_, device_, 1);
  EXPECT_EQ(0, output_.setpoints[2]);
  bits().putElement(5, output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0x0014}), output_.setpoints);
}

// P481 [-09] and [-10] are bits 10 and 13 of the status word (BU 0020 6.2.1).
TEST_F(PositionBitsTest, TellWhetherTheReferenceIsKnown) {
  profile::ProcessInput input;
  input.status_word = 0xFFFF;
  EXPECT_FALSE(bits().referenced(input, device_, 1)) << "no bit says it";
  SignalSetup bit;
  bit.source = SignalSource::kStatusBit;
  for (const std::uint8_t number : {std::uint8_t{10}, std::uint8_t{13}}) {
    bit.number = number;
    setup_.referenced = bit;
    device_.out_bit_function = 20;
    input.status_word = static_cast<Word>(1u << number);
    EXPECT_EQ(true, bits().referenced(input, device_, 1));
    input.status_word = static_cast<Word>(~(1u << number));
    EXPECT_EQ(false, bits().referenced(input, device_, 1));
    device_.out_bit_function = 1;
    EXPECT_FALSE(bits().referenced(input, device_, 1)) << "it shows something else";
    device_.out_bit_function.reset();
    EXPECT_FALSE(bits().referenced(input, device_, 1)) << "nobody knows what it shows";
  }
}

TEST_F(PositionBitsTest, KnowAPositionAsTheArrayHasIt) {
  setup_.axis.scale.revolutions_per_unit = -100.0;
  setup_.axis.scale.offset = 0.5;
  setup_.axis.scale.steps_per_revolution = 8192.0;  // of the words
  EXPECT_EQ(-20'000, bits().inArray(0.7));
  EXPECT_NEAR(0.7, bits().inJoint(-20'000), 1e-12);
}

// The other carrier of it: bit 5 of the actual value that has the bus I/O out bits (12 of SK 53xE).
TEST_F(PositionBitsTest, TellTheReferenceByABusBit) {
  SignalSetup bit;
  bit.source = SignalSource::kBusOutBit;
  bit.number = 5;
  setup_.referenced = bit;
  device_.out_bit_function = 20;
  device_.word_functions[0].actual_values = {1, 10, 12};
  profile::ProcessInput input;
  input.actual_values = {-1, -1, 0x0020};
  EXPECT_EQ(true, bits().referenced(input, device_, 1));
  input.actual_values[2] = ~0x0020;
  EXPECT_EQ(false, bits().referenced(input, device_, 1));
  EXPECT_FALSE(bits().referenced(input, device_, 2)) << "nobody knows the words of that set";
  device_.word_functions[0].actual_values = {12, 10, 15};
  EXPECT_FALSE(bits().referenced(input, device_, 1)) << "word 1 is none for bits";
}

// There are sets 1 to 4; of none of the others, and of none that was not read, a word is known.
TEST_F(PositionBitsTest, AreNotPutWhereNoWordIsKnown) {
  for (const std::uint8_t set : {std::uint8_t{0}, std::uint8_t{2}, std::uint8_t{5}}) {
    bits().putTeach({true, false}, output_, device_, set);
    EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0}), output_.setpoints) << unsigned{set};
  }
  device_.word_functions[3] = device_.word_functions[0];
  bits().putTeach({true, false}, output_, device_, 4);
  EXPECT_EQ(0x000D, output_.setpoints[2]);
}

TEST_F(PositionBitsTest, OfTheArrayAsManyElementsAsAreUsed) {
  setup_.elements = 5;
  for (const std::uint8_t element : {std::uint8_t{0}, std::uint8_t{6}}) {
    EXPECT_EQ("drive lift: of its array elements 1 to 5 are used (position/elements)",
              bits().elementRefusal("lift", element, device_, 1).str());
  }
  for (const std::uint8_t element : {std::uint8_t{1}, std::uint8_t{5}}) {
    EXPECT_EQ("", bits().elementRefusal("lift", element, device_, 1).str());
  }
}

// A reference run whose end nobody could see is not begun.
TEST_F(PositionBitsTest, OfAReferenceRunAreRefusedWithoutTheBitThatShowsIt) {
  EXPECT_THAT(bits().homeRefusal("lift", device_, 1).str(), HasSubstr("position/home is not configured"));
  setup_.home = PositionBit{Carrier::kBusBit, 1, 25};
  EXPECT_EQ("", bits().homeRefusal("lift", device_, 1).str()) << "no bit is to show it";
  SignalSetup bit;
  bit.source = SignalSource::kStatusBit;
  bit.number = 13;
  setup_.referenced = bit;
  EXPECT_THAT(bits().homeRefusal("lift", device_, 1).str(), HasSubstr("P481[-10] could not be read; set it to 20"));
  device_.out_bit_function = 1;
  EXPECT_THAT(bits().homeRefusal("lift", device_, 1).str(), HasSubstr("P481[-10] is 1; set it to 20"));
  device_.out_bit_function = 20;
  EXPECT_EQ("", bits().homeRefusal("lift", device_, 1).str());
}

// --- each bit by its own number --------------------------------------------------------------------------------------

TEST_F(PositionBitsTest, AskForAReferenceRun) {
  bits().putHome(output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0}), output_.setpoints) << "none is configured";
  setup_.home = PositionBit{Carrier::kBusBit, 1, 25};
  bits().putHome(output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0x0002}), output_.setpoints);
  setup_.home = PositionBit{Carrier::kControlBit, 9, 22};
  bits().putHome(output_, device_, 1);
  EXPECT_EQ(0x067E, output_.control_word);
  setup_.home = PositionBit{Carrier::kPosicon, 0, 0};
  device_.word_functions[0].setpoints = {3, 12, 0};
  output_.setpoints = {};
  bits(Series::kSk700e).putHome(output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{0, 0x0040, 0}), output_.setpoints) << "bit 6 (BU 0020 7.3.5)";
}

TEST_F(PositionBitsTest, ChooseTheFirstElementByItsBit) {
  setup_.array = PositionBit{Carrier::kBusBit, 2, 55};
  setup_.axis.by_element = true;
  bits().putElement(1, output_, device_, 1);
  EXPECT_EQ(0x0004, output_.setpoints[2]);
}

// --- what is refused -------------------------------------------------------------------------------------------------

// A bit that does something else in the inverter would be asked for a reference run.
TEST_F(PositionBitsTest, OfAReferenceRunAreRefusedWithAnotherFunction) {
  setup_.home = PositionBit{Carrier::kBusBit, 0, 22};
  EXPECT_EQ(
      "drive lift: P480[-01] is 24; set it to 22 (reference run), or position/home_function to what its manual "
      "says",
      bits().homeRefusal("lift", device_, 1).str());
}

TEST_F(PositionBitsTest, OfAnElementAreRefusedWithAnotherFunction) {
  setup_.array = PositionBit{Carrier::kBusBit, 2, 55};
  setup_.elements = 7;
  device_.bus_bit_functions[4] = 1;
  EXPECT_EQ("", bits().elementRefusal("lift", 7, device_, 1).str()) << "targets stand in words";
  setup_.axis.by_element = true;
  EXPECT_EQ("", bits().elementRefusal("lift", 3, device_, 1).str());
  EXPECT_THAT(bits().elementRefusal("lift", 7, device_, 1).str(),
              HasSubstr("P480[-05] is 1; set it to 57 (bit 2 of the position array)"));
}

// P548 says what setpoint 3 is, and a short telegram does not carry it.
TEST_F(PositionBitsTest, AreRefusedWhereTheTelegramEndsBeforeTheirWord) {
  const PositionBits two{setup_, Series::kSk5xxe, 2};
  EXPECT_THAT(two.teachRefusal("lift", device_, 1).str(), HasSubstr("no setpoint carries the bit"));
  two.putTeach({true, false}, output_, device_, 1);
  EXPECT_EQ((std::array<std::int16_t, 3>{1, 2, 0}), output_.setpoints);
}

TEST_F(PositionBitsTest, TellTheReferenceByTheSecondWordAsWell) {
  setup_.referenced = SignalSetup{};
  setup_.referenced->source = SignalSource::kBusOutBit;
  setup_.referenced->number = 5;
  device_.out_bit_function = 20;
  device_.word_functions[0].actual_values = {1, 12, 10};
  profile::ProcessInput input;
  input.actual_values = {0, 0x0020, 0};
  EXPECT_EQ(true, bits().referenced(input, device_, 1));
}

TEST_F(PositionBitsTest, KnowNoPlaceInTheArrayBeyondItsRange) {
  setup_.axis.scale.revolutions_per_unit = 1.0;
  EXPECT_EQ(0, bits().inArray(1e9));
}

// Whatever was there before.
TEST_F(PositionBitsTest, OfADriveThatFollowsVelocitiesAreNone) {
  setup_.home = PositionBit{Carrier::kControlBit, 8, 22};
  std::optional<PositionSetup> none = setup_;
  none.reset();
  const PositionBits velocities{none, Series::kSk5xxe, 3};
  velocities.putHome(output_, device_, 1);
  EXPECT_EQ(0x047E, output_.control_word);
  EXPECT_THAT(velocities.homeRefusal("lift", device_, 1).str(), HasSubstr("position/home is not configured"));
  EXPECT_THAT(velocities.teachRefusal("lift", device_, 1).str(), HasSubstr("position/teach_in is not configured"));
  EXPECT_FALSE(velocities.elementRefusal("lift", 1, device_, 1).empty()) << "it has no elements";
}

// --- what stands in the array afterwards ------------------------------------------------------------------------------

class TaughtElement : public PositionBitsTest {
 protected:
  Completion compared(bool readable, std::int32_t raw) {
    Completion taught;
    taught.success = true;
    taught.message = "told";
    taught.parameter.raw = 70'000;
    return withTaughtElement(taught, setup_, [&](const profile::ParameterRequest& request) {
      EXPECT_EQ(613, request.number);
      EXPECT_EQ(profile::ParameterShape::kArray, request.shape);
      EXPECT_EQ(3, request.index);
      Completion answer;
      answer.success = readable;
      answer.parameter.raw = raw;
      return answer;
    });
  }
};

TEST_F(TaughtElement, IsComparedWithThePosition) {
  setup_.axis.tolerance = 0.01;
  Completion answer = compared(true, 70'010);
  EXPECT_TRUE(answer.success);
  EXPECT_EQ("told; P613[-03] is 70.010 revolutions", answer.message.str());
  for (const std::int32_t last : {70'011, 69'989}) EXPECT_TRUE(compared(true, last).success) << last;
  EXPECT_FALSE(compared(true, 69'988).success);
  answer = compared(true, 70'012);
  EXPECT_FALSE(answer.success);
  EXPECT_EQ("told, but P613[-03] is 70.012 and not 70.000 revolutions", answer.message.str());
}

// position/tolerance is one of the joint, P613 one of revolutions; either way round.
TEST_F(TaughtElement, IsComparedWithTheToleranceOfTheJoint) {
  setup_.axis.tolerance = 0.01;
  for (const double revolutions : {5.0, -5.0}) {
    setup_.axis.scale.revolutions_per_unit = revolutions;
    EXPECT_TRUE(compared(true, 70'051).success);
    EXPECT_FALSE(compared(true, 70'052).success);
  }
}

TEST_F(TaughtElement, ThatCannotBeReadIsMentioned) {
  Completion answer = compared(false, 0);
  EXPECT_TRUE(answer.success);
  EXPECT_EQ("told; P613[-03] could not be read, so that it is not compared", answer.message.str());
  setup_.teach->array.reset();
  answer = compared(false, 0);
  EXPECT_TRUE(answer.success);
  EXPECT_EQ("told; without position/array_bit nobody knows into which element", answer.message.str());
}

// What was not taught is not looked up, nor what a drive that has no such bits was told.
TEST_F(TaughtElement, IsNotReadWithoutAnythingTaught) {
  const auto unread = [](const profile::ParameterRequest&) {
    ADD_FAILURE() << "read";
    return Completion{};
  };
  Completion refused;
  refused.success = false;
  refused.message = "refused";
  EXPECT_EQ("refused", withTaughtElement(refused, setup_, unread).message.str());
  Completion taught;
  taught.success = true;
  taught.message = "told";
  setup_.teach.reset();
  EXPECT_EQ("told", withTaughtElement(taught, setup_, unread).message.str());
}

}  // namespace
}  // namespace nord_driver::cycle
