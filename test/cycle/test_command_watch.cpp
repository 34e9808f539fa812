// Whether commands are quiet: which of them count, and for how long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/command_watch.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

constexpr Duration kTimeout = std::chrono::milliseconds{500};

class CommandWatchTest : public ::testing::Test {
 protected:
  /// Listens for as long as it takes; quiet until then.
  void listen() {
    watch_.look(now_);
    now_ += kTimeout;
    ASSERT_TRUE(watch_.look(now_).quiet);
  }
  /// A command that moves, and zero behind it.
  template <typename Command>
  void moveAndStop(Command command) {
    command(5.0);
    now_ += std::chrono::milliseconds{10};
    command(0.0);
  }
  /// Nothing moves; but it is quiet only when that has lasted.
  void expectQuietLater() {
    EXPECT_TRUE(watch_.look(now_).moving.empty());
    EXPECT_FALSE(watch_.look(now_).quiet);
    now_ += kTimeout;
    EXPECT_TRUE(watch_.look(now_).quiet);
  }
  static SetpointSetup setpoint() {
    SetpointSetup setpoint;
    setpoint.name = "boost";
    setpoint.timeout = kTimeout;
    setpoint.moves = true;
    return setpoint;
  }

  CyclePorts ports_{3};
  CommandWatch watch_{ports_, kTimeout, true, {"single", "wheel", "lift"}, {false, true, false}};
  Instant now_{std::chrono::hours{1}};
};

TEST_F(CommandWatchTest, EachSingleDriveCounts) {
  listen();
  for (const DriveIndex drive : {DriveIndex{0}, DriveIndex{2}}) {
    moveAndStop([&](double velocity) { ports_.commandDrive(drive, {velocity, now_, true}); });
    expectQuietLater();
  }
}

TEST_F(CommandWatchTest, AWheelHasNoCommandOfItsOwn) {
  listen();
  ports_.commandDrive(1, {5.0, now_, true});
  EXPECT_TRUE(watch_.look(now_).quiet);
}

TEST_F(CommandWatchTest, TheBaseCounts) {
  listen();
  moveAndStop([&](double velocity) { ports_.commandBase({{velocity, 0.0}, now_, true}); });
  expectQuietLater();
}

TEST_F(CommandWatchTest, ASetpointThatCanTurnTheMotorCounts) {
  watch_.watch(2, 0, setpoint());
  listen();
  moveAndStop([&](double value) { ports_.commandSetpoint(2, 0, value, now_); });
  expectQuietLater();
}

// Of the drives that are asked for alone.
TEST_F(CommandWatchTest, ASetpointIsThatOfItsDrive) {
  watch_.watch(2, 0, setpoint());
  ports_.commandSetpoint(2, 0, 5.0, now_);
  EXPECT_THAT(watch_.movingOf({2}, false, now_).c_str(), HasSubstr("setpoint boost of drive lift is not zero"));
  EXPECT_STREQ("", watch_.movingOf({0}, true, now_).c_str());
}

}  // namespace
}  // namespace nord_driver::cycle
