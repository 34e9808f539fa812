// Every error code of DeviceNet that the project's files describe, given by the far end and told to the user with code
// and meaning: of a parameter access, and of the allocation before there is any.
#include <gtest/gtest.h>

#include "system/devicenet_robot.h"
#include "system/parameter_answers.h"

namespace nord_driver::test {
namespace {

using catalogue::FaultCodes;
using catalogue::FaultEntry;

constexpr std::uint16_t kParameter = 103;

TEST(CodesToldDevicenet, OfExplicitMessages) {
  DevicenetRobot robot;
  ASSERT_TRUE(robot.bringUp());
  const std::vector<const FaultEntry*> entries = catalogue::shippedFaults().all(FaultCodes::kDevicenetGeneral);
  ASSERT_FALSE(entries.empty());
  for (const FaultEntry* entry : entries) {
    sim::ParameterSwitches switches;
    switches.bus_refuse = sim::BusRefusal{entry->number, kParameter, false};
    robot.unit(0).setParameterSwitches(switches);
    EXPECT_TRUE(tells(answerTo(robot, {kParameter}), "DeviceNet error " + inHex(entry->number, 2) + "h, ", *entry));
    robot.unit(0).setParameterSwitches({});
    EXPECT_EQ("done: ", answerTo(robot, {kParameter})) << "the channel works again";
  }
}

TEST(CodesToldDevicenet, OfARefusedAllocation) {
  const std::vector<const FaultEntry*> entries = catalogue::shippedFaults().all(FaultCodes::kDevicenetAllocate);
  ASSERT_FALSE(entries.empty());
  for (const FaultEntry* entry : entries) {
    DevicenetRobot robot;
    const auto code = static_cast<std::uint8_t>(entry->number);
    robot.module(0).refuseAllocation(sim::DnAllocation{sim::CipStatus::kStateConflict, code});
    robot.run(std::chrono::seconds{5});
    EXPECT_TRUE(tells(robot.text(0), "present state (0Ch): ", *entry));
    EXPECT_NE(std::string::npos, robot.text(0).find("(additional code " + inHex(entry->number, 2) + "h)"))
        << robot.text(0);
    robot.module(0).refuseAllocation(std::nullopt);
    EXPECT_TRUE(robot.bringUp()) << "it is tried again";
  }
}

}  // namespace
}  // namespace nord_driver::test
