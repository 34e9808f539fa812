// The bits of a drive that positions as users write them: which are taken, and which are refused with their key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "cycle/position_configuration.h"
#include "cycle/word_needs.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using ::testing::HasSubstr;

class PositionBitConfiguration : public PositionConfiguration {};

TEST_F(PositionBitConfiguration, NamesTheBitsOfAReferenceRun) {
  drive_->set("position/home", "control_bit_9").set("position/referenced", "status_bit_13");
  const PositionSetup lift = setup();
  EXPECT_EQ(PositionBit::Carrier::kControlBit, lift.home->carrier);
  EXPECT_EQ(12, elementOf(*lift.home)) << "P480 [-12] is bit 9 of the control word";
  drive_->set("position/home", "posicon_bits");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/home"));
  drive_->set("series", "sk700e");
  EXPECT_EQ(PositionBit::Carrier::kPosicon, setup().home->carrier);
  drive_->set("position/home", "control_bit_8");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/home")) << "P480 of SK 700E has eight elements";
  drive_->set("position/home", "bus_in_bit_3").set("position/referenced", "status_bit_11");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/referenced"));
}

TEST_F(PositionBitConfiguration, KnowsItsBitsByTheirNumbers) {
  const auto with = [this](const char* key, const char* word) {
    drive_->set(key, word);
    return refusal();
  };
  for (const char* bit : {"bus_in_bit_0", "bus_in_bit_7", "control_bit_8", "control_bit_9"}) {
    EXPECT_EQ("taken", with("position/home", bit)) << bit;
  }
  for (const char* none : {"bus_in_bit_8", "bus_in_bit_", "control_bit_7", "control_bit_10", "home"}) {
    EXPECT_THAT(with("position/home", none), HasSubstr("~drives/lift/position/home")) << none;
  }
  drive_->erase("position/home");
  for (const auto& [word, number] : {std::pair{"bus_out_bit_0", 0}, std::pair{"bus_out_bit_7", 7},
                                     std::pair{"status_bit_10", 10}, std::pair{"status_bit_13", 13}}) {
    EXPECT_EQ("taken", with("position/referenced", word)) << word;
    EXPECT_EQ(number, setup().referenced->number);
  }
  for (const char* none : {"bus_out_bit_8", "status_bit_9", "status_bit_12", "status_bit_14"}) {
    EXPECT_THAT(with("position/referenced", none), HasSubstr("~drives/lift/position/referenced")) << none;
  }
}

TEST_F(PositionBitConfiguration, TakesFunctionsOfOneByte) {
  for (const int function : {1, 255}) {
    drive_->set("position/home", "bus_in_bit_3").set("position/home_function", function);
    EXPECT_EQ(function, setup().home->function);
  }
  for (const int function : {0, 256}) {
    drive_->set("position/home_function", test::MapSettings::Value{function});
    EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/home_function")) << function;
  }
}

TEST_F(PositionBitConfiguration, NamesTheElementThatShowsTheReference) {
  const auto element = [&](const char* source) {
    drive_->set("position/referenced", source);
    return int{referencedElement(setup(), read().drives[0].series)};
  };
  EXPECT_EQ(0, referencedElement(setup(), Series::kSk5xxe));
  EXPECT_EQ(9, element("status_bit_10"));
  EXPECT_EQ(10, element("status_bit_13"));
  EXPECT_EQ(6, element("bus_out_bit_5"));
  EXPECT_EQ(20, setup().referenced_function);
  drive_->set("position/referenced_function", test::MapSettings::Value{0});
  EXPECT_EQ(0, element("bus_out_bit_5")) << "it is not looked at";
  drive_->set("position/referenced_function", 7).set("series", "sk700e");
  EXPECT_EQ(0, element("status_bit_13")) << "MFR 4, whatever P481 says";
  EXPECT_EQ(6, element("bus_out_bit_5"));
}

TEST_F(PositionBitConfiguration, NamesTheBitsThatTeachAPosition) {
  EXPECT_FALSE(setup().teach);
  drive_->set("position/teach_in", "bus_in_bit_0");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/quit_teach_in is missing"));
  drive_->set("position/quit_teach_in", "bus_in_bit_0");
  EXPECT_THAT(refusal(), HasSubstr("the bit of position/teach_in"));
  drive_->set("position/quit_teach_in", "control_bit_9").set("position/array_bit", "bus_in_bit_4");
  drive_->set("position/element", 9);
  TeachSetup teach = *setup().teach;
  EXPECT_EQ(12, elementOf(teach.quit));
  EXPECT_EQ(24, teach.teach_in.function);
  EXPECT_EQ(25, teach.quit.function);
  EXPECT_EQ(55, teach.array->function);
  EXPECT_EQ(9, teach.element);
  drive_->set("position/element", 16);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/element")) << "bit 4 of the number is beyond bus_in_bit_7";
  drive_->set("position/element", 9).set("position/home", "bus_in_bit_7");
  EXPECT_THAT(refusal(), HasSubstr("the bit of position/home"));
  drive_->set("position/element", 7);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/home", "bus_in_bit_0");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/teach_in"));
}

