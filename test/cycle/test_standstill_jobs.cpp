// Several requests of drives that stand still beside each other: each is answered once, in time, and by its own outcome.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "cycle/standstill_requests.h"
#include "drive/fake_inverter.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr Duration kCycle = std::chrono::milliseconds{10};

class StandstillJobs : public ::testing::Test {
 protected:
  explicit StandstillJobs(std::size_t count = 2) : inverters_(count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) {
      drive::DriveConfig config;
      config.max_frequency.fill(Hertz{50.0});
      drives_.emplace_back(config);
      names.push_back("drive_" + std::to_string(i));
    }
    requests_.emplace(drives_, names, std::vector<std::optional<std::size_t>>(count, 1));
    run(4);
  }
  void step() {
    now_ += kCycle;
    for (DriveIndex i = 0; i < drives_.size(); ++i) {
      const profile::ProcessOutput output = drives_[i].pollOutput(now_);
      drives_[i].handleInput(inverters_[i].exchange(output), true, now_);
    }
    requests_->update(now_);
    collect();
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) step();
  }
  void acknowledge(std::uint32_t id, DriveIndex drive = kAllDrives, Duration patience = std::chrono::seconds{3}) {
    Request request;
    request.id = id;
    request.kind = RequestKind::kAcknowledge;
    request.drive = drive;
    request.patience = patience;
    requests_->handleRequest(request, now_);
    collect();
  }
  void select(std::uint32_t id, std::uint8_t set, Duration patience) {
    Request request;
    request.id = id;
    request.kind = RequestKind::kSelectParameterSet;
    request.drive = 0;
    request.parameter_set = set;
    request.patience = patience;
    requests_->handleRequest(request, now_);
    collect();
  }
  void collect() {
    while (const auto answer = requests_->pollCompletion()) {
      answers_[answer->id].push_back((answer->success ? "yes: " : "no: ") + answer->message.str());
    }
  }
  void trip(DriveIndex drive, bool cause_stands = false) {
    inverters_[drive].fault = true;
    inverters_[drive].cause = cause_stands;
  }

  std::vector<drive::Drive> drives_;
  std::vector<drive::FakeInverter> inverters_;
  std::optional<StandstillRequests> requests_;
  std::map<std::uint32_t, std::vector<std::string>> answers_;
  Instant now_{std::chrono::hours{1}};
};

constexpr const char* kGone = "yes: no fault stands; the drives stay disabled until they are enabled";

TEST_F(StandstillJobs, EachIsAnsweredOnce) {
  trip(0);
  run(2);
  acknowledge(1);
  run(100);
  EXPECT_THAT(answers_[1], ElementsAre(kGone));
}

TEST_F(StandstillJobs, TwoDrivesAreAcknowledgedBesideEachOther) {
  trip(0);
  trip(1);
  run(2);
  acknowledge(1, 1);
  acknowledge(9, 0);
  run(100);
  EXPECT_THAT(answers_[1], ElementsAre(kGone));
  EXPECT_THAT(answers_[9], ElementsAre(kGone));
}

// An edge takes longer.
TEST_F(StandstillJobs, ARequestIsAnsweredWhenItsTimeIsOver) {
  trip(0, true);
  run(2);
  acknowledge(1, 0, 5 * kCycle);
  run(4);
  EXPECT_THAT(answers_[1], IsEmpty());
  step();
  EXPECT_THAT(answers_[1], ElementsAre("no: not confirmed in time: drive drive_0 is fault, status word 0B38"));
  run(100);
  EXPECT_EQ(1u, answers_[1].size());
}

// The drive's own limit is later, or falls into the same cycle: what was seen last is told all the same.
TEST_F(StandstillJobs, ASwitchThatIsNotSeenTellsTheSetInForce) {
  inverters_[0].set_delay = 1000;
  select(1, 2, 5 * kCycle);
  run(5);
  EXPECT_THAT(answers_[1],
              ElementsAre("no: not confirmed in time: drive drive_0 is ready to switch on, status word 0B31; "
                          "parameter set 1 is in force, 2 was asked for"));
}

// A stop has ended the first one, and in the same cycle somebody asks again.
TEST_F(StandstillJobs, WhatAStopHasEndedIsToldSo) {
  trip(0, true);
  run(2);
  acknowledge(1, 0);
  run(2);
  drives_[0].requestQuickStop(now_);
  acknowledge(2, 0);
  run(100);
  EXPECT_THAT(answers_[1], ElementsAre(StartsWith(std::string("no: drive drive_0: ") +
                                                  drive::toString(drive::Refusal::kRequestStopped))));
}

// One of them is done at once, and somebody asks for it again while the other one still takes its time.
TEST_F(StandstillJobs, WhatWasDoneForADriveIsNotAskedOfTheNextRequest) {
  trip(0);
  trip(1, true);
  run(2);
  inverters_[0].fault = false;
  step();
  acknowledge(1);
  run(3);
  inverters_[1].cause = false;
  acknowledge(2, 0);
  run(100);
  EXPECT_THAT(answers_[2], ElementsAre(HasSubstr("no fault stood, and nothing was done")));
  EXPECT_THAT(answers_[1], ElementsAre(kGone));
}

// The first drive was still being stopped and refused. That it would not refuse any more is no answer to who asked then.
TEST_F(StandstillJobs, WhatADriveHasRefusedStaysRefused) {
  trip(0);
  trip(1, true);
  run(2);
  inverters_[0].fault = false;
  drives_[0].requestQuickStop(now_);
  acknowledge(1);
  run(3);
  ASSERT_EQ(drive::Phase::kIdle, drives_[0].report().phase);
  inverters_[1].cause = false;
  acknowledge(2, 0);
  run(100);
  EXPECT_THAT(answers_[2], ElementsAre(StartsWith("yes: no fault stands")));
  EXPECT_THAT(answers_[1], ElementsAre(StartsWith("no: drive drive_0: ")));
}

// Whichever of them it is.
TEST_F(StandstillJobs, ANeighbourWithAFaultIsNamed) {
  for (const DriveIndex asked : {DriveIndex{0}, DriveIndex{1}}) {
    trip(0);
    trip(1);
    run(2);
    answers_.clear();
    acknowledge(1, asked);
    run(100);
    const std::string other = asked == 0 ? "drive_1" : "drive_0";
    EXPECT_THAT(answers_[1], ElementsAre(HasSubstr("drive " + other + " behind the same bus module has a fault too")));
  }
}

/// More than are followed at a time.
class ManyStandstillJobs : public StandstillJobs {
 protected:
  ManyStandstillJobs() : StandstillJobs{20} {}
};

TEST_F(ManyStandstillJobs, EachIsAnsweredHoweverManyThereAre) {
  for (DriveIndex i = 0; i < drives_.size(); ++i) trip(i, true);
  run(2);
  for (DriveIndex i = 0; i < drives_.size(); ++i) acknowledge(static_cast<std::uint32_t>(i + 1), i);
  run(100);
  int refused = 0;
  for (std::uint32_t id = 1; id <= drives_.size(); ++id) {
    ASSERT_EQ(1u, answers_[id].size()) << id;
    refused += answers_[id].front() == "no: too many requests are being carried out already" ? 1 : 0;
  }
  EXPECT_EQ(4, refused);
}

}  // namespace
}  // namespace nord_driver::cycle
