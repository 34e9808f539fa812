// What the node's services do over InterBus: where the gateway carries Compact PCP, and where it carries process data
// only, as most do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "catalogue/fault_words.h"
#include "cycle/parameter_requests.h"
#include "profile/fault_number.h"
#include "system/interbus_robot.h"

namespace nord_driver::test {
namespace {

using profile::ParameterAction;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Optional;

constexpr std::uint16_t kAccelerationTime = 102, kMaxFrequency = 105, kEepromSwitch = 560;
constexpr std::uint16_t kMotorHot = 21;  // E2.1 as P700 shows it

cycle::Request readRequest(DriveIndex drive, std::uint16_t number) {
  cycle::Request request = writeRequest(drive, number, 0, ParameterAction::kRead);
  request.kind = cycle::RequestKind::kReadParameter;
  return request;
}

cycle::Completion selectSet(InterbusRobot& robot, std::uint8_t set) {
  cycle::Request request;
  request.kind = cycle::RequestKind::kSelectParameterSet;
  request.drive = 0;
  request.parameter_set = set;
  return robot.ask(request);
}

/// P105 is 100 Hz in all sets, and nobody has typed it in.
InterbusRobot::Options withPcp() {
  InterbusRobot::Options options;
  options.pcp = true;
  options.max_frequency.reset();
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) {
      for (std::uint8_t set = 0; set < 4; ++set) drive.parameters.push_back({kMaxFrequency, set, 0, 1000});
    }
  };
  return options;
}

bool isOnline(InterbusRobot& robot) {
  return robot.runUntil([&] { return robot.online(0) && robot.online(1); });
}

// --- With Compact PCP ---

struct Words {
  const char* name;
  bool swapped;
  bool drivecom;
};

void PrintTo(const Words& words, std::ostream* out) {
  *out << words.name;
}

class InterbusPcpScaling : public ::testing::TestWithParam<Words> {};

// P105 read at start is what a setpoint is a share of, and what rpm are told by.
TEST_P(InterbusPcpScaling, P105IsReadAndScales) {
  InterbusRobot::Options options = withPcp();
  options.swapped = GetParam().swapped;
  options.drivecom = GetParam().drivecom;
  InterbusRobot robot{options};
  ASSERT_TRUE(isOnline(robot));
  EXPECT_FALSE(robot.snapshot().drives[1].device.max_frequency[0]);
  const cycle::Completion enabled = robot.ask(cycle::RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  EXPECT_THAT(robot.snapshot().drives[1].device.max_frequency, Each(Optional(100.0))) << "enabling has waited for it";
  robot.drive(kHalfSpeed, 0.0, seconds{5});
  EXPECT_NEAR(0x1000, robot.setpoint(0), 1);
  EXPECT_NEAR(25.0, robot.unit(0).inverter().frequency(), 0.05) << "the truth; DRIVECOM has steps of 1 rpm";
  EXPECT_NEAR(-25.0, robot.unit(1).inverter().frequency(), 0.05);
  EXPECT_EQ("no rule broken", robot.referee());
}

INSTANTIATE_TEST_SUITE_P(All, InterbusPcpScaling,
                         ::testing::Values(Words{"Nord", false, false}, Words{"Swapped", true, false},
                                           Words{"Drivecom", false, true}),
                         [](const auto& test) { return std::string{test.param.name}; });

TEST(InterbusPcp, ReadsAndWritesParameters) {
  InterbusRobot robot{withPcp()};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion read = robot.ask(readRequest(1, kAccelerationTime));
  EXPECT_TRUE(read.success) << read.message.c_str();
  EXPECT_EQ(200, read.parameter.raw);

  const cycle::Completion kept = robot.ask(writeRequest(0, kAccelerationTime, 103, ParameterAction::kWritePersistent));
  EXPECT_TRUE(kept.success) << kept.message.c_str();
  EXPECT_EQ(103, kept.parameter.raw);
  EXPECT_EQ(103, robot.unit(0).parameters().value(kAccelerationTime));
  EXPECT_EQ(200, robot.unit(1).parameters().value(kAccelerationTime));

  // PCP cannot spare the EEPROM: P560 is set to 0 for the write, and put back.
  const cycle::Completion lost = robot.ask(writeRequest(0, kAccelerationTime, 150));
  EXPECT_TRUE(lost.success) << lost.message.c_str();
  EXPECT_THAT(lost.message.c_str(), HasSubstr("P560 was set to 0 for the write and put back to 1"));
  EXPECT_EQ(150, robot.unit(0).parameters().value(kAccelerationTime));
  EXPECT_EQ(1, robot.unit(0).parameters().value(kEepromSwitch));
}

TEST(InterbusPcp, ARefusalIsToldInWords) {
  InterbusRobot robot{withPcp()};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion limits = robot.ask(writeRequest(0, kAccelerationTime, -5, ParameterAction::kWritePersistent));
  EXPECT_FALSE(limits.success);
  EXPECT_THAT(limits.message.c_str(), HasSubstr("drive left refuses P102: PCP error 8/0 (additional code 0032h), the "
                                                "value is below the lower limit"));
  const cycle::Completion unknown = robot.ask(readRequest(0, 999));
  EXPECT_FALSE(unknown.success);
  EXPECT_THAT(unknown.message.c_str(), HasSubstr("drive left refuses P999: PCP error 6/7"));
  EXPECT_TRUE(robot.online(0));
}

TEST(InterbusPcp, TheFaultNumberIsRead) {
  InterbusRobot robot{withPcp()};
  ASSERT_TRUE(robot.bringUp());
  robot.unit(0).inverter().trip(kMotorHot, true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.snapshot().drives[0].fault_number == kMotorHot; }));
  EXPECT_EQ(0, robot.snapshot().drives[1].fault_number);
}