TEST_F(PositionBitConfiguration, NamesTheBitThatSetsTheCountAnew) {
  EXPECT_FALSE(setup().reset);
  EXPECT_EQ(0.0, setup().axis.reset_to);
  drive_->set("position/reset", "bus_in_bit_2").set("position/reset_to", -1.5);
  EXPECT_EQ(3, elementOf(*setup().reset));
  EXPECT_EQ(61, setup().reset->function);
  EXPECT_EQ(-1.5, setup().axis.reset_to);
  drive_->set("position/home", "bus_in_bit_2");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/reset: the bit of position/home"));
  drive_->set("position/home", "bus_in_bit_3").set("position/teach_in", "bus_in_bit_2");
  drive_->set("position/quit_teach_in", "bus_in_bit_4");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/teach_in: the bit of position/reset"));
  drive_->set("position/reset_to", 60'000.0);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/"));
}

TEST_F(PositionBitConfiguration, HasThePosiconBitsTogether) {
  drive_->set("series", "sk700e").set("position/teach_in", "posicon_bits").set("position/element", 63);
  const TeachSetup teach = *setup().teach;
  EXPECT_EQ(PositionBit::Carrier::kPosicon, teach.quit.carrier);
  EXPECT_EQ(PositionBit::Carrier::kPosicon, teach.array->carrier);
  EXPECT_EQ(63, teach.element);
}

// --- the elements of the array as targets -----------------------------------------------------------------------------

TEST_F(PositionBitConfiguration, GoesToElementsByTheirBits) {
  EXPECT_FALSE(setup().axis.by_element);
  EXPECT_EQ(63, setup().elements);
  EXPECT_NEAR(0.25 / 20.0 * 2.0 * 3.14159265358979, setup().axis.stray, 1e-12) << "a quarter of a revolution";
  drive_->set("position/targets", "array");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/array_bit is missing"));
  drive_->set("position/array_bit", "bus_in_bit_4");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/setpoint_mode is missing"));
  drive_->set("position/setpoint_mode", 1);
  EXPECT_TRUE(setup().axis.by_element);
  EXPECT_EQ(15, setup().elements) << "as many as four bits have";
  drive_->set("position/elements", 16);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/elements"));
  drive_->set("position/elements", 5).set("position/home", "bus_in_bit_6");
  EXPECT_THAT(refusal(), HasSubstr("the bit of position/home")) << "5 has bit 2";
  drive_->set("position/elements", 3);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/home", "bus_in_bit_0").set("position/array_bit", "control_bit_8").set("position/elements", 3);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/targets", "both");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/targets"));
}

// A lamp on the bit of a reference run would begin one.
TEST_F(PositionBitConfiguration, KeepsItsBitsFromSignals) {
  drive_->set("position/home", "bus_in_bit_3").set("position/teach_in", "bus_in_bit_0");
  drive_->set("position/quit_teach_in", "control_bit_9");
  const auto with = [&](const char* source) {
    drive_->set("signals/lamp/source", source);
    return refusal();
  };
  EXPECT_EQ("taken", with("bus_in_bit_4"));
  EXPECT_EQ("taken", with("control_bit_8"));
  EXPECT_THAT(with("bus_in_bit_3"), HasSubstr("~drives/lift/signals/lamp/source"));
  EXPECT_THAT(with("bus_in_bit_3"), HasSubstr("another bit: it is one of position/home"));
  EXPECT_THAT(with("bus_in_bit_0"), HasSubstr("position/teach_in"));
  EXPECT_THAT(with("control_bit_9"), HasSubstr("position/quit_teach_in"));
  drive_->set("position/reset", "bus_in_bit_1");
  EXPECT_THAT(with("bus_in_bit_1"), HasSubstr("another bit: it is one of position/reset"));
  drive_->set("position/array_bit", "bus_in_bit_4").set("position/targets", "array").set("position/setpoint_mode", 1);
  EXPECT_THAT(with("bus_in_bit_7"), HasSubstr("position/array_bit"));
  drive_->set("position/elements", 7);
  EXPECT_EQ("taken", with("bus_in_bit_7"));
}

// --- what the bits mean where nothing is said of it ------------------------------------------------------------------

TEST_F(PositionBitConfiguration, AsksForAReferenceRunByTheFunctionOfTheTerminals) {
  drive_->set("position/home", "bus_in_bit_3");
  EXPECT_EQ(22, setup().home->function);
}

