// What drives tell beside their process data: ~<drive>/values and ~<drive>/fault.
#include <gmock/gmock.h>

#include <cmath>

#include "nord_driver/Fault.h"
#include "nord_driver/Values.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::uint16_t kMotorHot = 21;  // E2.1 as P700 shows it
constexpr std::uint16_t kFaultBit = 0x0008;

class ValuesAndFaults : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
  ros::NodeHandle node_;
};

TEST_F(ValuesAndFaults, ListedParametersComeWithNameUnitAndWords) {
  Topic<Values> values(node_, "nord_driver/left/values");
  const auto read = values.waitNext([](const Values& message) {
    return message.values.size() == 4 && message.values[2].text != "not read yet" &&
           message.values[3].text != "not read yet";
  });
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "left");
  EXPECT_EQ(read->values[0].parameter, "P746");
  EXPECT_EQ(read->values[0].name, "Module status");
  EXPECT_THAT(read->values[0].text, HasSubstr("Bus interface ready"));
  EXPECT_EQ(read->values[1].parameter, "P105 set 3");
  EXPECT_DOUBLE_EQ(read->values[1].value, 25.0);
  EXPECT_EQ(read->values[1].unit, "Hz");
  EXPECT_EQ(read->values[1].text, "25.0 Hz");
  EXPECT_EQ(read->values[2].text, "0.0 no fault");
  EXPECT_EQ(read->values[3].parameter, "P999");
  EXPECT_TRUE(std::isnan(read->values[3].value));
  EXPECT_THAT(read->values[3].text, StartsWith("drive left refuses P999: "));
  // And in the task of the drive.
  const auto in_diagnostics = [](const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) {
      for (const auto& pair : status.values) {
        if (pair.key == "P105 set 3 Maximum frequency" && pair.value == "25.0 Hz") return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(robot().diagnostics.waitNext(in_diagnostics));
}

// Who comes later finds the last message; who is there sees each step.
TEST_F(ValuesAndFaults, AFaultComesWithItsHistoryAndTheCyclesBefore) {
  Topic<Fault> faults(node_, "nord_driver/left/fault");
  ASSERT_TRUE(faults.waitFrom(0, [](const Fault& fault) { return fault.number == 0; })) << "latched";
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.4));
  const std::size_t from = faults.mark();
  ASSERT_TRUE(robot().trip("left", kMotorHot, true).success);
  const auto known = faults.waitFrom(from, [](const Fault& fault) { return !fault.history.empty(); });
  ASSERT_TRUE(known);
  EXPECT_EQ(known->number, kMotorHot);
  EXPECT_TRUE(known->active);
  EXPECT_EQ(known->text, "E2.1, motor overtemperature (I2t)");
  EXPECT_NE(known->cause, "");
  EXPECT_NE(known->remedy, "");
  EXPECT_EQ(known->history_numbers.size(), 5u);
  EXPECT_EQ(known->history_numbers[0], kMotorHot);
  EXPECT_EQ(known->history[0], known->text);
  ASSERT_EQ(known->process_data.size(), 33u);
  for (std::size_t i = 0; i + 1 < known->process_data.size(); ++i) {
    const ProcessData &data = known->process_data[i], &next = known->process_data[i + 1];
    EXPECT_LT(data.stamp, next.stamp) << i;
    EXPECT_EQ(data.status_word & kFaultBit, 0) << i;
    if (data.answered) {
      EXPECT_GT(data.actual_values[0], 0) << i;
    }
  }
  EXPECT_NE(known->process_data[32].status_word & kFaultBit, 0);
  EXPECT_NEAR((known->process_data[32].stamp - known->header.stamp).toSec(), 0.0, 0.01);

  Topic<Fault> late(node_, "nord_driver/left/fault");
  const auto kept = late.waitFrom(0, [](const Fault&) { return true; });
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->number, kMotorHot);

  robot().drive(0.0);
  ASSERT_TRUE(robot().clearCause("left").success);
  const std::size_t before = faults.mark();
  EXPECT_TRUE(eventually([] { return robot().trigger("left/acknowledge_fault").success; }));
  EXPECT_TRUE(faults.waitFrom(before, [](const Fault& fault) { return fault.number == 0; }));
  EXPECT_TRUE(robot().waitForRest());
}

}  // namespace
}  // namespace nord_driver::test
