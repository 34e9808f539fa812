// What is asked of a drive that positions beside its targets: reference run, teach-in, reset position; and what is answered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/positioning_lift.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

/// Bit 8 of the control word is that of all three; which of them it is, P480 says.
CycleConfig withRequests(std::int32_t function) {
  CycleConfig config = PositioningLift::config();
  const PositionBit bit{PositionBit::Carrier::kControlBit, 8, static_cast<std::uint16_t>(function)};
  config.drives[0].position->home = bit;
  config.drives[0].position->teach = TeachSetup{bit, bit, std::nullopt, 1};
  config.drives[0].position->reset = bit;
  return config;
}

class PositionRequestsInCycle : public ::testing::Test, protected PositioningLift {
 protected:
  static constexpr int kFunction = 22;
  PositionRequestsInCycle() : PositioningLift{withRequests(kFunction)} { transport.parameters[480] = kFunction; }

  std::uint32_t submitFor(RequestKind kind, Duration patience) {
    Request request;
    request.kind = kind;
    request.drive = 0;
    request.id = ++last_id;
    request.patience = patience;
    ports.submit(request);
    return request.id;
  }
  std::string answerOf(std::uint32_t id) {
    return completions.count(id) == 0 ? "none yet" : completions[id].message.str();
  }
};

TEST_F(PositionRequestsInCycle, AReferenceRunEndsWhereTheDriveSaysSo) {
  ASSERT_TRUE(bringUpAndEnable());
  const std::uint32_t home = submit(RequestKind::kHome, 0);
  run(5);
  EXPECT_TRUE(isHigh(8));
  EXPECT_EQ("none yet", answerOf(home));
  transport.inverters[0].reached = false;  // on its way
  run(5);
  transport.inverters[0].second = 250;
  transport.inverters[0].reached = true;
  run(200);
  EXPECT_EQ("drive lift: the reference run has ended, its position is 0.25", answerOf(home));
  EXPECT_TRUE(completions[home].success);
  EXPECT_EQ(0, completions[home].parameter.raw) << "nothing was put into an array";
  EXPECT_TRUE(lift().homed);
  EXPECT_FALSE(isHigh(8));
}

TEST_F(PositionRequestsInCycle, TeachingTellsWhatWasPutIntoTheArray) {
  run(80);
  const std::uint32_t teach = submit(RequestKind::kTeach, 0);
  run(3);
  EXPECT_TRUE(isHigh(8));
  run(300);
  EXPECT_EQ("drive lift was told to take its position, 0.5, into its array", answerOf(teach));
  EXPECT_TRUE(completions[teach].success);
  EXPECT_EQ(500, completions[teach].parameter.raw) << "0.001 revolutions";
  EXPECT_FALSE(isHigh(8));
}

// The run itself goes on to its end: it is no longer waited for.
TEST_F(PositionRequestsInCycle, WhoWaitsForARunNoLongerIsToldThatItGoesOn) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.exchange_time = Duration::zero();
  const std::uint32_t home = submitFor(RequestKind::kHome, std::chrono::seconds{1});
  run(100);
  EXPECT_EQ("none yet", answerOf(home));
  step();
  EXPECT_EQ("drive lift: the reference run goes on, and has not ended in time", answerOf(home));
  EXPECT_FALSE(completions[home].success);
  EXPECT_TRUE(isHigh(8));
}

TEST_F(PositionRequestsInCycle, OneThatIsUnderWayIsNotBegunAgain) {
  ASSERT_TRUE(bringUpAndEnable());
  submit(RequestKind::kHome, 0);
  EXPECT_EQ("drive lift: a reference run is under way already", ask(RequestKind::kHome, 0).message.str());
  EXPECT_FALSE(ask(RequestKind::kTeach, 0).success);
  ASSERT_TRUE(ask(RequestKind::kDisable, 0).success);
  run(50);
  const std::uint32_t teach = submit(RequestKind::kTeach, 0);
  EXPECT_EQ("drive lift: its position is being taught already", ask(RequestKind::kResetPosition, 0).message.str());
  run(300);
  EXPECT_TRUE(completions[teach].success) << answerOf(teach);
  const std::uint32_t reset = submit(RequestKind::kResetPosition, 0);
  EXPECT_EQ("drive lift: its position is being reset already", ask(RequestKind::kTeach, 0).message.str());
  EXPECT_EQ("none yet", answerOf(reset));
}

