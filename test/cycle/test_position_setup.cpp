// `mode: position` as users write it: what is taken, and what is refused with its key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "cycle/cycle_config.h"
#include "cycle/word_needs.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using profile::WordUse;
using ::testing::HasSubstr;

constexpr const char* kRobot = R"(<robot name="lift">
  <link name="base_link"/><link name="platform"/><link name="mast"/>
  <joint name="lift_joint" type="prismatic"><parent link="base_link"/><child link="platform"/>
    <limit lower="0.1" upper="2.0" effort="1" velocity="1"/></joint>
  <joint name="mast_joint" type="continuous"><parent link="base_link"/><child link="mast"/></joint>
</robot>)";

class PositionConfiguration : public ::testing::Test {
 protected:
  CycleConfig read(const std::string& robot_description = "") {
    return readCycleConfig(node_, {{"lift", drive_}}, robot_description);
  }
  PositionSetup setup(const std::string& robot_description = "") { return *read(robot_description).drives[0].position; }
  std::string refusal(const std::string& robot_description = "") {
    try {
      read(robot_description);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "taken";
  }

  std::shared_ptr<test::MapSettings> drive_ = std::make_shared<test::MapSettings>("~drives/lift/");
  test::MapSettings node_{"~", {}};

 private:
  void SetUp() override {
    drive_->set("address", 3).set("series", "sk5xxe").set("joint", "lift_joint");
    drive_->set("gear_ratio", 20.0).set("pole_pairs", 2).set("mode", "position");
  }
};

TEST_F(PositionConfiguration, IsRadiansWithoutALead) {
  const PositionSetup turning = setup();
  EXPECT_NEAR(20.0 / (2.0 * 3.14159265358979), turning.axis.scale.revolutions_per_unit, 1e-12);
  EXPECT_DOUBLE_EQ(1.0, turning.axis.unit_per_radian);
  EXPECT_EQ(32, turning.bits);
  EXPECT_FALSE(turning.axis.lower || turning.axis.upper || turning.axis.speed || turning.home);
  drive_->set("lead", 0.2).set("inverted", true).set("position/speed", 0.3);
  const PositionSetup lift = setup();
  EXPECT_DOUBLE_EQ(-100.0, lift.axis.scale.revolutions_per_unit);
  EXPECT_NEAR(0.3 / 0.2 * 2.0 * 3.14159265358979, lift.axis.speed->value, 1e-9);
  EXPECT_NEAR(0.0001, lift.axis.tolerance, 1e-12) << "0.01 revolutions";
  EXPECT_DOUBLE_EQ(1.0, lift.axis.revolutions_per_motor_turn) << "what the motor turns is counted";
  drive_->set("position/gear_ratio", 40.0);
  EXPECT_DOUBLE_EQ(2.0, setup().axis.revolutions_per_motor_turn);
}

TEST_F(PositionConfiguration, TakesTheNarrowerLimits) {
  drive_->set("lead", 0.2).set("position/lower", 0.5).set("position/upper", 3.0);
  const PositionSetup lift = setup(kRobot);
  EXPECT_EQ(0.5, lift.axis.lower);
  EXPECT_EQ(2.0, lift.axis.upper) << "of the robot's description";
}

TEST_F(PositionConfiguration, TakesLimitsOfAMillion) {
  drive_->set("position/lower", -1e6).set("position/upper", 1e6);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/lower", -1.000001e6);
  EXPECT_THAT(refusal(), HasSubstr("position/lower"));
  drive_->set("position/lower", -1e6).set("position/upper", 1.000001e6);
  EXPECT_THAT(refusal(), HasSubstr("position/upper"));
}

TEST_F(PositionConfiguration, RefusesWhatDoesNotFit) {
  EXPECT_THAT(refusal(kRobot), HasSubstr("~drives/lift/lead is missing: expected m per revolution"));
  drive_->set("joint", "mast_joint").set("lead", 0.2);
  EXPECT_THAT(refusal(kRobot), HasSubstr("in robot_description this joint turns"));
  drive_->set("position/lower", 1.0).set("position/upper", 0.5);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/upper"));
  drive_->set("position/upper", 1.0);
  EXPECT_THAT(refusal(), HasSubstr("more than the lower limit, 1")) << "nowhere to go";
  drive_->set("position/upper", 2.0).set("max_velocity", 1.0);
  EXPECT_THAT(refusal(), HasSubstr("position/speed"));
}

TEST_F(PositionConfiguration, CountsAtLeastOneStepInARevolution) {
  drive_->set("position/steps_per_revolution", 1.0);
  EXPECT_EQ(1.0, setup().axis.scale.steps_per_revolution);
  drive_->set("position/steps_per_revolution", 0.99);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/steps_per_revolution"));
}

TEST_F(PositionConfiguration, RefusesSeriesThatDoNotPosition) {
  for (const char* series : {"sk300e", "sk1x0e"}) {
    drive_->set("series", series);
    EXPECT_THAT(refusal(), HasSubstr("do not position")) << series;
  }
}

TEST_F(PositionConfiguration, IsNoWheel) {
  auto other = std::make_shared<test::MapSettings>("~drives/other/");
  other->set("address", 4).set("series", "sk5xxe").set("joint", "other_joint").set("pole_pairs", 2);
  node_.set("left_wheel", "lift_joint").set("right_wheel", "other_joint");
  node_.set("wheel_separation", 0.5).set("wheel_radius", 0.1);
  try {
    readCycleConfig(node_, {{"lift", drive_}, {"other", other}});
    FAIL() << "taken";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("~drives/lift/mode"));
    EXPECT_THAT(error.what(), HasSubstr("is a wheel of the base"));
  }
}

