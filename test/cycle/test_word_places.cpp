// More functions of words than the telegram has words: such a drive could never be enabled.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/position_configuration.h"
#include "cycle/word_places.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

class WordPlaces : public PositionConfiguration {
 public:
  void SetUp() override {
    PositionConfiguration::SetUp();
    drive_->set("mode", "velocity");
  }
  std::string refusalWith(std::uint8_t words, bool only_inputs = false) {
    DriveIdentity identity;
    identity.process_values = words;
    const CycleConfig config = read();
    try {
      checkWordPlaces(*drive_, config.drives[0], identity, only_inputs);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
  WordPlaces& signal(const std::string& name, const char* source) {
    drive_->set("signals/" + name + "/source", source);
    return *this;
  }
  WordPlaces& limits(int count) {
    drive_->set("setpoints/grip/function", "torque_limit");
    if (count > 1) drive_->set("setpoints/power/function", "current_limit");
    return *this;
  }
  WordPlaces& positions(const char* series, int bits) {
    drive_->set("mode", "position").set("series", series).set("position/bits", bits);
    return *this;
  }
};

TEST_F(WordPlaces, AreCountedForSetpointsAndOutputsTogether) {
  limits(2);
  EXPECT_EQ("accepted", refusalWith(3));
  signal("lamp", "control_bit_8");
  EXPECT_EQ("accepted", refusalWith(3)) << "the control word is always there";
  signal("horn", "bus_in_bit_0");
  EXPECT_EQ(
      "~drives/lift/: 3 functions of setpoints are needed beside the frequency (Torque current limit, Current limit, "
      "Bus I/O in bits 0...7), but the bus carries 2 words for them to this drive, expected fewer setpoints and bits",
      refusalWith(3));
  EXPECT_EQ("accepted", refusalWith(3, true)) << "who only looks on sends none of them";
}

TEST_F(WordPlaces, AreFewerInAShorterTelegram) {
  limits(1).signal("horn", "bus_in_bit_0").signal("lamp", "bus_in_bit_7");
  EXPECT_EQ("accepted", refusalWith(3));
  EXPECT_THAT(refusalWith(2), HasSubstr("the bus carries 1 word for them to this drive, expected fewer setpoints and "
                                        "bits, or a longer telegram (PPO type, assembly)"));
}

TEST_F(WordPlaces, AreCountedForAllThatIsRead) {
  signal("input", "digital_input_1").signal("relay", "relay_1").signal("level", "analog_input_1");
  EXPECT_EQ("accepted", refusalWith(3)) << "inputs and relays are in one word";
  drive_->set("torque_at_limit", 10.0);
  for (const bool only_inputs : {false, true}) {
    EXPECT_EQ(
        "~drives/lift/: 3 functions of actual values are needed beside the frequency (Torque current, Digital I/O "
        "status, Value analog input 1), but the bus carries 2 words for them from this drive, expected fewer signals "
        "and bits, or no torque_at_limit",
        refusalWith(3, only_inputs));
  }
}

// Of a drive that positions the first word is free where the others do not suffice.
TEST_F(WordPlaces, OfAPositionAreThree) {
  positions("sk5xxe", 32).limits(1);
  EXPECT_EQ("accepted", refusalWith(3));
  limits(2);
  EXPECT_THAT(refusalWith(3), HasSubstr("4 functions of setpoints are needed (Torque current limit, Current limit, "
                                        "Setpoint position, low word"));
  EXPECT_THAT(refusalWith(3), HasSubstr("the bus carries 3 words for them to this drive"));
  drive_->set("position/bits", 16);
  EXPECT_EQ("accepted", refusalWith(3));
  EXPECT_THAT(refusalWith(2), HasSubstr("3 functions of setpoints are needed"));
}

TEST_F(WordPlaces, OfAPositionThatIsReadAreThree) {
  positions("sk5xxe", 32).signal("input", "digital_input_1");
  EXPECT_EQ("accepted", refusalWith(3));
  drive_->set("torque_at_limit", 10.0);
  EXPECT_THAT(refusalWith(3), HasSubstr("4 functions of actual values are needed"));
}

// Only a position may stand in the first word: without one the frequency stays there.
TEST_F(WordPlaces, LeaveTheFirstToTheFrequencyWhereNoPositionTakesIt) {
  positions("sk5xxe", 16).limits(2);
  drive_->set("position/targets", "array").set("position/setpoint_mode", 1).set("position/array_bit", "bus_in_bit_0");
  drive_->set("position/array_function", 55);
  EXPECT_THAT(refusalWith(3), HasSubstr("the bus carries 2 words for them"));
}

// BU 0020 6.1.2, 7.3.7: the 32 bits of SK 700E and 750E take the places of the words 1 and 3.
TEST_F(WordPlaces, BesideA32BitPositionOfSk7x0eAreTwo) {
  positions("sk750e", 32).limits(1);
  EXPECT_EQ("accepted", refusalWith(3));
  limits(2);
  EXPECT_THAT(refusalWith(3), HasSubstr("3 functions of setpoints are needed"));
  EXPECT_THAT(refusalWith(3), HasSubstr("the bus carries 2 words for them to this drive"));
  drive_->set("position/bits", 16);
  EXPECT_EQ("accepted", refusalWith(3));
  signal("input", "digital_input_1");
  drive_->set("torque_at_limit", 10.0);
  EXPECT_EQ("accepted", refusalWith(3));
}

TEST_F(WordPlaces, BesideA32BitActualPositionOfSk7x0eAreTwo) {
  positions("sk750e", 32).signal("input", "digital_input_1");
  EXPECT_EQ("accepted", refusalWith(3));
  drive_->set("torque_at_limit", 10.0);
  EXPECT_THAT(refusalWith(3), HasSubstr("3 functions of actual values are needed"));
  EXPECT_THAT(refusalWith(3), HasSubstr("the bus carries 2 words for them from this drive"));
}

// A position of 16 bits is all that a telegram of one word carries.
TEST_F(WordPlaces, OfOneWordCarryAPositionOf16Bits) {
  positions("sk5xxe", 16);
  EXPECT_EQ("accepted", refusalWith(1));
}

}  // namespace
}  // namespace nord_driver::cycle
