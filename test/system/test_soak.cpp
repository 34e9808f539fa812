// Hours and days of driving in simulated time: nothing grows, nothing drifts, and what is counted is what happened.
// NORD_SOAK_HOURS says how many hours of each bus; without it a third of one. scripts/soak.sh lets a week of them pass.
//
// A program of its own: it replaces malloc. What it measured stands in lines that begin with "soak:".
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "support/count_allocations.h"
#include "support/work_counters.h"
#include "system/every_robot.h"
#include "trace/trace_feed.h"

namespace nord_driver::test {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr double kRate = 25.0;                    // Hz
constexpr double kSpin = 2.0 * kHalfSpeed / 0.5;  // rad/s: each wheel as fast as straight on, half of P105 to the bit
constexpr double kHalfWheel = kHalfSpeed / 0.1;   // rad/s
// rad. No bus tells when the inverter has measured a value: it is up to a cycle old. A wheel of this speed may so be told
// this far from where it is, and a ramp leaves as much behind, to one side or the other.
constexpr double kRampError = kHalfWheel / kRate;
constexpr double kNoSlip = 1e-6;  // Hz at rated torque: the told speed is the true one
constexpr auto kDrive = minutes{4}, kPause = minutes{1};
constexpr auto kRamp = seconds{10};
constexpr int kRoundsAnHour = 3;
constexpr int kRamps = 8;    // of a round
constexpr int kReturns = 3;  // of a lost drive, in a round
// B. A block is 16 longer than asked for where malloc could not use the rest; two blocks that stay would be 48.
constexpr long kBlockSpare = 32;

int wantedRounds() {
  const char* const given = std::getenv("NORD_SOAK_HOURS");
  if (given == nullptr) return 1;
  const int count = std::atoi(given);
  if (count < 1 || count > 10'000) throw std::runtime_error("NORD_SOAK_HOURS is not valid, expected 1 to 10000");
  return count * kRoundsAnHour;
}

/// kB of memory this process has in use.
long residentMemory() {
  std::ifstream file("/proc/self/statm");
  long all = 0, resident = 0;
  file >> all >> resident;
  return resident * (::sysconf(_SC_PAGESIZE) / 1024);
}

using Counters = std::map<std::string, std::uint64_t>;

template <typename Robot>
class Soak : public ::testing::Test {
 protected:
  static typename Robot::Options options() {
    typename Robot::Options options;
    options.node = {{"cycle_rate", kRate}};
    if constexpr (std::is_same_v<Robot, SimulatedRobot> || std::is_same_v<Robot, InterbusRobot>) {
      options.slip = kNoSlip;
    } else {
      options.simulate = [](sim::SimConfig& config) {
        for (sim::DriveConfig& drive : config.drives) drive.motor.slip = kNoSlip;
      };
    }
    return options;
  }
  void SetUp() override { robot_.ports().setObserver(&feed_); }

  void step() {
    robot_.step();
    ++cycles_;
    while (feed_.pollTrigger()) {
    }
    while (robot_.ports().pollBusEvent()) ++events_;
  }
  void drive(double linear, double angular, Duration span) {
    for (const Instant end = robot_.transport().now() + span; robot_.transport().now() < end;) {
      robot_.command(linear, angular);
      step();
    }
  }
  /// Undisturbed, there and back, both ways round: eight ramps.
  void aRoundOfDriving() {
    for (const double way : {1.0, -1.0}) {
      driveSteadily(way * kHalfSpeed, 0.0);
      drive(0.0, 0.0, kPause);
      driveSteadily(0.0, way * kSpin);
      drive(0.0, 0.0, kPause);
    }
  }
  /// Once the ramp is over the speed told is the true one to the bit, so that nothing adds up: the told and the true angle
  /// differ by the age of what was told, and that by no more than a cycle, however long it lasts.
  void driveSteadily(double linear, double angular) {
    drive(linear, angular, kRamp);
    const double before[2] = {angleError(0), angleError(1)};
    drive(linear, angular, kDrive - kRamp);
    for (const DriveIndex wheel : {0u, 1u}) {
      steady_drift_ = std::max(steady_drift_, std::abs(angleError(wheel) - before[wheel]));
    }
  }
  /// One loss, no more; and in service again when asked.
  void aDriveGoesAndComesBack() {
    const auto timeouts = counters().at("timeouts");
    robot_.unit(1).setPlugged(false);
    drive(0.0, 0.0, seconds{5});
    EXPECT_FALSE(robot_.snapshot().base.enabled);
    EXPECT_FALSE(robot_.snapshot().drives[1].online);
    robot_.unit(1).setPlugged(true);
    drive(0.0, 0.0, seconds{10});
    EXPECT_TRUE(robot_.snapshot().drives[1].online);
    ASSERT_LT(counters().at("timeouts"), timeouts + 1000u);
    robot_.ask(cycle::RequestKind::kAcknowledge);
    const cycle::Completion enabled = robot_.ask(cycle::RequestKind::kEnable);
    ASSERT_TRUE(enabled.success) << enabled.message.c_str();
    robot_.forgetCompletions();
    drive(0.0, 0.0, seconds{2});
  }
  Counters counters() {
    Counters all;
    for (const NamedCounter& counter : robot_.transport().counters()) all[counter.name] = counter.value;
    return all;
  }
  double angleError(DriveIndex wheel) {
    const double told = robot_.snapshot().drives[wheel].joint_position - told_before_[wheel];
    return told - (robot_.unit(wheel).wheelAngle() - true_before_[wheel]);
  }
  void rememberAngles() {
    for (const DriveIndex wheel : {0u, 1u}) {
      told_before_[wheel] = robot_.snapshot().drives[wheel].joint_position;
      true_before_[wheel] = robot_.unit(wheel).wheelAngle();
    }
  }

  trace::TraceFeed feed_{2};
  Robot robot_{options()};
  std::uint64_t cycles_ = 0, events_ = 0;
  double told_before_[2] = {}, true_before_[2] = {}, steady_drift_ = 0.0;
};
TYPED_TEST_SUITE(Soak, EveryBusRobot, BusName);

template <typename Robot>
std::string rulesBroken(Robot& robot) {
  if constexpr (std::is_same_v<Robot, InterbusRobot>) {
    return robot.referee();
  } else {
    return busOf(robot).referee().report();
  }
}

// Each round: 16 minutes of driving, in which nothing may be allocated, counted as an error or lost; then a drive goes
// and comes back, three times, and everything is enabled again.
TYPED_TEST(Soak, NothingGrowsAndNothingDrifts) {
  auto& robot = this->robot_;
  const int wanted = wantedRounds();
  ASSERT_TRUE(robot.bringUpAndEnable());
  this->drive(0.0, 0.0, seconds{1});
  const Instant begin = robot.transport().now();
  const auto trips_at_begin = robot.unit(0).counters().watchdog_trips;
  this->cycles_ = 0;
  unsigned long allocated = 0;
  double worst_angle = 0.0, worst_yaw = 0.0, driven = 0.0;
  long memory = 0, held = 0, held_last = 0;
  this->rememberAngles();
  for (int round = 0; round < wanted; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Counters before = this->counters();
    const std::uint64_t cycles = this->cycles_;
    const Instant start = robot.transport().now();
    allocated += countAllocations([&] { this->aRoundOfDriving(); });
    ASSERT_TRUE(robot.snapshot().base.enabled) << robot.snapshot().base.text.c_str();
    // Time: as many cycles as fit, none twice, none left out.
    const double passed = toSeconds(robot.transport().now() - start);
    ASSERT_NEAR(passed * kRate, static_cast<double>(this->cycles_ - cycles), 1.0);
    for (const auto& [name, value] : this->counters()) {
      if (!countsWork(name)) {
        ASSERT_EQ(before.at(name), value) << name << " has grown on an undisturbed bus";
      }
    }
    ASSERT_EQ(before.at("cycles") + this->cycles_ - cycles, this->counters().at("cycles"));
    // There and back: the angles are those of the wheels, and the pose is that of the angles.
    for (const DriveIndex wheel : {0u, 1u}) worst_angle = std::max(worst_angle, std::abs(this->angleError(wheel)));
    const auto& drives = robot.snapshot().drives;
    const double yaw = (drives[1].joint_position - drives[0].joint_position) * 0.1 / 0.5;
    const double off = std::remainder(robot.snapshot().base.pose.heading - yaw, 2.0 * M_PI);
    worst_yaw = std::max(worst_yaw, std::abs(off));
    driven += 4.0 * toSeconds(kDrive) * kHalfWheel;

    for (int time = 0; time < kReturns; ++time) {
      ASSERT_NO_FATAL_FAILURE(this->aDriveGoesAndComesBack());
      // What is taken the first time stays taken.
      held_last = heldBytes();
      if (round == 0 && time == 0) held = held_last;
    }
    if (round == 0) memory = residentMemory();
  }
  if (kCanCountAllocations) {
    EXPECT_EQ(0u, allocated) << "allocated in the cycle";
    EXPECT_LE(std::abs(held_last - held), kBlockSpare) << "bytes of the heap beside what it held after the first loss";
  }
  const long grown = residentMemory() - memory;
  EXPECT_LE(grown, 256) << "kB more than after the first round";
  // Where a module sends by its own clock its values grow older and younger again, by a cycle at most.
  EXPECT_LT(this->steady_drift_, kRampError) << "rad between the told and the true angle in minutes of the same speed";
  EXPECT_LT(worst_angle, kRampError * kRamps * wanted) << "rad: more than ramps can do";
  EXPECT_LT(worst_yaw, 1e-6) << "rad between the pose and its wheels";
  EXPECT_EQ(trips_at_begin, robot.unit(0).counters().watchdog_trips) << "the left drive was never lost";
  for (const DriveIndex drive : {0u, 1u}) EXPECT_EQ(0u, robot.snapshot().drives[drive].eeprom_writes);
  EXPECT_EQ("no rule broken", rulesBroken(robot));
  std::printf(
      "soak: %s %.2f h simulated, %llu cycles, %lu allocations in the cycle, %ld kB more than after the first round, "
      "wheels off by at most %.3g rad of %.4g driven (by %.3g rad at a steady speed), pose off its wheels by at most "
      "%.3g rad\n",
      BusName::GetName<TypeParam>(0).c_str(), toSeconds(robot.transport().now() - begin) / 3600.0,
      static_cast<unsigned long long>(this->cycles_), allocated, grown, worst_angle, driven, this->steady_drift_,
      worst_yaw);
}

}  // namespace
}  // namespace nord_driver::test
