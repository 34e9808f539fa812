// The log leads on: what happened, why, what to look at, and which calls come next.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "node/state_log.h"

namespace nord_driver::node {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Level = LogLine::Level;

std::vector<catalogue::FaultWords> words(std::size_t drives) {
  return std::vector<catalogue::FaultWords>(drives, {catalogue::shippedFaults(), profile::Series::kSk5xxe});
}

class StateLogTest : public ::testing::Test {
 protected:
  StateLogTest() {
    snapshot_.connected = true;
    for (auto& drive : snapshot_.drives) drive.online = true;
    during(milliseconds{100});  // all drives answer
  }
  /// The lines within `duration`, looked at every 10 ms.
  std::vector<LogLine> during(milliseconds duration) {
    std::vector<LogLine> said;
    for (const Instant end = now_ + duration; now_ < end; now_ += milliseconds{10}) {
      for (const LogLine& line : log_.poll(snapshot_, now_)) said.push_back(line);
    }
    return said;
  }
  void trip(std::size_t drive, std::uint16_t number) {
    ++snapshot_.drives[drive].faults;
    snapshot_.drives[drive].fault = snapshot_.drives[drive].fault_latched = true;
    snapshot_.drives[drive].fault_number = snapshot_.drives[drive].last_fault_number = number;
  }

