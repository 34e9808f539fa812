// The PROFIBUS transport on a simulated segment: words there and back, and what it says when something is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "transport/profibus/on_a_segment.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(OnASegment, CarriesEachDriveItsOwnWords) {
  bringUp();
  EXPECT_EQ(0x0B31, inputs_[0].input.status_word);
  EXPECT_TRUE(transport_->connected());
  EXPECT_TRUE(transport_->busText().empty());
  EXPECT_STREQ("", transport_->note(0).text);
  EXPECT_EQ(0x7531u, transport_->identNumber(0));
  for (auto& output : outputs_) output.control_word = 0x047F;
  outputs_[0].setpoints[0] = 0x2000;
  outputs_[1].setpoints[0] = -0x1000;
  run(seconds{4});
  EXPECT_EQ(0x0B37, inputs_[0].input.status_word);
  EXPECT_EQ(0x2000, inputs_[0].input.actual_values[0]);
  EXPECT_EQ(-0x1000, inputs_[1].input.actual_values[0]);
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

TEST_F(OnASegment, CountsWhatHappensOnTheLine) {
  bringUp();
  const BusCounters before = transport_->counters();
  EXPECT_EQ(0u, before.value(bus_counter::kRetries));
  segment_->loseAnswers(1);
  step();
  segment_->spoilAnswers(1);
  step();
  const BusCounters after = transport_->counters();
  EXPECT_EQ(2u, after.value(bus_counter::kCycles) - before.value(bus_counter::kCycles));
  EXPECT_EQ(2u, after.value(bus_counter::kRetries) - before.value(bus_counter::kRetries));
  EXPECT_GE(after.value(bus_counter::kTimeouts) - before.value(bus_counter::kTimeouts), 1u);
  EXPECT_EQ(6u, after.value(bus_counter::kTelegramsSent) - before.value(bus_counter::kTelegramsSent))
      << "two a cycle, and a repetition in each";
  EXPECT_TRUE(bothAnswer()) << "a repetition is enough";
}

TEST_F(OnASegment, SaysWhichDriveIsMissingAndWhatToLookAt) {
  open();
  segment_->drive(1).setPlugged(false);
  run(seconds{1});
  EXPECT_TRUE(transport_->connected()) << "one station is enough";
  EXPECT_TRUE(inputs_[0].inverter_answers);
  EXPECT_FALSE(inputs_[1].module_answers);
  EXPECT_THAT(transport_->note(1).text, HasSubstr("check its power, its address"));
  segment_->drive(0).setPlugged(false);
  run(seconds{1});
  EXPECT_FALSE(transport_->connected());
  EXPECT_STREQ(
      "/dev/ttyUSB0 is open, but no station answers (asked: 3, 4): power, address, baud rate, wires A and B the right "
      "way round, termination? nord_param scan finds who is there",
      transport_->busText().c_str());
}

// A station that answers and refuses has been told by its reason: "no station answers" would send the technician to the
// wires.
class TrueReasons : public OnASegment {
 protected:
  std::set<std::string> told(Duration span) {
    std::set<std::string> sentences;
    const Instant end = transport_->now() + span;
    while (transport_->now() < end) {
      step();
      EXPECT_FALSE(transport_->connected());
      sentences.insert(transport_->busText().str());
    }
    return sentences;
  }
  void expectReason(const char* reason) {
    run(milliseconds{500});
    for (const std::string& sentence : told(seconds{5})) {
      EXPECT_THAT(sentence, HasSubstr("PROFIBUS station 3 (left)"));
      EXPECT_THAT(sentence, HasSubstr(reason));
    }
  }
};

TEST_F(TrueReasons, AnotherModuleThanConfigured) {
  change_ = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::DpDriveConfig>().ident = 0x1234;
  };
  open();
  expectReason("it reports the ident number 1234h, expected 7531h");
}

TEST_F(TrueReasons, AnotherPpoTypeThanConfigured) {
  change_ = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::DpDriveConfig>().ppo_type = 2;
  };
  open();
  expectReason("Cfg_Fault");
}

TEST_F(TrueReasons, LockedByAnotherMaster) {
  open();
  for (const std::size_t i : {0u, 1u}) {
    sim::Telegram lock;  // Set_Prm of master 9, without a watchdog
    lock.destination = segment_->station(i).address();
    lock.source = 9;
    lock.function = 0x6D;
    lock.destination_sap = 61;
    lock.source_sap = 62;
    for (const int byte : {0x80, 0x00, 0x00, 0x0B, 0x75, 0x31, 0x00}) {
      lock.data.push_back(static_cast<std::uint8_t>(byte));
    }
    segment_->station(i).handle(lock);
  }
  expectReason("is locked by another master: its address is 9");
}

