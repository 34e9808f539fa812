// A driver that starts over drives which one that died has left turning: they are stopped before their nodes are reset,
// which would take away the life time that may be about to stop them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/can_text.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;

/// The first driver died while it drove at half speed; nobody steps it any more.
class FoundTurning : public ::testing::Test {
 protected:
  /// A life time that is over long after the next driver has come, unless `drives` say otherwise.
  void drive(CanRobot::Options options = {}) {
    options.drives.insert({{"guard_time", 1.0}, {"life_time_factor", 10}});
    options_ = options;
    died_ = std::make_unique<CanRobot>(options);
    ASSERT_TRUE(died_->bringUpAndEnable());
    died_->drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_NEAR(25.0, frequency(kLeft), 0.1);
  }
  void startNext(const std::map<std::string, MapSettings::Value>& drives = {}) {
    CanRobot::Options options = options_;
    for (const auto& [key, value] : drives) options.drives[key] = value;
    options.beside = &died_->bus();
    next_ = std::make_unique<CanRobot>(options);
    next_->beside().setSees([this](const CanFrame& frame) { watch(frame); });
    step();  // it opens
  }
  void step() { next_->step(); }
  // A reset, or a way out of operation, takes a node the ear for what stops its drive.
  void watch(const CanFrame& frame) {
    sent_.push_back(text(frame));
    if (frame.id != 0 || frame.data[0] == 0x01) return;
    for (std::size_t i = 0; i < count(); ++i) {
      if (died_->node(i).id() == frame.data[1] && frequency(i) != 0.0) deafened_ = true;
    }
  }
  bool stands() {
    for (std::size_t i = 0; i < count(); ++i) {
      if (std::abs(died_->unit(i).shaftSpeed()) >= 0.1) return false;
    }
    return true;
  }
  bool hasSent(const std::string& begin) const {
    return std::any_of(sent_.begin(), sent_.end(),
                       [&begin](const std::string& frame) { return frame.compare(0, begin.size(), begin) == 0; });
  }
  std::size_t count() const { return options_.gateway_inverters == 0 ? options_.nodes : options_.gateway_inverters; }
  double frequency(std::size_t drive) { return died_->unit(drive).inverter().frequency(); }
  int fault(std::size_t drive) { return died_->unit(drive).inverter().faultNumber(); }
  bool online() { return next_->online(kLeft) && next_->online(kRight); }
  /// It stops them on the ramp, and has them.
  void expectTakenOver() {
    ASSERT_TRUE(next_->runUntil([this] { return online(); }, seconds{8})) << next_->text(kLeft);
    EXPECT_FALSE(deafened_);
    EXPECT_TRUE(stands());
    for (std::size_t i = 0; i < count(); ++i) EXPECT_EQ(0, fault(i)) << "on the ramp";
    EXPECT_FALSE(next_->snapshot().base.enabled);
    next_->run(seconds{1});
    EXPECT_STREQ("enabled", next_->ask(cycle::RequestKind::kEnable).message.c_str());
    next_->drive(kHalfSpeed, 0.0, seconds{3});
    EXPECT_NEAR(25.0, frequency(kLeft), 0.1);
  }

  CanRobot::Options options_;
  std::unique_ptr<CanRobot> died_;
  std::unique_ptr<CanRobot> next_;
  std::vector<std::string> sent_;
  bool deafened_ = false;
};

TEST_F(FoundTurning, AreStoppedBeforeTheirNodesAreReset) {
  for (const char* const reset : {"communication", "node", "none"}) {
    SCOPED_TRACE(reset);
    next_.reset();
    drive();
    startNext({{"boot_reset", std::string{reset}}});
    next_->run(milliseconds{700});
    EXPECT_LT(frequency(kLeft), 24.0) << "after half a second of listening";
    EXPECT_GT(frequency(kRight), -24.0);
    EXPECT_TRUE(hasSent("203#7E040000") && hasSent("204#7E040000"));
    EXPECT_THAT(next_->text(kLeft), HasSubstr("stopped before it is set up"));
    EXPECT_TRUE(next_->transport().connected());
    EXPECT_EQ("", next_->busText()) << "they are heard: no matter of wires";
    expectTakenOver();
  }
}

