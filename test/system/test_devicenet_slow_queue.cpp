// A DeviceNet interface whose queue takes a frame only now and then: slower than setpoints are made. Whatever else is to be
// sent (acknowledges of data that come by change, bit strobes), each drive hears the newest word, or its connection ends.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "system/devicenet_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Four times the expected packet rate, in steps of 10 ms (ODVA Vol. 3, 2-3.4), and three cycles.
constexpr Duration kLongest = milliseconds{150};

class DevicenetSlowQueue : public ::testing::TestWithParam<std::tuple<const char*, milliseconds>> {
 protected:
  void SetUp() override {
    DevicenetRobot::Options options;
    options.drives = {{"io", std::string{std::get<0>(GetParam())}}};
    robot_ = std::make_unique<DevicenetRobot>(options);
    ASSERT_TRUE(robot_->bringUpAndEnable()) << robot_->text(0) << " / " << robot_->busText();
    robot_->drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_FALSE(robot_->standsStill());
    robot_->bus().setQueuePace(std::get<1>(GetParam()));
  }
  /// Whether no inverter is told to turn within `limit`; the command is 0.
  bool areStopped(Duration limit) {
    const auto goesOn = [this](std::size_t i) {
      const sim::DriveUnit& unit = robot_->unit(i);
      return unit.inverter().state() == sim::InverterState::kOperationEnabled && unit.inverter().setpoint1() != 0;
    };
    for (const Instant end = robot_->transport().now() + limit; robot_->transport().now() < end;) {
      robot_->command(0.0);
      robot_->step();
      if (!goesOn(0) && !goesOn(1)) return true;
    }
    return false;
  }

  std::unique_ptr<DevicenetRobot> robot_;
};

INSTANTIATE_TEST_SUITE_P(All, DevicenetSlowQueue,
                         ::testing::Combine(::testing::Values("poll", "cos", "cyclic", "strobe"),
                                            ::testing::Values(milliseconds{5}, milliseconds{12}, milliseconds{20},
                                                              milliseconds{40}, milliseconds{100}, milliseconds{1000})),
                         [](const auto& test) {
                           return std::string{std::get<0>(test.param)} +
                                  std::to_string(std::get<1>(test.param).count()) + "ms";
                         });

TEST_P(DevicenetSlowQueue, EveryDriveIsStopped) {
  EXPECT_TRUE(areStopped(kLongest));
}

}  // namespace
}  // namespace nord_driver::test
