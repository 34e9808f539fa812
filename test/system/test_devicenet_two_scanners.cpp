// Two drivers on one DeviceNet with the same modules: the second one is named, and nothing moves; and two with one MAC id.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "system/devicenet_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;

class DevicenetTwoScanners : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(first_.bringUpAndEnable());
    first_.drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_EQ(0x2000, first_.setpoint(kLeft));
  }
  void startSecond(int mac_id) {
    DevicenetRobot::Options options;
    options.bus = {{"mac_id", mac_id}, {"serial_number", 0x99}};
    options.beside = &first_.bus();
    second_ = std::make_unique<DevicenetRobot>(options);
  }
  /// A cycle of each in turn; somebody goes on commanding the first one.
  void step() {
    first_.command(kHalfSpeed);
    first_.step();
    if (second_) second_->step();
  }
  template <typename Condition>
  bool runUntil(Condition done, Duration limit) {
    for (const Instant end = now() + limit; now() < end && !done();) step();
    return done();
  }
  void run(Duration span) {
    runUntil([] { return false; }, span);
  }
  Instant now() { return first_.transport().now(); }
  static bool bothOnline(DevicenetRobot& robot) { return robot.online(kLeft) && robot.online(kRight); }
  /// Whoever is asked: no wheel turns from now on.
  void expectRestForGood() {
    ASSERT_TRUE(runUntil([this] { return first_.standsStill(); }, seconds{30}));  // who coasts, coasts long
    for (const Instant end = now() + seconds{5}; now() < end;) {
      step();
      ASSERT_TRUE(first_.standsStill());
      ASSERT_FALSE(first_.snapshot().base.enabled);
    }
  }

  DevicenetRobot first_;
  std::unique_ptr<DevicenetRobot> second_;
};

// It is refused by the modules, polls none, and says whose they are; the first one stops its base and names it. The referee
// is not asked: a module somebody else works with is sent control word 0, which its inverter ignores, once it stands.
TEST_F(DevicenetTwoScanners, OneThatComesSecondIsNamedAndNothingMoves) {
  const std::uint64_t polls = first_.module(kLeft).counters().polls;
  startSecond(1);
  run(seconds{5});
  EXPECT_THAT(first_.busText(), HasSubstr("another master, MAC id 1, is on the bus"));
  EXPECT_GT(first_.snapshot().counters.value(bus_counter::kUnexpected), 0u);
  EXPECT_THAT(second_->text(kLeft), HasSubstr("is allocated to another master, MAC id 0"));
  EXPECT_FALSE(second_->online(kLeft) || second_->online(kRight));
  EXPECT_FALSE(second_->transport().connected());
  EXPECT_FALSE(second_->ask(cycle::RequestKind::kEnable).success);
  EXPECT_TRUE(first_.module(kLeft).inDataExchange()) << "it is not taken away";
  EXPECT_GT(first_.module(kLeft).counters().polls, polls);
  ASSERT_NO_FATAL_FAILURE(expectRestForGood());
  EXPECT_TRUE(first_.snapshot().base.stopped);
  EXPECT_THAT(first_.snapshot().base.text.c_str(), HasSubstr("another master commands it, too"));

  // It ends, and the first has its modules back, at rest.
  second_->transport().close();
  second_.reset();
  ASSERT_TRUE(runUntil([this] { return bothOnline(first_); }, seconds{3}));
  ASSERT_NO_FATAL_FAILURE(expectRestForGood());
  first_.run(milliseconds{600});
  first_.ask(cycle::RequestKind::kAcknowledge);
  EXPECT_STREQ("enabled", first_.ask(cycle::RequestKind::kEnable).message.c_str());
}

// The first one ends cleanly: the modules are free, and the second takes them over at rest.
TEST_F(DevicenetTwoScanners, TheSecondTakesOverWhatTheFirstHasReleased) {
  startSecond(1);
  run(seconds{3});
  first_.run(milliseconds{600});
  ASSERT_TRUE(first_.ask(cycle::RequestKind::kShutDown).success);
  first_.transport().close();
  ASSERT_TRUE(second_->runUntil([this] { return bothOnline(*second_); }, seconds{6})) << second_->busText();
  EXPECT_TRUE(first_.standsStill());
  EXPECT_FALSE(second_->snapshot().base.enabled);
  ASSERT_TRUE(second_->bringUp());
  second_->ask(cycle::RequestKind::kAcknowledge);
  ASSERT_STREQ("enabled", second_->ask(cycle::RequestKind::kEnable).message.c_str());
  second_->drive(kHalfSpeed, 0.0, seconds{3});
  EXPECT_NEAR(25.0, first_.unit(kLeft).inverter().frequency(), 0.1);
}

// The same MAC id: the second one is in communication fault and sends nothing but its question; the first drives on.
TEST_F(DevicenetTwoScanners, OneWithOurMacIdStaysInCommunicationFault) {
  startSecond(0);
  run(seconds{4});
  EXPECT_THAT(second_->busText(), HasSubstr("communication fault: another device has our MAC id 0"));
  EXPECT_THAT(second_->text(kLeft), HasSubstr("communication fault"));
  EXPECT_TRUE(first_.snapshot().base.enabled) << first_.snapshot().base.text.str();
  EXPECT_NEAR(25.0, first_.unit(kLeft).inverter().frequency(), 0.1);
  EXPECT_EQ("no rule broken", first_.bus().referee().report());
  EXPECT_EQ(0u, first_.snapshot().counters.value(bus_counter::kUnexpected));
}

}  // namespace
}  // namespace nord_driver::test