TEST(InterbusPcp, AnotherParameterSetIsSelected) {
  InterbusRobot robot{withPcp()};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = selectSet(robot, 3);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(3, robot.snapshot().drives[0].parameter_set);
  EXPECT_EQ(2u, robot.unit(0).inverter().parameterSet()) << "counted from 0";
}

// A request has one answer, whatever becomes of the connection, and the next one goes its way.
TEST(InterbusPcp, WhoIsAskedWhileTheGatewayFallsSilentDoesNotAnswer) {
  InterbusRobot robot{withPcp()};
  ASSERT_TRUE(robot.bringUp());
  sim::NetworkState network;
  network.carries_answers = false;
  robot.gateway().setNetwork(network);
  const cycle::Completion silent = robot.ask(readRequest(0, kAccelerationTime));
  EXPECT_FALSE(silent.success);
  EXPECT_THAT(silent.message.c_str(), HasSubstr("drive left does not answer"));
  robot.gateway().setNetwork({});
  ASSERT_TRUE(isOnline(robot));
  const cycle::Completion again = robot.ask(readRequest(0, kAccelerationTime));
  EXPECT_TRUE(again.success) << again.message.c_str();
  EXPECT_EQ(200, again.parameter.raw);
}

// The images go on where the blocks are configured wrongly.
TEST(InterbusPcp, BlocksTheGatewayDoesNotHaveCostNoProcessData) {
  InterbusRobot::Options options = withPcp();
  options.max_frequency = 100.0;
  options.bus = {{"pcp/result/address", 700}, {"pcp/timeout", 0.1}};
  InterbusRobot robot{options};
  ASSERT_TRUE(isOnline(robot));
  const std::uint64_t missed = robot.transport().counters().value("without_inputs");
  const cycle::Completion answer = robot.ask(readRequest(0, kAccelerationTime));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), AllOf(HasSubstr("drive left gave no answer for P102"),
                                            HasSubstr("registers 700 to 706"), HasSubstr("exception 2")));
  EXPECT_TRUE(robot.online(0) && robot.online(1));
  const BusCounters counters = robot.transport().counters();
  EXPECT_GT(counters.value("exceptions"), 0u);
  EXPECT_EQ(1u, counters.value("connections"));
  EXPECT_EQ(missed, counters.value("without_inputs"));
}

// --- Without a parameter channel ---

struct Access {
  const char* name;
  cycle::Request request;
};

void PrintTo(const Access& access, std::ostream* out) {
  *out << access.name;
}

class WithoutPcp : public ::testing::TestWithParam<Access> {};

