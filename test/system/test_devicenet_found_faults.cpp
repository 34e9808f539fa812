// A driver dies while the wheels turn, and a new one starts: the AC drive profile has no word that the inverter ignores, so
// that its first one acknowledges what stands (doc/safety.md, "What a start finds").
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "system/devicenet_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr std::uint16_t kTimeOut = 102;  // E10.2

/// The first driver is killed while it drives. The inverters stop by the time-out of DeviceNet.
class FoundByANewDriver : public ::testing::Test {
 protected:
  void kill(DevicenetRobot::Options options) {
    options_ = std::move(options);
    first_ = std::make_unique<DevicenetRobot>(options_);
    ASSERT_TRUE(first_->bringUpAndEnable());
    first_->drive(kHalfSpeed, 0.0, seconds{3});
    first_->bus().run(seconds{3});
    for (const std::size_t i : {0u, 1u}) ASSERT_EQ(kTimeOut, first_->unit(i).inverter().faultNumber()) << i;
  }
  bool startsAnew() {
    options_.beside = &first_->bus();
    second_ = std::make_unique<DevicenetRobot>(options_);
    return second_->bringUp();
  }

  DevicenetRobot::Options options_;
  std::unique_ptr<DevicenetRobot> first_, second_;
};

class FoundOverAcDrive : public FoundByANewDriver, public ::testing::WithParamInterface<int> {};

TEST_P(FoundOverAcDrive, ATimeOutIsLatchedBeforeTheFirstWordEndsIt) {
  DevicenetRobot::Options options;
  options.assembly = GetParam();
  ASSERT_NO_FATAL_FAILURE(kill(options));
  ASSERT_TRUE(startsAnew()) << second_->busText();
  second_->run(seconds{1});
  for (const std::size_t i : {0u, 1u}) {
    const cycle::DriveSnapshot& drive = second_->snapshot().drives[i];
    EXPECT_TRUE(drive.fault_latched) << i;
    EXPECT_EQ(1u, drive.faults) << i;
    EXPECT_TRUE(second_->online(i)) << i;
  }
  const cycle::Completion refused = second_->ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message.str(), HasSubstr("~acknowledge_faults"));
  EXPECT_TRUE(second_->ask(cycle::RequestKind::kAcknowledge).success);
  EXPECT_STREQ("enabled", second_->ask(cycle::RequestKind::kEnable).message.c_str());
}

// Its number can be read before the first word ends it.
TEST_P(FoundOverAcDrive, ATimeOutIsAcknowledgedAtStartWhereThatIsChosen) {
  DevicenetRobot::Options options;
  options.assembly = GetParam();
  ASSERT_NO_FATAL_FAILURE(kill(options));
  options_.node = {{"acknowledge_at_start", std::string{"bus_timeouts"}}};
  ASSERT_TRUE(startsAnew()) << second_->busText();
  EXPECT_TRUE(second_->runUntil(
      [this] { return !second_->snapshot().drives[0].fault_latched && !second_->snapshot().drives[1].fault_latched; }));
  EXPECT_EQ(kTimeOut, second_->snapshot().drives[0].last_fault_number);
  EXPECT_STREQ("enabled", second_->ask(cycle::RequestKind::kEnable).message.c_str());
}

INSTANTIATE_TEST_SUITE_P(All, FoundOverAcDrive, ::testing::Values(20, 21));

}  // namespace
}  // namespace nord_driver::test
