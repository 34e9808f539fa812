// Every error number of the parameter channel and every error code of DP-V1 that the project's files describe, given by
// the far end and told to the user with code and meaning: in the telegrams, over MS1 and over MS2.
#include <gtest/gtest.h>

#include <memory>

#include "system/parameter_answers.h"
#include "system/simulated_robot.h"
#include "tools/parameter_link.h"
#include "transport/profibus/profibus_ms2.h"

namespace nord_driver::test {
namespace {

using catalogue::FaultCodes;
using catalogue::FaultEntry;

constexpr std::uint16_t kParameter = 103;

std::vector<const FaultEntry*> entriesOf(FaultCodes codes) {
  return catalogue::shippedFaults().all(codes);
}

enum class Channel { kPkw, kMs1 };

/// A drive whose parameters go by the PKW of the telegrams, or by records (SK CU4 with PPO 3).
SimulatedRobot::Options reachedBy(Channel channel) {
  SimulatedRobot::Options options;
  options.one_module = channel == Channel::kMs1;
  if (channel == Channel::kMs1) options.drives["ppo_type"] = 3;
  return options;
}

sim::ParameterSwitches refusingOrders(const FaultEntry& entry) {
  sim::ParameterSwitches switches;
  switches.refuse = sim::PkwRefusal{static_cast<Word>(entry.number), kParameter};
  return switches;
}

sim::ParameterSwitches refusingRecords(const FaultEntry& entry, bool at_answer) {
  sim::ParameterSwitches switches;
  switches.bus_refuse = sim::BusRefusal{entry.number, kParameter, at_answer};
  return switches;
}

std::string pkwCode(const FaultEntry& entry) {
  return "PKW error " + std::to_string(entry.number) + ", ";
}

std::string dpv1Code(const FaultEntry& entry) {
  return "DP-V1 error " + inHex(entry.number, 2) + ", ";
}

class CodesToldProfibus : public ::testing::TestWithParam<Channel> {};
INSTANTIATE_TEST_SUITE_P(By, CodesToldProfibus, ::testing::Values(Channel::kPkw, Channel::kMs1),
                         [](const auto& test) { return test.param == Channel::kPkw ? "Pkw" : "Ms1"; });

TEST_P(CodesToldProfibus, OfTheParameterChannel) {
  for (const FaultEntry* entry : entriesOf(FaultCodes::kPkw)) {
    SimulatedRobot robot{reachedBy(GetParam())};
    ASSERT_TRUE(robot.bringUp());
    robot.unit(0).setParameterSwitches(refusingOrders(*entry));
    EXPECT_TRUE(tells(answerTo(robot, {kParameter}), pkwCode(*entry), *entry));
  }
}

TEST(CodesToldMs1, OfRecords) {
  SimulatedRobot robot{reachedBy(Channel::kMs1)};
  ASSERT_TRUE(robot.bringUp());
  for (const FaultEntry* entry : entriesOf(FaultCodes::kDpv1)) {
    for (const bool at_answer : {false, true}) {
      SCOPED_TRACE(at_answer ? "in the answer to the read" : "in the answer to the write");
      robot.unit(0).setParameterSwitches(refusingRecords(*entry, at_answer));
      EXPECT_TRUE(tells(answerTo(robot, {kParameter}), dpv1Code(*entry), *entry));
      robot.unit(0).setParameterSwitches({});
      EXPECT_EQ("done: ", answerTo(robot, {kParameter})) << "the channel works again";
    }
  }
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

/// nord_param's way to an SK 2xxE that exchanges no data with anybody.
class Ms2Drive {
 public:
  explicit Ms2Drive(const sim::Class2Settings& settings = {})
      : config_(tools::readToolConfig(YAML::Load("{transport: profibus_ms2, cycle_rate: 100,"
                                                 " bus: {device: simulated, baud_rate: 500000, slot_time: 0.0005},"
                                                 " drives: {left: {address: 5, series: sk2xxe, pole_pairs: 2}}}"),
                                      "left")),
        transport_([this, settings](const link::SerialSettings&) {
          sim::SimConfig config;
          config.bus.as<sim::DpBusConfig>().baud_rate = 500'000;
          sim::DriveConfig drive;
          drive.name = "left";
          drive.address = 5;
          drive.device.series = sim::Series::kSk2xxe;
          drive.place = 1;
          config.drives.push_back(drive);
          auto made = std::make_unique<sim::SimulatedSegment>(config);
          segment_ = made.get();
          connections().settings() = settings;
          return made;
        }),
        link_(config_, transport_, catalogue::shippedCatalogues()) {}

  /// What kept it from being reached; empty: nothing.
  std::string connect() {
    try {
      link_.connect(std::chrono::seconds{5}, not_asked_);
    } catch (const tools::Trouble& error) {
      return error.what();
    }
    return "";
  }
  std::string read() {
    catalogue::ParameterAddress address;
    address.number = kParameter;
    const tools::ParameterAnswer answer = link_.read(address);
    return answer.success ? "done" : answer.message;
  }
  void set(const sim::ParameterSwitches& switches) { segment_->drive(0).setParameterSwitches(switches); }
  sim::Class2Server& connections() { return segment_->stations().module(0).connections(); }

 private:
  tools::ToolConfig config_;
  sim::SimulatedSegment* segment_ = nullptr;
  ProfibusMs2Transport transport_;
  tools::ParameterLink link_;
  std::atomic<bool> not_asked_{false};
};

TEST(CodesToldMs2, OfTheParameterChannelAndOfRecords) {
  Ms2Drive drive;
  ASSERT_EQ("", drive.connect());
  for (const FaultEntry* entry : entriesOf(FaultCodes::kPkw)) {
    drive.set(refusingOrders(*entry));
    EXPECT_TRUE(tells(drive.read(), pkwCode(*entry), *entry));
  }
  for (const FaultEntry* entry : entriesOf(FaultCodes::kDpv1)) {
    for (const bool at_answer : {false, true}) {
      SCOPED_TRACE(at_answer ? "in the answer to the read" : "in the answer to the write");
      drive.set(refusingRecords(*entry, at_answer));
      EXPECT_TRUE(tells(drive.read(), dpv1Code(*entry), *entry));
      drive.set({});
      EXPECT_EQ("done", drive.read()) << "the channel works again";
    }
  }
}

std::string abortCode(const FaultEntry& entry) {
  return "abort 1" + inHex(entry.number, 1) + "h, ";
}

TEST(CodesToldMs2, OfAnAbortInsteadOfAConnection) {
  for (const FaultEntry* entry : entriesOf(FaultCodes::kDpv1Abort)) {
    sim::Class2Settings settings;
    settings.abort_initiate = static_cast<std::uint8_t>(entry->number);
    Ms2Drive drive{settings};
    EXPECT_TRUE(tells(drive.connect(), abortCode(*entry), *entry));
  }
}

TEST(CodesToldMs2, OfAnAbortInsteadOfAnAnswer) {
  Ms2Drive drive;
  ASSERT_EQ("", drive.connect());
  for (const FaultEntry* entry : entriesOf(FaultCodes::kDpv1Abort)) {
    drive.connections().settings().abort_record = static_cast<std::uint8_t>(entry->number);
    EXPECT_TRUE(tells(drive.read(), abortCode(*entry), *entry));
    drive.connections().settings().abort_record.reset();
    EXPECT_EQ("done", drive.read()) << "another connection is opened";
  }
}

}  // namespace
}  // namespace nord_driver::test
