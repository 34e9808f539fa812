// P105 is what 100 % of a setpoint means: without it nothing is driven, and written it must never be a step of the
// speed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"
#include "cycle/parameter_requests.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

/// Nobody answers a parameter for so long.
class P105Reads : public ::testing::Test, protected CycleBench {
 protected:
  explicit P105Reads(std::optional<double> typed_max_frequency = std::nullopt) : CycleBench(typed_max_frequency) {
    transport.hold_answers = true;
    for (int i = 0; i < 200; ++i) {
      step();
      for (const auto& [drive, request] : transport.submitted) {
        profile::ParameterResult result;
        result.id = request.id;
        result.outcome = profile::ParameterOutcome::kTimeout;
        transport.results.push_back(result);
      }
      transport.submitted.clear();
    }
    transport.hold_answers = false;
  }
};

class P105ReadsBesideATypedOne : public P105Reads {
 protected:
  P105ReadsBesideATypedOne() : P105Reads(40.0) {}
};

// A parameter channel that was busy elsewhere when the drive came must not keep it from ever being enabled.
TEST_F(P105Reads, AreTriedAgainUntilTheyAreAnswered) {
  const Completion answer = ask(RequestKind::kEnable, kLift);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P105"));
  run(220);  // two seconds, and a little
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success);
  EXPECT_DOUBLE_EQ(50.0, snapshot().drives[kLift].device.max_frequency[0].value_or(0.0));
}

// The typed one counts then, and goes on counting: another scale would be a step of the speed.
TEST_F(P105ReadsBesideATypedOne, AreNotTriedAgain) {
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  commandLift(40.0);
  run(20);
  const std::int16_t before = setpoint(kLift);
  ASSERT_NE(0, before);
  for (int i = 0; i < 300; ++i) {
    commandLift(40.0);
    step();
    ASSERT_EQ(before, setpoint(kLift));
  }
  EXPECT_FALSE(snapshot().drives[kLift].device.max_frequency[0]);
}

class P105Writes : public ::testing::Test, protected CycleBench {
 protected:
  static Request write(DriveIndex drive) {
    Request request = test::writeRequest(drive, 105, 1000);
    request.parameter.parameter_set = 1;
    return request;
  }
};

// The device is read beside the write: an answer about the old P105 is no leave to enable before the write has ended.
TEST_F(P105Writes, NothingIsEnabledOnTheOldOneMeanwhile) {
  run(60);
  transport.inverters[kLift].silent = true;
  run(10);
  transport.inverters[kLift].silent = false;
  transport.hold_answers = true;
  for (int i = 0; transport.submitted.empty(); ++i) {
    ASSERT_LT(i, 300) << "3 s after its return the drive has not been read again";
    step();
  }
  Request request = write(kLift);
  request.id = 4711;
  request.patience = std::chrono::seconds{3};
  ports.submit(request);
  for (int i = 0; transport.submitted.size() < 2; ++i) {
    ASSERT_LT(i, 300) << "the write asks nothing within its patience of 3 s, beside the reading";
    step();
  }
  transport.submitted.pop_back();  // the write's first question stays without an answer
  transport.hold_answers = false;
  transport.answerFirst();
  run(60);
  ASSERT_EQ(0u, completions.count(4711));
  ASSERT_TRUE(snapshot().drives[kLift].device.complete);
  EXPECT_FALSE(ask(RequestKind::kEnable, kLift).success);
}

// Disabled is not at rest: under local control the terminals may turn it, and the bus may have it back at any time.
TEST_F(P105Writes, AreRefusedWhileTheMotorTurns) {
  run(30);
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  commandLift(40.0);
  run(20);
  transport.inverters[kLift].local = true;
  run(5);
  ASSERT_EQ(0x047E, controlWord(kLift));
  ASSERT_EQ(profile::DriveState::kOperationEnabled, snapshot().drives[kLift].state);
  const Completion answer = ask(write(kLift));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P105 decides what setpoints and actual values mean"));
}

}  // namespace
}  // namespace nord_driver::cycle
