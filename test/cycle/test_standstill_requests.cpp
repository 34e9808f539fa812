// What users ask of drives that stand still: one request acknowledges all of them, and tells who cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "cycle/standstill_requests.h"
#include "drive/fake_inverter.h"

namespace nord_driver::cycle {
namespace {

using drive::Phase;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;

class StandstillRequestsTest : public ::testing::Test {
 protected:
  static drive::DriveConfig config() {
    drive::DriveConfig config;
    config.max_frequency[0] = Hertz{50.0};
    return config;
  }
  void step() {
    now_ += std::chrono::milliseconds{10};
    for (const DriveIndex i : {kLeft, kRight}) {
      const profile::ProcessOutput output = drives_[i].pollOutput(now_);
      edge_seen_[i] = edge_seen_[i] || (output.control_word & 0x0080) != 0;
      drives_[i].handleInput(inverters_[i].exchange(output), true, now_);
    }
    standstill_requests_.update(now_);
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) step();
  }
  void requestAcknowledge(DriveIndex drive) {
    Request request;
    request.id = 7;
    request.kind = RequestKind::kAcknowledge;
    request.drive = drive;
    request.patience = std::chrono::seconds{3};
    standstill_requests_.handleRequest(request, now_);
  }
  /// Acknowledges all drives.
  Completion acknowledge() {
    requestAcknowledge(kAllDrives);
    for (int i = 0; i < 400; ++i) {
      step();
      if (const auto answer = standstill_requests_.pollCompletion()) return *answer;
    }
    Completion none;
    none.message = "no answer";
    return none;
  }
  bool latched(DriveIndex drive) const { return drives_[drive].report().fault_latched; }