  cycle::CycleSnapshot snapshot_{4};
  LoggedDrives drives_{"/nord_driver",           {"left", "right", "lift", "rear"},
                       {"", "", "lift", "lift"}, words(4),
                       "/dev/ttyUSB0",           "~bus/device"};
  StateLog log_{drives_};
  Instant now_ = Instant{} + std::chrono::hours{1};
};

TEST_F(StateLogTest, AFaultIsToldWithCauseRemedyAndTheNextTwoCalls) {
  trip(1, 65535);
  EXPECT_TRUE(during(milliseconds{200}).empty()) << "its number is being read";
  snapshot_.drives[1].fault_number = snapshot_.drives[1].last_fault_number = 21;
  const auto lines = during(milliseconds{5000});
  ASSERT_EQ(1u, lines.size());
  EXPECT_EQ(Level::kError, lines[0].level);
  EXPECT_EQ(
      "drive right: E2.1, motor overtemperature (I2t); likely cause: the motor is, or is calculated to be, too hot; "
      "remedy: let it cool down; check the load, the motor data and the sensor's wiring; then acknowledge it: "
      "rosservice "
      "call /nord_driver/acknowledge_faults and enable: rosservice call /nord_driver/enable true",
      lines[0].text);
}

TEST_F(StateLogTest, AFaultWhoseNumberIsNotToldIsToldWithoutIt) {
  trip(0, 65535);
  EXPECT_TRUE(during(milliseconds{1900}).empty());
  const auto lines = during(milliseconds{500});
  ASSERT_EQ(1u, lines.size());
  EXPECT_THAT(lines[0].text, HasSubstr("drive left: fault of unknown number"));
}

// The first idle word may let it vanish in the inverter before the log has looked (BU 0020 8).
// It has gone with the first idle word: the inverter's own history tells more.
TEST_F(StateLogTest, AFaultWithoutANumberIsToldWithTheNewestOfTheHistory) {
  trip(0, 65535);
  snapshot_.drives[0].fault = false;
  snapshot_.drives[0].fault_number = 0;
  snapshot_.drives[0].fault_history.asked = true;
  snapshot_.drives[0].fault_history.numbers.push_back(102);
  const auto lines = during(milliseconds{3000});
  ASSERT_EQ(1u, lines.size());
  EXPECT_THAT(
      lines[0].text,
      HasSubstr("drive left: fault of unknown number, fault; its number could not be read; the newest of its last "
                "faults, P701[-01], is E10.2, bus timeout of the option; likely cause: "));
}

TEST_F(StateLogTest, AFaultThatVanishedIsToldAllTheSame) {
  trip(0, 102);
  snapshot_.drives[0].fault = false;
  snapshot_.drives[0].fault_number = 0;
  const auto lines = during(milliseconds{100});
  ASSERT_EQ(1u, lines.size());
  EXPECT_THAT(lines[0].text, HasSubstr("drive left: E10.2, "));
}

TEST_F(StateLogTest, ADriveWithoutBaseHasItsOwnCalls) {
  trip(2, 21);
  const auto lines = during(milliseconds{100});
  ASSERT_EQ(1u, lines.size());
  EXPECT_THAT(lines[0].text, AllOf(HasSubstr("rosservice call /nord_driver/lift/acknowledge_fault "),
                                   HasSubstr("rosservice call /nord_driver/lift/enable true")));
}

// Its own ~<drive>/enable is refused: it is enabled with the drive that it follows.
TEST_F(StateLogTest, ADriveThatFollowsAnotherIsEnabledWithThatOne) {
  trip(3, 21);
  const auto lines = during(milliseconds{100});
  ASSERT_EQ(1u, lines.size());
  EXPECT_THAT(lines[0].text,
              AllOf(HasSubstr("drive rear: E2.1"), HasSubstr("rosservice call /nord_driver/rear/acknowledge_fault "),
                    HasSubstr("rosservice call /nord_driver/lift/enable true")));
}

// A node that looks on refuses both calls: whoever commands the drive has them.
TEST_F(StateLogTest, ANodeThatLooksOnNamesNoCall) {
  drives_.read_only = true;
  log_ = StateLog{drives_};
  during(milliseconds{100});
  trip(0, 21);
  trip(2, 21);
  const auto lines = during(milliseconds{100});
  ASSERT_EQ(2u, lines.size());
  for (const LogLine& line : lines) {
    EXPECT_THAT(line.text, HasSubstr("; remedy: let it cool down"));
    EXPECT_THAT(line.text, AllOf(Not(HasSubstr("acknowledge")), Not(HasSubstr("rosservice"))));
  }
}

// The node before was killed: its drives are met with a time-out that stands.
TEST(StateLogAtStart, AFaultThatStoodAlreadySaysSo) {
  cycle::CycleSnapshot snapshot{1};
  StateLog log{{"/nord_driver", {"left"}, {""}, words(1)}};
  Instant now = Instant{} + std::chrono::hours{1};
  EXPECT_TRUE(log.poll(snapshot, now).empty());
  snapshot.connected = snapshot.drives[0].online = true;
  snapshot.drives[0].faults = 1;
  snapshot.drives[0].fault = true;
  snapshot.drives[0].fault_number = snapshot.drives[0].last_fault_number = 102;
  const auto lines = log.poll(snapshot, now += milliseconds{10});
  ASSERT_EQ(2u, lines.size()) << "and that all drives answer";
  EXPECT_THAT(lines[1].text,
              AllOf(HasSubstr("drive left: E10.2, bus timeout of the option, which stood before this node started"),
                    HasSubstr("the watchdog of the bus ran out"),
                    HasSubstr("rosservice call /nord_driver/acknowledge_faults")));
}

TEST_F(StateLogTest, AQuickStopThatWasAskedForIsNoError) {
  snapshot_.base.stopped = true;
  snapshot_.base.stop_cause = drive::StopCause::kQuickStop;
  snapshot_.base.text = "drive left stopped: a quick stop was asked for";
  const auto lines = during(milliseconds{5000});
  ASSERT_EQ(1u, lines.size());
  EXPECT_EQ(Level::kInfo, lines[0].level);
  EXPECT_EQ("the base is stopped: drive left stopped: a quick stop was asked for; to go on: ~enable", lines[0].text);
}

TEST_F(StateLogTest, AStopNobodyAskedForIsAnErrorThatLeadsOn) {
  snapshot_.base.stopped = snapshot_.drives[0].fault_latched = true;
  snapshot_.base.stop_cause = drive::StopCause::kFault;
  snapshot_.base.text = "drive left stopped: a fault of the inverter";
  const auto lines = during(milliseconds{5000});
  ASSERT_EQ(1u, lines.size());
  EXPECT_EQ(Level::kError, lines[0].level);
  EXPECT_THAT(lines[0].text, HasSubstr("to go on: remove the cause (see \"drive left\"), then ~acknowledge_faults"));
}

// The inverter's own reason is read half a second later, may change, and goes when the input is released: the stop is the
// same one.
TEST_F(StateLogTest, AStopIsToldOnceWhateverTheInvertersOwnReasonIs) {
  const char* const kStop =
      "drive left stopped: OFF3 at the inverter's terminals (status word 0B50, switch-on disabled";
  for (int incident = 0; incident < 2; ++incident) {
    snapshot_.base.stopped = true;
    snapshot_.base.stop_cause = drive::StopCause::kOff3;
    std::vector<LogLine> lines;
    for (const char* reason :
         {"", "; the inverter's own reason, P700[-03], is 0.1", "; the inverter's own reason, P700[-03], is 0.2", ""}) {
      snapshot_.base.text.format("%s%s)", kStop, reason);
      for (const LogLine& line : during(milliseconds{100})) lines.push_back(line);
    }
    ASSERT_EQ(1u, lines.size()) << incident;
    EXPECT_THAT(lines[0].text, HasSubstr(kStop));
    snapshot_.base = {};
    EXPECT_TRUE(during(milliseconds{100}).empty()) << "enabled again";
  }
}

TEST_F(StateLogTest, AnotherStopOfTheSameDriveIsTold) {
  snapshot_.base.stopped = true;
  for (const char* stop : {"drive left stopped: OFF2 (status word 0B60, switch-on disabled)",
                           "drive left stopped: OFF3 (status word 0B50, switch-on disabled)"}) {
    snapshot_.base.text = stop;
    EXPECT_EQ(1u, during(milliseconds{100}).size()) << stop;
  }
}

TEST_F(StateLogTest, TheLossOfTheWholeBusIsAWarning) {
  snapshot_.connected = false;
  snapshot_.bus_text = "/dev/ttyUSB0 is open, but no station answers";
  for (auto& drive : snapshot_.drives) drive.online = false;
  const auto lines = during(milliseconds{1500});
  ASSERT_EQ(1u, lines.size());
  EXPECT_EQ(Level::kWarn, lines[0].level);
  EXPECT_EQ("/dev/ttyUSB0 is open, but no station answers; trying again (~bus/device)", lines[0].text);
}

}  // namespace
}  // namespace nord_driver::node