TEST_F(PositionBitConfiguration, ReadsTheReferenceWhereItStands) {
  drive_->set("position/referenced", "status_bit_13");
  EXPECT_EQ(SignalSource::kStatusBit, setup().referenced->source);
  drive_->set("position/referenced", "bus_out_bit_2");
  EXPECT_EQ(SignalSource::kBusOutBit, setup().referenced->source);
}

TEST_F(PositionBitConfiguration, TeachesOneOf63Elements) {
  drive_->set("position/teach_in", "bus_in_bit_0").set("position/quit_teach_in", "control_bit_9");
  EXPECT_EQ(1, setup().teach->element) << "the first, where nothing is said of it";
  for (const int element : {1, 63}) {
    drive_->set("position/element", element);
    EXPECT_EQ(element, setup().teach->element);
  }
  for (const int element : {0, 64}) {
    drive_->set("position/element", test::MapSettings::Value{element});
    EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/element")) << element;
  }
}

// --- one bit, one meaning --------------------------------------------------------------------------------------------

// Bits that choose what is taught may not end the teaching.
TEST_F(PositionBitConfiguration, KeepsTheElementThatIsTaughtFromTheBitsThatTeach) {
  drive_->set("position/teach_in", "bus_in_bit_0").set("position/quit_teach_in", "bus_in_bit_5");
  drive_->set("position/array_bit", "bus_in_bit_4").set("position/element", 1);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/element", 2);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/array_bit: the bit of position/quit_teach_in"));
}

// A target that raised one of them would teach its position away.
TEST_F(PositionBitConfiguration, KeepsTheElementsThatAreTargetsFromTheBitsThatTeach) {
  drive_->set("position/targets", "array").set("position/setpoint_mode", 1).set("position/array_bit", "bus_in_bit_4");
  drive_->set("position/teach_in", "bus_in_bit_5").set("position/quit_teach_in", "bus_in_bit_0");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/array_bit: the bit of position/teach_in"));
  drive_->set("position/teach_in", "bus_in_bit_0").set("position/quit_teach_in", "bus_in_bit_5");
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/array_bit: the bit of position/quit_teach_in"));
  drive_->set("position/elements", 1);
  EXPECT_EQ("taken", refusal()) << "one element has one bit";
}

TEST_F(PositionBitConfiguration, KeepsTheElementThatIsTaughtFromSignals) {
  drive_->set("position/teach_in", "bus_in_bit_0").set("position/quit_teach_in", "control_bit_9");
  drive_->set("position/array_bit", "bus_in_bit_4").set("position/element", 2);
  drive_->set("signals/lamp/source", "bus_in_bit_5");
  EXPECT_THAT(refusal(), HasSubstr("another bit: it is one of position/array_bit"));
  drive_->set("signals/lamp/source", "bus_in_bit_4");
  EXPECT_EQ("taken", refusal()) << "2 has not bit 0";
}

// --- how many elements there are -------------------------------------------------------------------------------------

// Of a drive that is told its target in words: what stands in the element is read, and no bit chooses it.
TEST_F(PositionBitConfiguration, CountsNoBitsOfElementsThatAreRead) {
  drive_->set("position/array_bit", "bus_in_bit_7");
  EXPECT_EQ(63, setup().elements);
  drive_->set("position/elements", 63);
  EXPECT_EQ("taken", refusal());
}

TEST_F(PositionBitConfiguration, HasTwoBitsInTheControlWord) {
  drive_->set("position/targets", "array").set("position/setpoint_mode", 1);
  drive_->set("position/array_bit", "control_bit_8");
  EXPECT_EQ(3, setup().elements);
  drive_->set("position/array_bit", "control_bit_9");
  EXPECT_EQ(1, setup().elements);
  drive_->set("position/elements", 2);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/elements")) << "control bit 10 says that the word counts";
}

// POSICON bits have their places in the word (BU 0020 7.3.5): who teaches by them chooses by them.
TEST_F(PositionBitConfiguration, ChoosesElementsByThePosiconBitsItTeachesBy) {
  drive_->set("series", "sk700e").set("position/teach_in", "posicon_bits");
  drive_->set("position/targets", "array").set("position/setpoint_mode", 1);
  ASSERT_EQ("taken", refusal());
  EXPECT_EQ(PositionBit::Carrier::kPosicon, setup().array->carrier);
  EXPECT_EQ(63, setup().elements);
}

TEST_F(PositionBitConfiguration, TakesAnyValueOfP610) {
  drive_->set("position/targets", "array").set("position/array_bit", "bus_in_bit_4");
  for (const int mode : {0, 100}) {
    drive_->set("position/setpoint_mode", test::MapSettings::Value{mode});
    EXPECT_EQ(mode, setup().setpoint_mode);
  }
  drive_->set("position/setpoint_mode", 101);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/setpoint_mode"));
}

}  // namespace
}  // namespace nord_driver::cycle