  std::vector<drive::Drive> drives_{drive::Drive{config()}, drive::Drive{config()}};
  std::array<drive::FakeInverter, 2> inverters_;
  std::array<bool, 2> edge_seen_{};
  StandstillRequests standstill_requests_{drives_, {"left", "right"}};
  Instant now_{std::chrono::hours{1}};
};

// A fault that stands gets its edge; one that has vanished by itself is taken away without.
TEST_F(StandstillRequestsTest, OneRequestAcknowledgesAllDrives) {
  run(4);
  inverters_[kLeft].fault = inverters_[kRight].fault = true;
  run(2);
  inverters_[kRight].fault = false;
  run(2);
  ASSERT_TRUE(latched(kLeft) && latched(kRight));
  EXPECT_STREQ("no fault stands; the drives stay disabled until they are enabled", acknowledge().message.c_str());
  EXPECT_FALSE(latched(kLeft) || latched(kRight));
  EXPECT_TRUE(edge_seen_[kLeft]);
  EXPECT_FALSE(edge_seen_[kRight]);
  run(4);
  for (const drive::Drive& drive : drives_) EXPECT_EQ(drive::Refusal::kNone, drive.enableRefusal());
}

// No while one cause stands, and whose it is; the other one's fault is gone nevertheless.
TEST_F(StandstillRequestsTest, TheDriveWhoseCauseStandsIsNamed) {
  run(4);
  inverters_[kLeft].fault = inverters_[kRight].fault = inverters_[kRight].cause = true;
  run(2);
  const Completion answer = acknowledge();
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive right: "));
  EXPECT_FALSE(latched(kLeft));
  EXPECT_TRUE(latched(kRight));
  EXPECT_EQ(drive::Refusal::kFault, drives_[kRight].enableRefusal());
}

// Those behind one bus module: after a time-out it waits until each of them is acknowledged (BU 0220 4.2.3.2).
TEST_F(StandstillRequestsTest, ANeighbourBehindTheSameModuleIsNamedAndNoOther) {
  run(4);
  inverters_[kLeft].fault = inverters_[kRight].fault = true;
  run(2);
  const auto answerOf = [this](StandstillRequests& requests) {
    inverters_[kLeft].fault = true;
    run(2);
    Request request;
    request.id = 8;
    request.kind = RequestKind::kAcknowledge;
    request.drive = kLeft;
    request.patience = std::chrono::seconds{3};
    requests.handleRequest(request, now_);
    for (int i = 0; i < 100; ++i) {
      step();
      requests.update(now_);
      if (const auto answer = requests.pollCompletion()) return answer->message.str();
    }
    return std::string{"no answer"};
  };
  StandstillRequests together{drives_, {"left", "right"}, {7, 7}};
  EXPECT_THAT(answerOf(together), HasSubstr("drive right behind the same bus module has a fault too"));
  StandstillRequests others{drives_, {"left", "right"}, {7, 8}};
  EXPECT_EQ("no fault stands; the drives stay disabled until they are enabled", answerOf(others));
  StandstillRequests alone{drives_, {"left", "right"}, {std::nullopt, std::nullopt}};
  EXPECT_EQ("no fault stands; the drives stay disabled until they are enabled", answerOf(alone));
}

// Without any fault there is nothing to do, and that is done: no edge is sent, and who runs runs on.
TEST_F(StandstillRequestsTest, WithoutAFaultNothingIsDone) {
  run(4);
  drives_[kRight].requestEnable(now_);
  run(10);
  ASSERT_EQ(Phase::kEnabled, drives_[kRight].report().phase);
  const Completion answer = acknowledge();
  EXPECT_TRUE(answer.success);
  EXPECT_STREQ("no fault stood, and nothing was done", answer.message.c_str());
  run(10);
  EXPECT_FALSE(edge_seen_[kLeft] || edge_seen_[kRight]);
  EXPECT_EQ(Phase::kIdle, drives_[kLeft].report().phase);
  EXPECT_EQ(Phase::kEnabled, drives_[kRight].report().phase);
}

// "The drives stay disabled" is said of those that had a fault only: the other one turns.
TEST_F(StandstillRequestsTest, ADriveThatTurnsBesideIsNotSaidToBeDisabled) {
  run(4);
  drives_[kRight].requestEnable(now_);
  inverters_[kLeft].fault = true;
  run(10);
  ASSERT_EQ(Phase::kEnabled, drives_[kRight].report().phase);
  EXPECT_STREQ("no fault stands; the drive that had one stays disabled until it is enabled",
               acknowledge().message.c_str());
  EXPECT_FALSE(latched(kLeft));
  EXPECT_EQ(Phase::kEnabled, drives_[kRight].report().phase);
}

// A drive that has a fault and has not come to rest is not acknowledged: its stop goes first.
TEST_F(StandstillRequestsTest, ADriveThatIsStoppedGoesOnStopping) {
  run(4);
  inverters_[kRight].fault = true;
  run(2);
  inverters_[kRight].fault = false;
  drives_[kRight].requestQuickStop(now_);
  requestAcknowledge(kRight);
  standstill_requests_.update(now_);
  const auto answer = standstill_requests_.pollCompletion();
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->success);
  EXPECT_EQ(Phase::kQuickStopping, drives_[kRight].report().phase);
  EXPECT_TRUE(latched(kRight));
}

// What it stopped for when it was enabled last has nothing to do with it.
TEST_F(StandstillRequestsTest, WhatAStopEndsIsToldWithoutACauseOfBefore) {
  for (const RequestKind kind : {RequestKind::kAcknowledge, RequestKind::kSelectParameterSet}) {
    run(4);
    drives_[kLeft].requestEnable(now_);
    run(10);
    ASSERT_EQ(Phase::kEnabled, drives_[kLeft].report().phase);
    inverters_[kLeft].fault = true;
    run(2);
    ASSERT_TRUE(kind == RequestKind::kAcknowledge || acknowledge().success);
    inverters_[kLeft].set_delay = 10;
    Request request;
    request.id = 7;
    request.kind = kind;
    request.drive = kLeft;
    request.parameter_set = 2;
    request.patience = std::chrono::seconds{3};
    standstill_requests_.handleRequest(request, now_);
    run(2);
    ASSERT_FALSE(standstill_requests_.pollCompletion());
    drives_[kLeft].requestQuickStop(now_);
    run(10);
    const auto answer = standstill_requests_.pollCompletion();
    ASSERT_TRUE(answer);
    EXPECT_FALSE(answer->success);
    EXPECT_THAT(answer->message.str(),
                ::testing::StartsWith("drive left: a stop came before it was done (status word"));
    inverters_[kLeft].set_delay = 0;
    ASSERT_TRUE(acknowledge().success);
  }
}

}  // namespace
}  // namespace nord_driver::cycle
