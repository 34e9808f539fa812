// The picture of nord_param scope, of a simulated robot that is driven by the whole stack below ROS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "system/simulated_robot.h"
#include "tools/scope_observer.h"
#include "tools/scope_svg.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

// A wheel that is driven: up the ramp, on, and down again. With NORD_SCOPE_CSV=FILE the values are kept.
TEST(Scope, ShowsADrivenWheel) {
  SimulatedRobot::Options options;
  options.node = {{"cycle_rate", 50.0}};
  options.drives = {{"ppo_type", 2}};
  options.ppo_type = 2;
  options.parameters = {{544, 0, 0, 3}};  // actual value 2 is the current
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  tools::ScopeObserver observer{1000};
  robot.ports().setObserver(&observer);
  robot.run(seconds(0.5));
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  robot.drive(kHalfSpeed, 0.0, seconds(3.5));
  robot.drive(0.0, 0.0, seconds(2.0));
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  robot.run(seconds(0.5));
  robot.ports().setObserver(nullptr);

  tools::ScopeRecord record;
  record.drive = "left";
  record.max_frequency = 50.0;
  record.current_word = 2;
  record.samples = observer.samples();
  ASSERT_GT(record.samples.size(), 300u);
  std::int16_t highest = 0, current = 0;
  for (const tools::ScopeSample& sample : record.samples) {
    EXPECT_TRUE(sample.answered);
    highest = std::max(highest, sample.input.actual_values[0]);
    current = std::max(current, sample.input.actual_values[1]);
  }
  EXPECT_NEAR(8192, highest, 50) << "25 Hz";
  EXPECT_GT(current, 0);
  EXPECT_EQ(0, record.samples.back().input.actual_values[0]);
  const std::string picture = tools::scopeSvg(record);
  EXPECT_THAT(picture, HasSubstr(">operation enabled<"));
  EXPECT_THAT(picture, HasSubstr(">ready to switch on<"));
  if (const char* const file = std::getenv("NORD_SCOPE_CSV")) std::ofstream(file) << tools::scopeCsv(record);
}

}  // namespace
}  // namespace nord_driver::test