/// Its stations do not know Slave_Diag (SAP 60) and refuse it: what asks for it arrives at a SAP that they do not have.
class SegmentWithoutDiagnosis final : public sim::SimulatedSegment {
 public:
  using SimulatedSegment::SimulatedSegment;
  bool write(ByteView telegram) noexcept override {
    constexpr std::size_t kLength = 11, kDestinationSap = 7, kCheckSum = 9;
    constexpr std::uint8_t kSlaveDiag = 60, kUnknown = 20;
    if (telegram.size() != kLength || telegram[kDestinationSap] != kSlaveDiag) return SimulatedSegment::write(telegram);
    FixedBytes<kLength> changed;
    for (const std::uint8_t byte : telegram) changed.push_back(byte);
    changed[kDestinationSap] = kUnknown;
    changed[kCheckSum] = static_cast<std::uint8_t>(changed[kCheckSum] - kSlaveDiag + kUnknown);
    return SimulatedSegment::write(changed);
  }
};

// Without a diagnosis nobody has said whose they are.
TEST_F(TrueReasons, NoOwnerIsNamedThatNobodyTold) {
  make_segment_ = [](const sim::SimConfig& config) { return std::make_unique<SegmentWithoutDiagnosis>(config); };
  open();
  run(milliseconds{500});
  for (const std::string& sentence : told(seconds{5})) {
    EXPECT_THAT(sentence, HasSubstr("PROFIBUS station 3 (left) refuses a service of its start-up"));
    EXPECT_THAT(sentence, Not(HasSubstr("its address is")));
  }
}

// And when they are silent, they are silent: the reason of before is no longer one.
TEST_F(TrueReasons, EndWithTheStation) {
  change_ = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::DpDriveConfig>().ident = 0x1234;
  };
  open();
  run(seconds{2});
  for (const std::size_t i : {0u, 1u}) segment_->drive(i).setPlugged(false);
  run(seconds{3});
  EXPECT_THAT(transport_->busText().c_str(), HasSubstr("is open, but no station answers"));
}

// A cycle that is lost says nothing of the bus.
TEST_F(OnASegment, IsConnectedThroughALostCycle) {
  bringUp();
  for (const std::size_t i : {0u, 1u}) segment_->station(i).setMute(true);
  step();
  EXPECT_FALSE(inputs_[0].module_answers);
  EXPECT_TRUE(transport_->connected());
  EXPECT_TRUE(transport_->busText().empty()) << transport_->busText().c_str();
  run(milliseconds{300});
  EXPECT_FALSE(transport_->connected());
}

// A module with 24 V of its own exchanges data for an inverter that is off (BU 0020 2.1.3): all zero.
TEST_F(OnASegment, AnInverterThatIsOffDoesNotAnswerThoughItsModuleDoes) {
  bringUp();
  segment_->drive(0).setInverterPower(false);
  run(milliseconds{100});
  EXPECT_TRUE(inputs_[0].module_answers);
  EXPECT_FALSE(inputs_[0].inverter_answers);
  EXPECT_TRUE(inputs_[1].inverter_answers);
  EXPECT_THAT(transport_->note(0).text, HasSubstr("is its mains supply on?"));
}

// Whoever waits for a parameter of an inverter that was switched off is told at once, not after a time-out; and an old
// answer does not come after it is back.
TEST_F(OnASegment, AParameterOfAnInverterThatIsSwitchedOffEndsAsOffline) {
  bringUp();
  segment_->drive(0).setInverterPower(false);
  const Instant asked = transport_->now();
  const auto result = ask(0, 105);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(profile::ParameterOutcome::kOffline, result->outcome);
  EXPECT_LT(transport_->now() - asked, milliseconds{100});
}

