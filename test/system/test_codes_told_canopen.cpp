// Every SDO abort code that the project's files describe, given by the far end and told to the user with code and
// meaning.
#include <gtest/gtest.h>

#include "system/can_robot.h"
#include "system/parameter_answers.h"

namespace nord_driver::test {
namespace {

using catalogue::FaultEntry;

constexpr std::uint16_t kParameter = 103;

TEST(CodesToldCanopen, OfSdoAborts) {
  CanRobot robot;
  ASSERT_TRUE(robot.bringUp());
  const std::vector<const FaultEntry*> entries = catalogue::shippedFaults().all(catalogue::FaultCodes::kSdoAbort);
  ASSERT_FALSE(entries.empty());
  for (const FaultEntry* entry : entries) {
    sim::ParameterSwitches switches;
    switches.bus_refuse = sim::BusRefusal{entry->number, kParameter, false};
    robot.unit(0).setParameterSwitches(switches);
    const std::string code = inHex(entry->number >> 16, 4) + " " + inHex(entry->number & 0xFFFFu, 4) + "h, ";
    EXPECT_TRUE(tells(answerTo(robot, {kParameter}), "SDO abort " + code, *entry));
    robot.unit(0).setParameterSwitches({});
    EXPECT_EQ("done: ", answerTo(robot, {kParameter})) << "the channel works again";
  }
}

}  // namespace
}  // namespace nord_driver::test
