// A drive that cannot be enabled says why in the inverter's own words: P700 [-03].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/every_robot.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

template <typename Robot>
class RefusalReason : public ::testing::Test {};
TYPED_TEST_SUITE(RefusalReason, EveryRobot, BusName);

TYPED_TEST(RefusalReason, IsReadBeforeAnybodyAsksAndToldWithTheRefusal) {
  TypeParam robot;
  ASSERT_TRUE(robot.bringUp());
  sim::Terminals terminals;
  terminals.coast = true;  // an input "disable voltage" is low
  robot.unit(0).inverter().setTerminals(terminals);
  robot.run(std::chrono::seconds{2});
  for (int i = 0; i < 200; ++i) {
    robot.step();
    ASSERT_TRUE(robot.snapshot().drives[0].switch_on_reason) << "kept while it is read again";
  }
  EXPECT_EQ(cycle::TerminalFinding::kHeld, robot.snapshot().drives[0].terminals);
  EXPECT_THAT(robot.snapshot().drives[0].terminals_text.str(), HasSubstr("bit 4 = 0: OFF2 or safe stop (STO)"));
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left"));
  EXPECT_THAT(answer.message.c_str(), HasSubstr("bit 4 = 0: OFF2 or safe stop (STO)"));
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P700[-03]"));

  robot.unit(0).inverter().setTerminals({});
  robot.run(std::chrono::seconds{1});
  EXPECT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
}

}  // namespace
}  // namespace nord_driver::test
