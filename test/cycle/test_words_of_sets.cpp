// Each of the four parameter sets has its own scale and its own words; what the set in force has keeps a drive from being
// enabled, whatever the others have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/parameters_bench.h"
#include "cycle/user_messages.h"

namespace nord_driver::cycle {
namespace {

using drive::Refusal;
using profile::Series;
using ::testing::HasSubstr;

class WordsOfSets : public ::testing::Test, protected ParametersBench {
 protected:
  using ParametersBench::ParametersBench;
  void select(std::uint8_t set) {
    drive.requestParameterSet(set, now);
    run(5);
    ASSERT_EQ(set, drive.report().parameter_set);
  }
  Refusal refusal() const { return drive.enableRefusal(); }
  std::string message() const { return refusalMessage("lift", refusal(), drive.report()).str(); }
};

TEST_F(WordsOfSets, EachSetHasItsOwnMaximumFrequency) {
  for (int set = 1; set <= 4; ++set) values[1000 * set + 105] = 500 + 100 * set;
  run(80);
  for (std::uint8_t set = 1; set <= 4; ++set) {
    ASSERT_TRUE(drive.maxFrequency(set)) << unsigned{set};
    EXPECT_DOUBLE_EQ(50.0 + 10.0 * set, drive.maxFrequency(set)->value);
  }
}

// An inverter that does not tell P600 is taken for one that goes by speed: POSICON has to be switched on.
TEST_F(WordsOfSets, PositionControlThatCannotBeReadForbidsNothing) {
  ASSERT_EQ(0u, values.count(600));
  run(80);
  EXPECT_LT(0, reads(600));
  EXPECT_EQ(Refusal::kNone, refusal());
}

// P546 of set 1 is "actual frequency PID": 100 % of setpoint 1 is no speed.
TEST_F(WordsOfSets, AnotherFunctionOfSetpoint1IsNamed) {
  values[546] = 1;
  values[1546] = 3;
  run(80);
  EXPECT_EQ(Refusal::kUnexpectedFunction, refusal());
  EXPECT_THAT(message(), HasSubstr("P546 of parameter set 1 is 3, so that setpoint 1 is not the frequency"));
  select(2);
  EXPECT_EQ(Refusal::kNone, refusal());
}

// POSICON would hold it where it stands, whatever its setpoint says (BU 0020 7.3.5).
TEST_F(WordsOfSets, FollowNoVelocityInASetThatPositions) {
  values[600] = 0;
  values[1600] = 2;
  run(80);
  EXPECT_EQ(Refusal::kUnexpectedFunction, refusal());
  EXPECT_THAT(message(), HasSubstr("P600 of parameter set 1 is 2: "));
  EXPECT_THAT(message(), HasSubstr("set P600 to 0"));
  select(2);
  EXPECT_EQ(Refusal::kNone, refusal()) << message();
}

// No manual at hand says whether P600 has sets: of an inverter that answers for set 1 alone it counts in each.
TEST_F(WordsOfSets, FollowNoVelocityWhereTheOnlyP600Positions) {
  values[1600] = 1;
  run(80);
  select(3);
  EXPECT_EQ(Refusal::kUnexpectedFunction, refusal());
  EXPECT_THAT(message(), HasSubstr("P600 of parameter set 3 is 1"));
}

// An inverter without POSICON has none, and a channel may be slow: that keeps nobody from driving.
TEST_F(WordsOfSets, FollowVelocitiesWhereP600CannotBeRead) {
  run(80);
  ASSERT_GT(reads(600), 0);
  EXPECT_EQ(Refusal::kNone, refusal()) << message();
  for (std::set<int>* const unreadable : {&silent, &not_now}) {
    unreadable->insert(600);
    parameters.handleLoss(drive);
    run(1000);
    EXPECT_EQ(Refusal::kNone, refusal()) << message();
    EXPECT_FALSE(parameters.device().position_control[0]);
    unreadable->clear();
  }
}

class WordsOfAnArray : public WordsOfSets {
 protected:
  WordsOfAnArray() : WordsOfSets{ParameterChannelUse{}, drive::DriveConfig{}, Series::kSk54xe} {}
};

// Users set what they are told: P543 [-01], as it stands in the manual of the series.
TEST_F(WordsOfAnArray, AreNamedWithTheirElement) {
  values[543] = 3;
  run(80);
  EXPECT_THAT(message(), HasSubstr("P543 [-01] of parameter set 1 is 3"));
}

/// SK 53xE that positions by words: frequency, low word, high word. 1 rad is a revolution.
class WordsOfALift : public WordsOfSets {
 protected:
  WordsOfALift() : WordsOfSets{channel(), config()} {
    values = {{105, 500}, {543, 1}, {544, 10}, {545, 15}, {546, 1}, {547, 21}, {548, 22}, {600, 1}, {610, 2}};
    inverter.second = 500;
    inverter.ramp = 0;
  }
  static PositionSetup setup() {
    PositionSetup position;
    position.setpoint_mode = 2;
    position.axis.tolerance = 0.01;
    return position;
  }
  static ParameterChannelUse channel() {
    ParameterChannelUse channel;
    channel.needs.words = 3;
    addPositionNeeds(setup(), Series::kSk5xxe, channel.needs);
    return channel;
  }
  static drive::DriveConfig config() {
    drive::DriveConfig config;
    config.position = setup().axis;
    return config;
  }
  auto position() const { return drive.report().position.position; }
};

TEST_F(WordsOfALift, AreFoundInTheSetInForce) {
  values[3544] = 3;  // current
  run(100);
  EXPECT_EQ(Refusal::kNone, refusal()) << message();
  ASSERT_TRUE(position());
  EXPECT_NEAR(0.5, *position(), 1e-9);
  select(3);
  run(10);
  EXPECT_FALSE(position());
}

// Before everything that decides motion was read, other words may be those that count.
TEST_F(WordsOfALift, TellItsPositionWhenAllThatDecidesMotionWasRead) {
  for (int i = 0; i < 100 && parameters.wordsInDoubt(); ++i) {
    EXPECT_FALSE(position()) << i;
    step();
  }
  run(10);
  EXPECT_TRUE(position());
}

// Another inverter may have taken its place, with other words.
TEST_F(WordsOfALift, TellNoPositionAfterALoss) {
  run(100);
  ASSERT_TRUE(position());
  parameters.handleLoss(drive);
  exchange();
  EXPECT_FALSE(position());
}

// Its high word may be the very one that was not read: the low word alone would be another place.
TEST_F(WordsOfALift, TellNoPositionWhileTheFirstIsNotKnown) {
  values[544] = 10;
  values[545] = 1;
  values.erase(543);
  run(100);
  EXPECT_FALSE(position());
  EXPECT_NE(Refusal::kNone, refusal());
}

// The codes of actual values and setpoints differ: 10 is the actual position, and no setpoint of one.
TEST_F(WordsOfALift, MayHaveTheActualPositionInTheFirst) {
  values[543] = 10;
  values[544] = 15;
  values[545] = 1;
  run(100);
  EXPECT_EQ(Refusal::kNone, refusal()) << message();
}

// P600 = 0: it would take the target for a frequency, or not move at all.
TEST_F(WordsOfALift, PositionOnlyInASetThatDoes) {
  values[1600] = 0;
  run(100);
  EXPECT_EQ(Refusal::kUnexpectedFunction, refusal());
  EXPECT_THAT(message(), HasSubstr("P600 is 0"));
  select(2);
  run(10);
  EXPECT_EQ(Refusal::kNone, refusal()) << message();
}

TEST_F(WordsOfALift, SayThatNobodyKnowsWhetherItPositions) {
  values.erase(600);
  run(100);
  EXPECT_EQ(Refusal::kUnexpectedFunction, refusal());
  EXPECT_THAT(message(), HasSubstr("P600 could not be read"));
}

}  // namespace
}  // namespace nord_driver::cycle