TEST_F(OnASegment, ReadsAParameterBesideTheProcessData) {
  bringUp();
  const auto result = ask(1, 105);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(profile::ParameterOutcome::kDone, result->outcome);
  EXPECT_EQ(77u, result->id);
  EXPECT_EQ(500, result->raw) << "50.0 Hz";
  EXPECT_EQ(0x0B31, inputs_[1].input.status_word);
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

TEST_F(OnASegment, PassesARefusalOn) {
  bringUp();
  const auto result = ask(0, 999);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(profile::ParameterOutcome::kRefused, result->outcome);
  EXPECT_EQ(profile::ParameterReason::kNoSuchParameter, result->reason) << "error 0 (BU 0020 7.5.1)";
}

// PPO 3 carries process data only (BU 0020 5.2.2): said at once, in a bounded number.
TEST_F(OnASegment, Ppo3HasNoParameterChannel) {
  bringUp(3);
  EXPECT_EQ("none", transport_->identity(0).parameter_channel);
  const auto result = ask(0, 105);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(profile::ParameterOutcome::kNoChannel, result->outcome);
  int taken = 0;
  while (transport_->submit(0, {}) && taken < 1000) ++taken;
  EXPECT_EQ(16, taken);
  while (transport_->pollResult()) --taken;
  EXPECT_EQ(0, taken);
}

// An answer that came late, or twice, lies in the buffer of the adapter when the next cycle begins. It answers none of
// its requests: a wheel would be a cycle behind for as long as that goes on.
TEST_F(OnASegment, WhatCameBetweenCyclesAnswersNothing) {
  bringUp();
  const BusCounters before = transport_->counters();
  for (int i = 0; i < 3; ++i) {
    segment_->foreign(fromHex("68 0F 0F 68 01 03 08 00 00 00 00 00 00 00 00 0B 37 20 00 6E 16"));
    transport_->sleepUntil(transport_->now() + milliseconds{5});
    step();
    EXPECT_EQ(0x0B31, inputs_[0].input.status_word);
    EXPECT_EQ(0x0B31, inputs_[1].input.status_word);
  }
  const BusCounters after = transport_->counters();
  EXPECT_EQ(3u, after.value(bus_counter::kUnexpected) - before.value(bus_counter::kUnexpected));
  EXPECT_EQ(before.value(bus_counter::kRetries), after.value(bus_counter::kRetries));
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

// --- The device ------------------------------------------------------------------------------------------------------

// The far end of the adapter is pulled: silent drives, a reason in words, and looked for at least every 2 s.
TEST_F(OnASegment, ADeviceThatIsPulledIsLookedForUntilItIsBack) {
  bringUp();
  segment_->setDevicePresent(false);
  run(seconds{3});
  EXPECT_FALSE(transport_->connected());
  EXPECT_FALSE(inputs_[0].module_answers);
  EXPECT_FALSE(inputs_[0].inverter_answers);
  EXPECT_STREQ("the bus device is not open", transport_->note(0).text);
  EXPECT_THAT(transport_->busText().c_str(), HasSubstr("no such device"));
  segment_->setDevicePresent(true);
  EXPECT_TRUE(runUntil([this] { return bothAnswer(); }, seconds{2}));
  EXPECT_TRUE(transport_->busText().empty());
  EXPECT_EQ("no rule broken", segment_->referee().report());
}

TEST_F(OnASegment, ADeviceThatIsMissingAtStartIsWaitedFor) {
  open(1, false);
  run(seconds{1});
  EXPECT_THAT(transport_->busText().c_str(), HasSubstr("no such device"));
  segment_->setDevicePresent(true);
  EXPECT_TRUE(runUntil([this] { return bothAnswer(); }, seconds{2}));
}

// Whoever waits for a parameter when the device goes is not left waiting.
TEST_F(OnASegment, AParameterIsOfflineWhenTheDeviceGoes) {
  bringUp();
  segment_->setDevicePresent(false);
  const auto result = ask(0, 105);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(profile::ParameterOutcome::kOffline, result->outcome);
}

// A drive that took another station's place on the bus, or nothing at all: never a stale status word.
TEST_F(OnASegment, WhatADriveSaidLastIsNotSaidAgainWhenItIsSilent) {
  bringUp();
  segment_->station(0).setMute(true);
  step();
  EXPECT_FALSE(inputs_[0].module_answers);
  EXPECT_EQ(0x0000, inputs_[0].input.status_word);
}

TEST_F(OnASegment, TellsWhereADriveIsAndWhatProtectsIt) {
  open();
  EXPECT_EQ("PROFIBUS station 4", transport_->identity(1).address);
  EXPECT_EQ("PKW", transport_->identity(1).parameter_channel);
  EXPECT_THAT(transport_->identity(1).protected_by, HasSubstr("watchdog of 0.2 s"));
}

// Set_Prm brings no watchdog then: nothing of this bus stops the drive. It is listened until one that a driver left behind
// has run out (0.25 s are its tolerance), and for half a second at least, or longer where the configuration says so.
TEST_F(OnASegment, WhoServesParametersOnlyProtectsNothing) {
  parameters_only_ = true;
  open();
  EXPECT_EQ("", transport_->identity(0).protected_by);
  EXPECT_DOUBLE_EQ(0.5, transport_->identity(0).protection_time);
  listen_first_ = 8.0;
  open();
  EXPECT_DOUBLE_EQ(8.0, transport_->identity(0).protection_time);
}

// After close() nothing is on the line any more.
TEST_F(OnASegment, CloseEndsTheExchange) {
  bringUp();
  transport_->close();
  EXPECT_FALSE(segment_->isOpen());
  EXPECT_FALSE(transport_->connected());
}

}  // namespace
}  // namespace nord_driver