TEST_P(WithoutPcp, AParameterIsRefusedInWordsAndNothingElseChanges) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = robot.ask(GetParam().request);
  EXPECT_FALSE(answer.success);
  const std::string number = std::to_string(GetParam().request.parameter.number);
  EXPECT_THAT(answer.message.c_str(),
              AllOf(HasSubstr("no parameter channel reaches P" + number + " of drive left"),
                    HasSubstr("its gateway carries process data only, no PCP; read or set it at the inverter")));
  EXPECT_FALSE(answer.parameter.eeprom_written);
  EXPECT_EQ(0u, robot.snapshot().drives[0].eeprom_writes);
  // A write of P105 takes the scale away; what was typed in is all there is, and counts again.
  ASSERT_TRUE(robot.bringUp());
  cycle::Completion enabled;
  EXPECT_TRUE(robot.runUntil([&] { return (enabled = robot.ask(cycle::RequestKind::kEnable)).success; }))
      << enabled.message.c_str();
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  EXPECT_EQ(0x2000, robot.setpoint(0));
}

INSTANTIATE_TEST_SUITE_P(All, WithoutPcp,
                         ::testing::Values(Access{"Read", readRequest(0, kAccelerationTime)},
                                           Access{"WriteToRam", writeRequest(0, kAccelerationTime, 150)},
                                           Access{"WritePersistently", writeRequest(0, kAccelerationTime, 150,
                                                                                    ParameterAction::kWritePersistent)},
                                           Access{"WriteOfP105", writeRequest(0, kMaxFrequency, 1000,
                                                                              ParameterAction::kWritePersistent)}),
                         [](const auto& test) { return std::string{test.param.name}; });

// Its number is nobody's to read, and all else works as everywhere.
TEST(InterbusWithoutPcp, AFaultHasNoNumberAndIsAcknowledged) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUp());
  robot.unit(0).inverter().trip(kMotorHot, true);
  robot.run(seconds{3});
  EXPECT_TRUE(robot.snapshot().drives[0].fault);
  EXPECT_EQ(profile::kFaultNumberUnknown, robot.snapshot().drives[0].fault_number);
  EXPECT_EQ("fault of unknown number", catalogue::FaultWords::label(robot.snapshot().drives[0].fault_number));
  const cycle::Completion stands = robot.ask(cycle::RequestKind::kAcknowledge, 0);
  EXPECT_FALSE(stands.success);
  EXPECT_THAT(stands.message.c_str(), HasSubstr("drive left: the cause of the fault still stands"));
  robot.unit(0).inverter().clearCause();
  const cycle::Completion gone = robot.ask(cycle::RequestKind::kAcknowledge, 0);
  EXPECT_TRUE(gone.success);
  EXPECT_STREQ("no fault stands; the drives stay disabled until they are enabled", gone.message.c_str());
  EXPECT_EQ(0, robot.snapshot().drives[0].fault_number);
  EXPECT_EQ(profile::kFaultNumberUnknown, robot.snapshot().drives[0].last_fault_number);
}

// Control and status word carry it; what was typed in counts in every set.
TEST(InterbusWithoutPcp, AnotherParameterSetIsSelected) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = selectSet(robot, 3);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_STREQ("parameter set 3 is active", answer.message.c_str());
  EXPECT_EQ(2u, robot.unit(0).inverter().parameterSet()) << "counted from 0";
  EXPECT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
}

// Its words have no bits for sets (BU 0070 6.4).
TEST(InterbusWithoutPcp, DrivecomHasParameterSet1Only) {
  InterbusRobot::Options options;
  options.drivecom = true;
  InterbusRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  const Instant asked = robot.transport().now();
  const cycle::Completion answer = selectSet(robot, 2);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left: its drive profile has parameter set 1 only"));
  EXPECT_LE(robot.transport().now() - asked, std::chrono::milliseconds{20}) << "nothing was tried";
  const cycle::Completion first = selectSet(robot, 1);
  EXPECT_TRUE(first.success) << first.message.c_str();
  EXPECT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
}

// Nobody could say what a setpoint means.
TEST(InterbusWithoutPcp, WithoutMaxFrequencyItDoesNotStart) {
  InterbusRobot::Options options;
  options.max_frequency.reset();
  try {
    const InterbusRobot robot{options};
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("~drives/left/max_frequency"),
                                    HasSubstr("without bus/pcp the gateway carries no parameter channel")));
  }
}

}  // namespace
}  // namespace nord_driver::test