// Of an enabled drive, which a stop "before the inverter was enabled" is nothing of.
TEST_F(PositionRequestsInCycle, AReferenceRunThatAStopEndsTellsWhatStoppedIt) {
  const char* const kStopped = "drive lift: the drive was stopped before the reference run had ended";
  const auto answerAfter = [this](auto&& happens) {
    EXPECT_TRUE(ask(RequestKind::kEnable, 0).success);
    const std::uint32_t home = submit(RequestKind::kHome, 0);
    run(5);
    EXPECT_TRUE(isHigh(8));
    happens();
    run(100);
    EXPECT_FALSE(completions[home].success);
    return answerOf(home);
  };
  ASSERT_TRUE(bringUpAndEnable());
  EXPECT_EQ(std::string(kStopped) + " (status word 0B31, ready to switch on)",
            answerAfter([this] { submit(RequestKind::kDisable, 0); }));
  EXPECT_EQ(std::string(kStopped) + ": a quick stop was asked for (status word 0B37, operation enabled)",
            answerAfter([this] { submit(RequestKind::kQuickStop, 0); }));
  EXPECT_EQ("drive lift: the inverter does not answer", answerAfter([this] { transport.inverters[0].silent = true; }));
  transport.inverters[0].silent = false;
  run(100);
  EXPECT_EQ(std::string(kStopped) + ": a fault of the inverter (status word 0B38, fault)",
            answerAfter([this] { transport.inverters[0].fault = true; }));
}

// Of one that is disabled, and stays so.
TEST_F(PositionRequestsInCycle, AStopOfATeachingOrAResetIsToldSo) {
  run(80);
  for (const RequestKind stop : {RequestKind::kDisable, RequestKind::kQuickStop}) {
    for (const RequestKind kind : {RequestKind::kTeach, RequestKind::kResetPosition}) {
      const std::uint32_t asked = submit(kind, 0);
      run(3);
      submit(stop, 0);
      run(100);
      EXPECT_FALSE(completions[asked].success);
      EXPECT_THAT(answerOf(asked),
                  HasSubstr("drive lift: something else was asked of the drive before its position was"));
    }
  }
}

TEST_F(PositionRequestsInCycle, ADriveThatDoesNotAnswerIsAskedForNothing) {
  run(80);
  transport.inverters[0].silent = true;
  run(10);
  for (const RequestKind kind : {RequestKind::kHome, RequestKind::kTeach, RequestKind::kResetPosition}) {
    const Completion answer = ask(kind, 0);
    EXPECT_FALSE(answer.success);
    EXPECT_EQ("drive lift: the inverter does not answer", answer.message.str());
  }
}

TEST_F(PositionRequestsInCycle, ABitThatMeansSomethingElseIsNotSent) {
  transport.parameters[480] = kFunction + 1;
  ASSERT_TRUE(bringUpAndEnable());
  const auto refusalOf = [this](RequestKind kind) {
    const Completion answer = ask(kind, 0);
    EXPECT_FALSE(answer.success);
    EXPECT_FALSE(isHigh(8));
    return answer.message.str();
  };
  EXPECT_THAT(refusalOf(RequestKind::kHome), HasSubstr("is 23; set it to 22 (reference run)"));
  EXPECT_THAT(refusalOf(RequestKind::kTeach), HasSubstr("is 23; set it to 22 (teach-in)"));
  EXPECT_THAT(refusalOf(RequestKind::kResetPosition), HasSubstr("is 23; set it to 22 (reset position)"));
}

// Each of them is answered, once, and makes room for the next.
TEST_F(PositionRequestsInCycle, EachIsAnsweredOnce) {
  run(80);
  for (int i = 0; i < 20; ++i) {
    const Completion answer = ask(RequestKind::kHome, 0);
    EXPECT_FALSE(answer.success) << i;
    EXPECT_THAT(answer.message.str(), HasSubstr("drive lift: the drive is not enabled, and a reference run moves it"))
        << i;
  }
  completions.clear();
  run(10);
  EXPECT_TRUE(completions.empty());
}

TEST_F(PositionRequestsInCycle, MoreThanTheCycleKeepsInMindAreRefused) {
  run(80);
  std::uint32_t last = 0;
  for (int i = 0; i < 17; ++i) last = submit(RequestKind::kHome, 0);
  run(3);
  EXPECT_EQ(17u, completions.size());
  EXPECT_THAT(answerOf(last - 1), HasSubstr("not enabled"));
  EXPECT_EQ("too many requests are being carried out already", answerOf(last));
  EXPECT_FALSE(completions[last].success);
}

TEST_F(PositionRequestsInCycle, NoDriveIsMeantByANumberBeyondThem) {
  run(80);
  for (const DriveIndex drive : {DriveIndex{1}, kAllDrives}) {
    const Completion answer = ask(RequestKind::kTeach, drive);
    EXPECT_FALSE(answer.success);
    EXPECT_EQ("of which drive?", answer.message.str());
  }
}

TEST(PositionRequestsOfAVelocityDrive, AreRefusedInWords) {
  CycleBench bench;
  bench.run(80);
  const auto refusalOf = [&bench](RequestKind kind) { return bench.ask(kind, CycleBench::kLift).message.str(); };
  EXPECT_EQ("drive lift follows velocities (mode: velocity): there is no reference run", refusalOf(RequestKind::kHome));
  EXPECT_EQ("drive lift follows velocities (mode: velocity): there is no position to be taught",
            refusalOf(RequestKind::kTeach));
  EXPECT_EQ("drive lift follows velocities (mode: velocity): there is no position to be reset",
            refusalOf(RequestKind::kResetPosition));
}

}  // namespace
}  // namespace nord_driver::cycle