TEST_F(PositionConfiguration, RefusesALeadWithoutTheMode) {
  drive_->set("mode", "velocity").set("lead", 0.2);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/lead"));
}

TEST_F(PositionConfiguration, NeedsWordsTheBusCarries) {
  const auto carried = [&](std::uint8_t values) {
    DriveIdentity identity;
    identity.process_values = values;
    const CycleConfig config = read();
    try {
      checkPositionCarried(*drive_, *config.drives[0].position, config.drives[0].series, identity);
    } catch (const ConfigError& error) {
      return std::string{error.what()};
    }
    return std::string{"taken"};
  };
  EXPECT_EQ("taken", carried(3));
  EXPECT_EQ("taken", carried(2));
  EXPECT_THAT(carried(1), HasSubstr("~drives/lift/position/bits"));
  drive_->set("position/bits", 16);
  EXPECT_EQ("taken", carried(1));
  drive_->set("position/bits", 32).set("series", "sk700e");
  EXPECT_THAT(carried(2), HasSubstr("need 3 setpoints"));
}

TEST_F(PositionConfiguration, NamesTheBitsOfAReferenceRun) {
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

TEST_F(PositionConfiguration, KnowsItsBitsByTheirNumbers) {
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

TEST_F(PositionConfiguration, TakesFunctionsOfOneByte) {
  for (const int function : {1, 255}) {
    drive_->set("position/home", "bus_in_bit_3").set("position/home_function", function);
    EXPECT_EQ(function, setup().home->function);
  }
  for (const int function : {0, 256}) {
    drive_->set("position/home_function", test::MapSettings::Value{function});
    EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/home_function")) << function;
  }
}

TEST_F(PositionConfiguration, NamesTheElementThatShowsTheReference) {
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

TEST_F(PositionConfiguration, NamesTheBitsThatTeachAPosition) {
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

TEST_F(PositionConfiguration, NamesTheBitThatSetsTheCountAnew) {
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

TEST_F(PositionConfiguration, HasThePosiconBitsTogether) {
  drive_->set("series", "sk700e").set("position/teach_in", "posicon_bits").set("position/element", 63);
  const TeachSetup teach = *setup().teach;
  EXPECT_EQ(PositionBit::Carrier::kPosicon, teach.quit.carrier);
  EXPECT_EQ(PositionBit::Carrier::kPosicon, teach.array->carrier);
  EXPECT_EQ(63, teach.element);
}

// --- the elements of the array as targets -----------------------------------------------------------------------------

TEST_F(PositionConfiguration, GoesToElementsByTheirBits) {
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
TEST_F(PositionConfiguration, KeepsItsBitsFromSignals) {
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

// --- which word is missing -------------------------------------------------------------------------------------------

std::string missing(Series series, const WordFunctions& functions, const PositionSetup& setup,
                    std::size_t carried = 3) {
  WordNeeds needs;
  needs.words = carried;
  addPositionNeeds(setup, series, needs);
  const auto word = missingWord(needs, functions, series);
  if (!word) return "none";
  return std::to_string(word->number) + "[" + std::to_string(word->index) + "] -> " + std::to_string(word->expected);
}

std::string missing(Series series, const WordFunctions& functions, std::uint8_t bits = 32, std::size_t carried = 3) {
  PositionSetup setup;
  setup.bits = bits;
  return missing(series, functions, setup, carried);
}

// A word for the bits, and no place for the frequency: the first word is no longer it, instead of a half of the position.
TEST(PositionNeeds, LeaveRoomForTheBits) {
  PositionSetup setup;
  setup.home = PositionBit{PositionBit::Carrier::kBusBit, 0, 22};
  WordFunctions functions{{1, 21, 22}, {1, 10, 15}};
  EXPECT_EQ("547[1] -> 17", missing(Series::kSk5xxe, functions, setup));
  functions.setpoints = {1, 17, 22};
  EXPECT_EQ("546[1] -> 21", missing(Series::kSk5xxe, functions, setup));
  functions.setpoints = {21, 17, 22};
  EXPECT_EQ("none", missing(Series::kSk5xxe, functions, setup));
  functions.actual_values = {10, 15, 0};
  EXPECT_EQ("none", missing(Series::kSk5xxe, functions, setup));
  WordNeeds needs;
  needs.words = 3;
  addPositionNeeds(setup, Series::kSk5xxe, needs);
  EXPECT_TRUE(firstWordFits(needs, false, 17, Series::kSk5xxe));
  EXPECT_FALSE(firstWordFits(needs, true, 12, Series::kSk5xxe)) << "of the actual values it is the frequency";
}

TEST(PositionNeeds, WithElementsNeedNoTargetInWords) {
  PositionSetup setup;
  setup.axis.by_element = true;
  setup.array = PositionBit{PositionBit::Carrier::kBusBit, 4, 55};
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 17, 0}, {1, 10, 15}}, setup));
  EXPECT_EQ("547[1] -> 17", missing(Series::kSk5xxe, {{1, 0, 0}, {1, 10, 15}}, setup));
  EXPECT_EQ("543[3] -> 15", missing(Series::kSk2xxe, {{1, 20, 0}, {1, 10, 9}}, setup));
  setup.array = PositionBit{PositionBit::Carrier::kPosicon, 0, 55};
  EXPECT_EQ("none", missing(Series::kSk700e, {{3, 12, 0}, {6, 0, 0}}, setup));
  setup.bits = 16;
  EXPECT_EQ("none", missing(Series::kSk700e, {{4, 1, 0}, {6, 0, 0}}, setup));
}

TEST(PositionNeeds, NameTheParameterAndItsValue) {
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 22}, {1, 10, 15}}));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{22, 1, 21}, {15, 10, 0}}));
  EXPECT_EQ("547[1] -> 23", missing(Series::kSk5xxe, {{1, 0, 0}, {1, 10, 15}})) << "as 10 and 15 count (BU 2700 5.3)";
  EXPECT_EQ("548[1] -> 22", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 15}}));
  EXPECT_EQ("548[1] -> 24", missing(Series::kSk5xxe, {{1, 23, 2}, {1, 10, 15}})) << "the other half of that pair";
  EXPECT_EQ("548[1] -> 22", missing(Series::kSk5xxe, {{1, 21, 24}, {1, 10, 15}})) << "no halves of two pairs";
  EXPECT_EQ("546[2] -> 23", missing(Series::kSk2xxe, {{1, 0, 0}, {1, 4, 9}}));
  EXPECT_EQ("543[3] -> 15", missing(Series::kSk2xxe, {{1, 23, 24}, {1, 10, 9}}));
  EXPECT_EQ("546[1] -> 3", missing(Series::kSk700e, {{1, 0, 0}, {6, 0, 0}}));
  EXPECT_EQ("543[1] -> 6", missing(Series::kSk700e, {{3, 0, 0}, {1, 6, 0}})) << "32 bits are in word 1 only";
  EXPECT_EQ("none", missing(Series::kSk700e, {{6, 0, 0}, {10, 0, 0}})) << "increments are positions, too";
}

TEST(PositionNeeds, WithTwoWordsTakeTheFirstAsWell) {
  EXPECT_EQ("546[1] -> 21", missing(Series::kSk5xxe, {{1, 22, 0}, {10, 15, 0}}, 32, 2));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{21, 22, 0}, {10, 15, 0}}, 32, 2));
}

TEST(PositionNeeds, Of16BitsAreOneWordAndNoHighOne) {
  EXPECT_EQ("547[1] -> 23", missing(Series::kSk5xxe, {{1, 0, 0}, {1, 10, 0}}, 16));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 0}}, 16));
  EXPECT_EQ("548[1] -> 0", missing(Series::kSk5xxe, {{1, 21, 22}, {1, 10, 0}}, 16)) << "it would be taken for 32 bits";
  EXPECT_EQ("546[1] -> 2", missing(Series::kSk700e, {{1, 0, 0}, {6, 0, 0}}, 16, 1));
}

}  // namespace
}  // namespace nord_driver::cycle