TEST_F(FoundTurning, WithSyncTheyAreAsked) {
  CanRobot::Options options;
  options.bus = {{"sync", true}};
  drive(options);
  startNext();
  next_->run(milliseconds{700});
  EXPECT_THAT(next_->text(kLeft), HasSubstr("its drives are stopped before it is set up")) << "they have answered";
  expectTakenOver();
  EXPECT_TRUE(hasSent("203#7E040000"));
}

// Listening ends in the middle of a cycle, and what was heard in it counts.
TEST_F(FoundTurning, AlsoInACycleLongerThanTheListening) {
  for (const double rate : {1.0, 1.5}) {
    SCOPED_TRACE(rate);
    next_.reset();
    sent_.clear();
    deafened_ = false;
    drive();
    options_.node["cycle_rate"] = rate;
    startNext();
    next_->run(seconds{2});
    EXPECT_TRUE(hasSent("203#7E040000") && hasSent("204#7E040000"));
    EXPECT_LT(frequency(kLeft), 24.0);
    EXPECT_GT(frequency(kRight), -24.0);
    ASSERT_TRUE(next_->runUntil([this] { return online(); }, seconds{30})) << next_->text(kLeft);
    EXPECT_FALSE(deafened_);
    EXPECT_TRUE(stands());
    for (std::size_t i = 0; i < count(); ++i) EXPECT_EQ(0, fault(i)) << "on the ramp";
  }
}

// Each cycle begins a little late: what SYNC has brought in the one before still counts.
TEST_F(FoundTurning, WithSyncAlsoInLongCycles) {
  CanRobot::Options options;
  options.bus = {{"sync", true}};
  drive(options);
  options_.node["cycle_rate"] = 1.0;
  startNext();
  for (int cycles = 0; cycles < 20 && !online(); ++cycles) {
    died_->bus().run(milliseconds{10});
    step();
  }
  EXPECT_TRUE(hasSent("203#7E040000") && hasSent("204#7E040000"));
  ASSERT_TRUE(online()) << next_->text(kLeft);
  EXPECT_FALSE(deafened_);
  EXPECT_TRUE(stands());
}

TEST_F(FoundTurning, InCia402) {
  CanRobot::Options options;
  options.drives = {{"profile", std::string{"cia402"}}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::CanDriveConfig>().cia402 = true;
  };
  drive(options);
  startNext();
  expectTakenOver();
  EXPECT_TRUE(hasSent("203#7E000000"));
}

// 047E alone also says "set 1", with its ramps.
TEST_F(FoundTurning, InTheParameterSetTheyAreIn) {
  drive();
  const auto say = [this](Word word, Word setpoint) {
    for (const DriveIndex drive : {kLeft, kRight}) died_->unit(drive).inverter().receive({word, {setpoint}});
  };
  say(0x847E, 0);
  died_->bus().run(seconds{3});
  say(0x847F, 0x2000);
  died_->bus().run(seconds{4});
  ASSERT_NEAR(25.0, frequency(kLeft), 0.1);
  startNext();
  ASSERT_TRUE(next_->runUntil([this] { return online(); }, seconds{8}));
  EXPECT_FALSE(deafened_);
  EXPECT_TRUE(hasSent("203#7E840000"));
  EXPECT_FALSE(hasSent("203#7E040000"));
}

// The module of another maker, or a wrong entry: it is not set up, but its drive does not turn on.
TEST_F(FoundTurning, ThoseOfARefusedNodeToo) {
  for (const char* const reset : {"communication", "none"}) {
    next_.reset();
    drive();
    startNext({{"vendor_id", 0x99}, {"boot_reset", std::string{reset}}});
    next_->run(seconds{6});
    EXPECT_FALSE(deafened_);
    EXPECT_TRUE(stands());
    EXPECT_FALSE(online());
    EXPECT_THAT(next_->text(kLeft), HasSubstr("vendor id"));
  }
}

