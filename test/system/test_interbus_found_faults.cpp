// A new driver on a ring that another one has left: DRIVECOM has no word that the inverter ignores, so that the first one
// acknowledges what stands (doc/safety.md, "What a start finds").
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "system/interbus_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr std::uint16_t kOvercurrent = 30;  // E3.0

/// The first driver is killed while it drives. Nothing ends the outputs of the gateway: it repeats the last words.
class FoundOverDrivecom : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    options_.drivecom = true;
    options_.watchdog = false;
    options_.bus = {{"inputs/function", GetParam()}};
    first_ = std::make_unique<InterbusRobot>(options_);
    ASSERT_TRUE(first_->bringUpAndEnable()) << first_->busText();
    first_->drive(kHalfSpeed, 0.0, seconds{3});
    gateway().resetConnection();
    gateway().close();
    gateway().run(seconds{1});
    options_.beside = &gateway();
  }
  void startAnew() { second_ = std::make_unique<InterbusRobot>(options_); }
  bool startsAnew() {
    startAnew();
    return second_->bringUp();
  }
  sim::SimulatedGateway& gateway() { return first_->gateway(); }
  bool enabled(std::size_t drive) {
    return first_->unit(drive).inverter().state() == sim::InverterState::kOperationEnabled;
  }
  void trip() {
    for (const std::size_t i : {0u, 1u}) first_->unit(i).inverter().trip(kOvercurrent, false);
    gateway().run(seconds{3});
  }

  InterbusRobot::Options options_;
  std::unique_ptr<InterbusRobot> first_, second_;
};

TEST_P(FoundOverDrivecom, AFaultIsLatchedBeforeTheFirstWordEndsIt) {
  trip();
  ASSERT_TRUE(startsAnew()) << second_->busText();
  second_->run(seconds{1});
  for (const std::size_t i : {0u, 1u}) {
    const cycle::DriveSnapshot& drive = second_->snapshot().drives[i];
    EXPECT_TRUE(drive.fault_latched) << i;
    EXPECT_EQ(1u, drive.faults) << i;
  }
  const cycle::Completion refused = second_->ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message.str(), HasSubstr("~acknowledge_faults"));
  EXPECT_TRUE(second_->ask(cycle::RequestKind::kAcknowledge).success);
  EXPECT_STREQ("enabled", second_->ask(cycle::RequestKind::kEnable).message.c_str());
}

// The word that stops goes out when what was seen has been told: two cycles later at most.
TEST_P(FoundOverDrivecom, WhatStillTurnsIsStoppedRightAfterTheLook) {
  ASSERT_TRUE(enabled(0) && enabled(1));
  std::optional<Instant> read, written;
  std::string words;
  gateway().setTap([&](ByteView bytes, sim::SimulatedGateway::Sender sender, Instant at) {
    if (sender != sim::SimulatedGateway::Sender::kDriver) return;
    const ByteView pdu = bytes.sub(7);
    const bool writes = pdu[0] == 16 || pdu[0] == 23;
    if (writes && !written) {
      written = at;
      words = toHex(pdu.sub(pdu.size() - 8));
    }
    if (!writes && !read) read = at;
  });
  startAnew();
  second_->run(milliseconds{200});
  ASSERT_TRUE(read && written);
  EXPECT_LT(*read, *written);
  EXPECT_LE(*written - *read, milliseconds{20});
  EXPECT_EQ("00 7E 00 00 00 7E 00 00", words);
  ASSERT_TRUE(second_->runUntil([this] { return !enabled(0) && !enabled(1); }, seconds{5}));
  EXPECT_FALSE(second_->snapshot().drives[0].fault_latched);
}

INSTANTIATE_TEST_SUITE_P(Functions, FoundOverDrivecom, ::testing::Values(4, 23));

}  // namespace
}  // namespace nord_driver::test
