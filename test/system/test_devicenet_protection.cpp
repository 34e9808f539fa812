// What the driver says would stop a drive when this computer dies, or the bus module does, against what the simulated ones
// then do: P151 of the module, P120 and P513 of the inverter, DeviceNet's own time-out (BU 0280 4.1.3, 5.1, 6).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/drive_protection.h"
#include "system/devicenet_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using Level = node::ProtectionReport::Level;

struct Protection {
  const char* name;
  int p151, p120, p513;  // as on the wire: ms, choice, 0.1 s
  Level level;
  const char* says;
  int fault_without_computer, fault_without_module;  // 102 = E10.2; 0: it runs on
};

class DevicenetProtection : public testing::TestWithParam<Protection> {
 protected:
  static void preset(DevicenetRobot& robot) {
    robot.module(0).parameters().preset(151, 0, 0, GetParam().p151);
    robot.unit(0).parameters().preset(120, 0, 0, GetParam().p120);
    robot.unit(0).parameters().preset(513, 0, 0, GetParam().p513);
  }
  static node::ProtectionReport report(DevicenetRobot& robot) {
    const node::DriveProtection protection{robot.transport().identity(0), profile::Series::kSk2xxe, milliseconds{500},
                                           robot.config().period()};
    return protection.assess(robot.snapshot().drives[0].device);
  }
};

TEST_P(DevicenetProtection, IsWhatHappens) {
  {
    DevicenetRobot robot;
    preset(robot);
    ASSERT_TRUE(robot.bringUpAndEnable());
    const node::ProtectionReport told = report(robot);
    EXPECT_EQ(GetParam().level, told.level) << told.text;
    EXPECT_THAT(told.text, HasSubstr(GetParam().says));
    robot.drive(kHalfSpeed, 0.0, seconds{2});
    robot.bus().run(milliseconds{500});
    EXPECT_EQ(GetParam().fault_without_computer, robot.unit(0).inverter().faultNumber());
  }
  DevicenetRobot robot;
  preset(robot);
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{2});
  robot.module(0).setPowered(false);
  robot.bus().run(seconds{2});
  EXPECT_EQ(GetParam().fault_without_module, robot.unit(0).inverter().faultNumber()) << "its module has failed";
}

INSTANTIATE_TEST_SUITE_P(
    All, DevicenetProtection,
    testing::Values(Protection{"Factory", 0, 1, 0, Level::kFine, "DeviceNet time-out of 0.1 s", 102, 109},
                    Protection{"P151ActsFirst", 60, 1, 0, Level::kFine, "P151 of the bus module of 0.06 s", 103, 109},
                    Protection{"P151ActsLater", 400, 1, 0, Level::kFine, "P151 of the bus module of 0.4 s", 102, 109},
                    Protection{"P120Off", 0, 0, 0, Level::kWarning, "P120 = 0", 102, 0},
                    Protection{"P513IgnoresTheBus", 400, 1, -1, Level::kError, "nothing: P513 = -0.1", 0, 0}),
    [](const auto& test) { return std::string{test.param.name}; });

// Constant words go out once in an expected packet rate, whatever the cycle.
TEST(DevicenetCyclicProtection, P151ShorterThanThePausesIsWarnedAboutAndTrips) {
  DevicenetRobot::Options options;
  options.drives = {{"io", std::string{"cyclic"}}};
  options.bus = {{"expected_packet_rate", 0.1}};
  DevicenetRobot robot{options};
  robot.module(0).parameters().preset(151, 0, 0, 50);
  robot.unit(0).parameters().preset(120, 0, 0, 1);
  robot.unit(0).parameters().preset(513, 0, 0, 0);
  ASSERT_TRUE(robot.bringUp()) << robot.text(0) << " / " << robot.busText();
  robot.run(seconds{1});
  EXPECT_EQ(103, robot.unit(0).inverter().faultNumber());
  const node::DriveProtection protection{robot.transport().identity(0), profile::Series::kSk2xxe, milliseconds{500},
                                         robot.config().period()};
  const node::ProtectionReport told = protection.assess(robot.snapshot().drives[0].device);
  EXPECT_EQ(Level::kWarning, told.level) << told.text;
  EXPECT_THAT(told.text, HasSubstr("P151 of the bus module is shorter than two pauses between telegrams, which may be "
                                   "0.1 s long each"));
}

}  // namespace
}  // namespace nord_driver::test