// Ctrl-C right after it has begun: what stops them has gone out, and nothing else.
TEST_F(FoundTurning, AlsoWhenTheStartIsInterrupted) {
  drive();
  startNext();
  ASSERT_TRUE(next_->runUntil([this] { return !sent_.empty(); }, seconds{1}));
  next_->transport().close();
  EXPECT_FALSE(hasSent("000#"));
  died_->bus().run(seconds{5});
  EXPECT_TRUE(stands());
}

// While it listens another master may have them: nothing was touched, and the life time of the one that died goes on.
TEST_F(FoundTurning, InterruptedWhileItListensItHasTakenNothingAway) {
  drive();
  startNext();
  next_->run(milliseconds{200});
  next_->transport().close();
  EXPECT_TRUE(sent_.empty());
  died_->bus().run(seconds{60});  // it coasts
  EXPECT_EQ(100, fault(kLeft));
  EXPECT_TRUE(stands());
}

// The word that stops takes the enable away, and would acknowledge it before anybody has seen it.
TEST_F(FoundTurning, AFaultIsNotAcknowledged) {
  drive();
  died_->unit(kRight).inverter().trip(21, false);
  startNext();
  ASSERT_TRUE(next_->runUntil([this] { return hasSent("203#7E04"); }, seconds{1}));
  EXPECT_FALSE(hasSent("204#"));
  EXPECT_EQ(21, fault(kRight));
  ASSERT_TRUE(next_->runUntil([this] { return online(); }, seconds{8}));
  EXPECT_TRUE(next_->snapshot().drives[kRight].fault_latched);
  EXPECT_FALSE(next_->snapshot().drives[kLeft].fault_latched);
  EXPECT_FALSE(deafened_);
}

TEST_F(FoundTurning, BehindAGatewayEachOfThem) {
  CanRobot::Options options;
  options.gateway_inverters = 4;
  options.drives = {{"series", std::string{"sk2xxe"}}};
  const auto joints = [](const char* front, const char* rear) { return std::vector<std::string>{front, rear}; };
  options.node = {{"left_wheel", joints("left_wheel_joint", "extra2_wheel_joint")},
                  {"right_wheel", joints("right_wheel_joint", "extra3_wheel_joint")}};
  options.each = {{}, {}, {}, {{"inverted", true}}};
  options.simulate = [](sim::SimConfig& config) {
    for (sim::DriveConfig& drive : config.drives) drive.device.series = sim::Series::kSk2xxe;
    config.drives[3].inverted = true;
    config.body = sim::BodyConfig{{0, 2}, {1, 3}, 0.1, 0.5};
  };
  drive(options);
  died_->unit(2).inverter().trip(21, false);
  startNext();
  ASSERT_TRUE(next_->runUntil([this] { return !sent_.empty(); }, seconds{1}));
  ASSERT_TRUE(next_->runUntil([this] { return online(); }, seconds{8})) << next_->text(kLeft);
  EXPECT_FALSE(deafened_);
  const auto reset = std::find(sent_.begin(), sent_.end(), "000#820A");
  ASSERT_NE(sent_.end(), reset);
  sent_.erase(reset, sent_.end());
  for (const char* const stopped : {"20A#7E04", "30A#7E04", "50A#7E04"}) EXPECT_TRUE(hasSent(stopped)) << stopped;
  EXPECT_FALSE(hasSent("40A#")) << "a fault stands";
}

// Mains off: its last words said "enabled".
TEST_F(FoundTurning, OneThatIsGoneIsNotWaitedFor) {
  drive();
  startNext();
  next_->run(milliseconds{300});
  died_->node(kLeft).setPowered(false);
  next_->run(seconds{3});
  EXPECT_TRUE(hasSent("000#8203"));
}

}  // namespace
}  // namespace nord_driver::test
