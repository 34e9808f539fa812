// Every error number of a parameter answer (BU 2700 6.5.1.1, the table of error messages in PWE2), given by the
// inverter and told to the user in a sentence: by an order that leads to it where the simulated inverter has one, else
// as an experimenter lets it answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <tuple>

#include "system/parameter_answers.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

constexpr DriveIndex kLeft = 0;

// --- Orders that lead to an error

struct ByAnOrder {
  unsigned error;
  Access access;
  sim::PkwSettings pkw;
  const char* sentence;
};

void PrintTo(const ByAnOrder& row, std::ostream* out) {
  *out << "error " << row.error;
}

sim::PkwSettings withoutDoubleWords() {
  sim::PkwSettings settings;
  settings.double_word_answers = false;
  return settings;
}

class ParameterErrors : public ::testing::TestWithParam<ByAnOrder> {};

TEST_P(ParameterErrors, OfAnOrderAreTold) {
  SimulatedRobot::Options options;
  options.pkw = GetParam().pkw;
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_EQ(GetParam().sentence, answerTo(robot, GetParam().access));
  EXPECT_EQ(0u, robot.unit(kLeft).parameters().eepromWrites());
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

INSTANTIATE_TEST_SUITE_P(
    Bu2700, ParameterErrors,
    ::testing::Values(
        ByAnOrder{0, {999}, {}, "drive left refuses P999: PKW error 0, the inverter has no parameter of this number"},
        ByAnOrder{
            1,
            {749, 0, 9.0},  // of no SK 5xxE in the catalogue, which would refuse it itself
            {},
            "drive left refuses P749: PKW error 1, the parameter cannot be changed (it is read-only, or P509 does "
            "not select this bus)"},
        ByAnOrder{2,
                  {102, 0, 400.0},
                  {},
                  "drive left refuses P102: PKW error 2, the value is beyond the lower or upper limit"},
        ByAnOrder{3, {701, 6}, {}, "drive left refuses P701: PKW error 3, the sub-index is wrong"},
        ByAnOrder{4, {749, 2}, {}, "drive left refuses P749: PKW error 4, the parameter is no array"},
        ByAnOrder{5, {613, 0, 1.0}, {}, "drive left refuses P613: PKW error 5, the data type is wrong"},
        ByAnOrder{202,
                  {613},
                  withoutDoubleWords(),
                  "drive left refuses P613: PKW error 202, the internal answer label cannot be represented: the answer "
                  "does not fit this process data type, use PPO 2 or acyclic access"}),
    [](const auto& test) { return "Error" + std::to_string(test.param.error); });

// 201 is no end of it: the write goes the other way, and the user is told what that cost.
TEST(ParameterError201, OfAnInverterWithoutRamOrdersLeadsToP560) {
  SimulatedRobot::Options options;
  options.pkw.ram_orders = false;
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_EQ(
      "done: this inverter has no order that spares the EEPROM: P560 was set to 0 for the write and put back to 1 "
      "(counted as two EEPROM writes)",
      answerTo(robot, {102, 0, 3.0}));
  EXPECT_EQ(300, robot.unit(kLeft).parameters().value(102));
}

// --- Errors no order of ours leads to

struct ByTheInverter {
  Word error;
  const char* told;
};

void PrintTo(const ByTheInverter& row, std::ostream* out) {
  *out << "error " << row.error;
}

enum class Channel { kPkw, kRecords };

void PrintTo(Channel channel, std::ostream* out) {
  *out << (channel == Channel::kPkw ? "PKW" : "records");
}

/// Over the parameter channel of the telegrams, and by records of DP-V1 (SK CU4 with PPO 3).
class AnsweredErrors : public ::testing::TestWithParam<std::tuple<Channel, ByTheInverter>> {};

TEST_P(AnsweredErrors, AreTold) {
  const auto [channel, row] = GetParam();
  SimulatedRobot::Options options;
  if (channel == Channel::kRecords) {
    options.one_module = true;
    options.drives["ppo_type"] = 3;
  }
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  sim::ParameterSwitches switches;
  switches.refuse = sim::PkwRefusal{row.error, 103};
  robot.unit(kLeft).setParameterSwitches(switches);
  // An inverter that is not there is not asked any more.
  const bool absent = row.error == 101 || row.error == 102;
  const std::string head = "drive left refuses P103: PKW error " + std::to_string(row.error) + ", ";
  EXPECT_EQ(head + row.told, answerTo(robot, {103}));
  // Nothing that was not read is written over.
  EXPECT_EQ((absent ? "drive left does not answer" : head + row.told) +
                "; the present value could not be read, so nothing was written",
            answerTo(robot, {103, 0, 500.0}));
  EXPECT_EQ(200, robot.unit(kLeft).parameters().value(103));

  robot.unit(kLeft).setParameterSwitches({});
  robot.run(std::chrono::milliseconds{absent ? 1500 : 0});
  ASSERT_TRUE(robot.snapshot().drives[kLeft].online);
  EXPECT_EQ("done: ", answerTo(robot, {103})) << "the channel works again";
}

INSTANTIATE_TEST_SUITE_P(
    Bu2700, AnsweredErrors,
    ::testing::Combine(
        ::testing::Values(Channel::kPkw, Channel::kRecords),
        ::testing::Values(
            ByTheInverter{0, "the inverter has no parameter of this number"},
            ByTheInverter{1, "the parameter cannot be changed (it is read-only, or P509 does not select this bus)"},
            ByTheInverter{2, "the value is beyond the lower or upper limit"},
            ByTheInverter{3, "the sub-index is wrong"}, ByTheInverter{5, "the data type is wrong"},
            ByTheInverter{6, "the parameter can only be reset (only 0 may be written)"},
            ByTheInverter{7, "the description element cannot be changed"},
            ByTheInverter{9, "there are no description data (acyclic: a READ came without a WRITE before it)"},
            ByTheInverter{101, "the addressed inverter does not exist"},
            ByTheInverter{102, "the addressed inverter does not exist"},
            ByTheInverter{103, "the addressed inverter exists, but another bus participant blocks the access"},
            ByTheInverter{201, "the order label of the last order is invalid"},
            ByTheInverter{77, "an error number the manuals do not list"})),
    [](const auto& test) {
      const Channel channel = std::get<Channel>(test.param);
      return (channel == Channel::kPkw ? "Pkw" : "Records") + std::to_string(std::get<ByTheInverter>(test.param).error);
    });

}  // namespace
}  // namespace nord_driver::test
