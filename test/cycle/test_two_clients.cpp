// Two clients ask the same drive at the same time: every answer belongs to its own request.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

class TwoClients : public ::testing::Test, protected CycleBench {
 protected:
  std::uint32_t submit(RequestKind kind, DriveIndex drive, std::uint8_t set = 0) {
    Request request;
    request.id = ++last_id;
    request.kind = kind;
    request.drive = drive;
    request.parameter_set = set;
    request.patience = std::chrono::seconds{3};
    EXPECT_TRUE(ports.submit(request));
    return request.id;
  }
  bool answered(std::uint32_t id) const { return completions.count(id) != 0; }
  void runUntilAnswered(std::uint32_t id) {
    for (int i = 0; i < 400 && !answered(id); ++i) step();
    ASSERT_TRUE(answered(id));
  }
};

TEST_F(TwoClients, TheSecondIsNotToldThatItsSetIsActiveWhenTheFirstOnesIs) {
  run(30);
  transport.inverters[kLift].set_delay = 10;
  const auto first = submit(RequestKind::kSelectParameterSet, kLift, 2);
  run(3);
  const auto second = submit(RequestKind::kSelectParameterSet, kLift, 3);
  runUntilAnswered(first);
  runUntilAnswered(second);
  EXPECT_TRUE(completions[first].success);
  EXPECT_STREQ("parameter set 2 is active", completions[first].message.c_str());
  EXPECT_FALSE(completions[second].success);
  EXPECT_STREQ("drive lift: a switch to parameter set 2 is running: ask again", completions[second].message.c_str());
  EXPECT_EQ(2u, transport.inverters[kLift].parameterSet());
  const auto again = submit(RequestKind::kSelectParameterSet, kLift, 3);
  runUntilAnswered(again);
  EXPECT_STREQ("parameter set 3 is active", completions[again].message.c_str());
}

// What ended the first one is its answer, although the second was refused for another reason in the same cycle.
TEST_F(TwoClients, AStopAndASecondRequestInOneCycleLeaveTheFirstItsOwnAnswer) {
  run(30);
  transport.inverters[kLift].set_delay = 10;
  const auto first = submit(RequestKind::kSelectParameterSet, kLift, 2);
  run(3);
  submit(RequestKind::kQuickStop, kLift);
  const auto second = submit(RequestKind::kSelectParameterSet, kLift, 3);
  runUntilAnswered(first);
  runUntilAnswered(second);
  EXPECT_THAT(completions[first].message.c_str(), HasSubstr(drive::toString(drive::Refusal::kRequestStopped)));
  EXPECT_FALSE(completions[first].success || completions[second].success);
}

// The edge of the first was over before the cause went: the second must not be told by it that the cause stands.
TEST_F(TwoClients, ASecondAcknowledgeIsNotAnsweredByTheEdgeOfTheFirst) {
  run(30);
  transport.inverters[kLeft].fault = transport.inverters[kRight].fault = true;
  transport.inverters[kLeft].cause = true;
  run(3);
  const auto one = submit(RequestKind::kAcknowledge, kLeft);
  run(25);  // low and high have been sent: 0.1 s each
  ASSERT_FALSE(answered(one));
  transport.inverters[kLeft].cause = false;
  const auto all = submit(RequestKind::kAcknowledge, kAllDrives);
  runUntilAnswered(one);
  runUntilAnswered(all);
  EXPECT_THAT(completions[one].message.c_str(), HasSubstr("the cause of the fault still stands"));
  EXPECT_FALSE(completions[all].success);
  EXPECT_STREQ("drive left: a fault is being acknowledged: ask again", completions[all].message.c_str());
  const auto again = submit(RequestKind::kAcknowledge, kAllDrives);
  runUntilAnswered(again);
  EXPECT_TRUE(completions[again].success) << completions[again].message.c_str();
}

/// Requests of several clients at random, with losses, faults and stops between them.
class Interleavings : public TwoClients {
 protected:
  void stir(std::mt19937& random) {
    const auto one_in = [&](unsigned n) { return random() % n == 0; };
    drive::FakeInverter& inverter = transport.inverters[kLift];
    if (one_in(40)) inverter.set_delay = static_cast<int>(random() % 60);
    if (one_in(100)) inverter.fault = inverter.cause = true;
    if (one_in(30)) inverter.cause = false;
    inverter.silent = one_in(inverter.silent ? 2 : 300);
    if (one_in(150)) submit(RequestKind::kQuickStop, kLift);
    if (one_in(10)) {
      const auto set = static_cast<std::uint8_t>(1 + random() % 4);
      asked_[submit(RequestKind::kSelectParameterSet, kLift, set)] = set;
    }
    if (one_in(20)) acknowledged_[submit(RequestKind::kAcknowledge, one_in(2) ? kLift : kAllDrives)] = true;
  }
  /// Of this cycle.
  void judge() {
    const DriveSnapshot& lift = snapshot().drives[kLift];
    for (const auto& [id, answer] : completions) {
      if (answer.success && asked_.count(id) != 0) {
        ++granted_;
        ASSERT_EQ("parameter set " + std::to_string(asked_[id]) + " is active", answer.message.str());
        ASSERT_EQ(unsigned{asked_[id]}, (lift.input.status_word >> 14) + 1u);
        ASSERT_EQ(asked_[id], lift.parameter_set);
      }
      if (answer.success && acknowledged_.count(id) != 0) {
        ASSERT_FALSE(lift.fault_latched);
      }
    }
    completions.clear();
  }
  std::map<std::uint32_t, std::uint8_t> asked_;
  std::map<std::uint32_t, bool> acknowledged_;
  int granted_ = 0;
};

TEST_F(Interleavings, ASetIsSaidToBeActiveOnlyWhileTheStatusWordShowsIt) {
  std::mt19937 random{20};
  run(30);
  for (int count = 0; count < 20'000; ++count) {
    stir(random);
    step();
    judge();
    if (HasFatalFailure()) FAIL() << "cycle " << count;
  }
  EXPECT_GT(granted_, 100);
}

}  // namespace
}  // namespace nord_driver::cycle
