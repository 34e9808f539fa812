#include "process_campaign/process_player.h"

#include <ros/ros.h>
#include <signal.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>

#include "nord_driver/SimAnswerDelay.h"
#include "nord_driver/SimParameterChannel.h"
#include "nord_driver/SimTerminals.h"
#include "support/machine_watch.h"

namespace nord_driver::test {

namespace {

constexpr double kFastest = 0.6, kFastestTurn = 1.0;  // m/s, rad/s: below what the wheels can
constexpr double kLongestHold = 2.0;                  // s
constexpr double kRamps = 0.9 + 0.5;                  // s, of the base and of the drives (common.launch)
constexpr double kLongestTimeout = 1.0;               // s, of cmd_vel, drives and buses alike there
constexpr double kSpare = 0.6;                        // s, for what passes between a call, a topic and the bus
constexpr double kTruthAge = 0.1;                     // s, of 50 Hz

CallOutcome setBool(const std::string& name, bool on) {
  std_srvs::SetBool service;
  service.request.data = on;
  return outcomeOf(name, service);
}

CallOutcome trigger(const std::string& name) {
  std_srvs::Trigger service;
  return outcomeOf(name, service);
}

/// Of the simulator; what it answers.
template <typename Service>
bool change(const std::string& drive, const char* what, Service& service) {
  return callService("nord_sim/" + drive + what, service).success;
}

}  // namespace

ProcessPlayer::ProcessPlayer(RobotUnderTest& robot, std::unique_ptr<NodeProcess>& driver,
                             const ProcessScenario& scenario)
    : robot_(robot), driver_(driver), scenario_(scenario) {}

double ProcessPlayer::now() const {
  return ros::Time::now().toSec() - start_;
}

void ProcessPlayer::waitUntil(double at) {
  const double left = at - now();
  if (left > 0.0) ros::WallDuration(left).sleep();
}

std::optional<std::string> ProcessPlayer::play() {
  truth_from_[0] = robot_.left.truth.mark();
  truth_from_[1] = robot_.right.truth.mark();
  const MachineWatch watch;
  start_ = ros::Time::now().toSec();
  calls_.startAt(start_);
  calls_.readOn("left", 102);
  calls_.readOn("right", 105);
  for (const ProcessEvent& event : scenario_.events) {
    endOver(event.at);
    waitUntil(event.at);
    begin(event);
  }
  endOver(scenario_.length);
  waitUntil(scenario_.length);
  endOver(HUGE_VAL);
  silence();
  ros::WallDuration(kLongestTimeout * timeFactor()).sleep();
  calls_.end();
  return judge(watch.longest().length.count());
}

// In the order of their ends.
void ProcessPlayer::endOver(double at) {
  const auto endOf = [](const ProcessEvent& event) { return event.at + event.span; };
  for (;;) {
    const auto first = std::min_element(lasting_.begin(), lasting_.end(),
                                        [&](const auto& a, const auto& b) { return endOf(a) < endOf(b); });
    if (first == lasting_.end() || endOf(*first) > at) return;
    const ProcessEvent over = *first;
    lasting_.erase(first);
    waitUntil(std::min(endOf(over), scenario_.length));
    end(over);
  }
}

void ProcessPlayer::enable() {
  calls_.begin("enable", "enable", [](const std::string& name) { return setBool(name, true); });
}

void ProcessPlayer::stop(bool quick) {
  stops_.push_back(now());
  if (quick) {
    calls_.begin("quick_stop", "quick_stop", trigger);
  } else {
    calls_.begin("disable", "enable", [](const std::string& name) { return setBool(name, false); });
  }
}

void ProcessPlayer::silence() {
  robot_.silence();
  if (!commanded_.empty()) commanded_.back().until = std::min(commanded_.back().until, now());
}

void ProcessPlayer::drive(double linear, double angular) {
  silence();
  robot_.drive(linear, angular);
  if (linear != 0.0 || angular != 0.0) commanded_.push_back({now(), HUGE_VAL});
}

void ProcessPlayer::endDriver(int signal, bool waits) {
  stops_.push_back(now());
  calls_.driverEnds();
  driver_->signal(signal);
  if (waits && !driver_->waitEnd(kPatience)) trouble_ = "the driver did not end";
  driver_.reset();
}

void ProcessPlayer::beginDriver() {
  driver_ = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=nord_driver"});
  calls_.driverBegan();
}

bool ProcessPlayer::simulate(const ProcessEvent& event, bool on) {
  const std::string drive = event.left ? "left" : "right";
  switch (event.act) {
    case ProcessAct::kUnplug:
      return robot_.simulator(drive + "/unplug", on).success;
    case ProcessAct::kPowerOff:
      return robot_.simulator(drive + "/power_inverter", !on).success;
    case ProcessAct::kLinkCut:
      return robot_.simulator(drive + "/module_link", !on).success;
    case ProcessAct::kMute:
      return robot_.simulator(drive + "/mute", on).success;
    case ProcessAct::kLocalControl:
      return robot_.simulator(drive + "/local_control", on).success;
    case ProcessAct::kTrip:
      if (on) return robot_.trip(drive, static_cast<std::uint16_t>(event.amount), event.span != 0.0).success;
      return robot_.clearCause(drive).success;
    case ProcessAct::kCoast: {
      SimTerminals service;
      service.request.coast = on;
      return change(drive, "/terminals", service);
    }
    case ProcessAct::kLateAnswers: {
      SimAnswerDelay service;
      service.request.seconds = on ? 0.001 * event.amount : 0.0;
      return change(drive, "/answer_delay", service);
    }
    case ProcessAct::kSilentParameters: {
      SimParameterChannel service;
      service.request.silent = on;
      return change(drive, "/parameter_channel", service);
    }
    default:
      return true;
  }
}

void ProcessPlayer::begin(const ProcessEvent& event) {
  switch (event.act) {
    case ProcessAct::kDrive:
      return drive(0.01 * event.amount * kFastest, 0.01 * event.extra * kFastestTurn);
    case ProcessAct::kSilence:
      return silence();
    case ProcessAct::kEnable:
      return enable();
    case ProcessAct::kDisable:
      return stop(false);
    case ProcessAct::kQuickStop:
      return stop(true);
    case ProcessAct::kAcknowledge:
      return calls_.begin("acknowledge", "acknowledge_faults", trigger);
    case ProcessAct::kHold:
      driver_->signal(SIGSTOP);
      break;
    case ProcessAct::kKill:
      endDriver(SIGKILL, false);
      break;
    case ProcessAct::kEnd:
      endDriver(SIGTERM, true);
      break;
    default:
      if (!simulate(event, true)) trouble_ = "the simulator refused: " + toText(event);
      if (event.span == 0.0) return;
  }
  lasting_.push_back(event);
}

void ProcessPlayer::end(const ProcessEvent& event) {
  if (event.act == ProcessAct::kHold) return driver_->signal(SIGCONT);
  if (event.act == ProcessAct::kKill || event.act == ProcessAct::kEnd) return beginDriver();
  if (!simulate(event, false)) trouble_ = "the simulator refused the end of " + toText(event);
}

ProcessRecord ProcessPlayer::record() {
  ProcessRecord record;
  const Topic<SimDrive>* const truths[] = {&robot_.left.truth, &robot_.right.truth};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const auto& truth : truths[i]->since(truth_from_[i])) {
      record.wheels[i].push_back(
          {truth->header.stamp.toSec() - start_, truth->operation_enabled != 0, truth->frequency, truth->setpoint_1});
    }
  }
  for (const MadeCall& call : calls_.of("enable")) record.enablings.push_back(call);
  record.stops = stops_;
  record.commanded = commanded_;
  return record;
}

std::optional<std::string> ProcessPlayer::judge(double held_up) {
  if (!trouble_.empty()) return trouble_;
  const double longer = timeFactor();
  ProcessBounds bounds;
  bounds.stop = kLongestTimeout * longer + kRamps + kSpare + held_up;
  // That the drive is silent, and then that the driver is: one after the other at worst.
  bounds.alone = 2.0 * kLongestTimeout * longer + kSpare + held_up;
  bounds.seen = kTruthAge + held_up;
  const ProcessRecord seen = record();
  if (seen.wheels[0].empty() || seen.wheels[1].empty()) return "the simulator has told nothing";
  for (const auto& rule : {enabledUnasked, turnsUncommanded, turnsAlone}) {
    if (auto broken = rule(seen, bounds)) return broken;
  }
  const double patience =
      ros::param::param("nord_driver/service_timeout", 5.0) + kLongestHold * longer + kSpare + held_up;
  return unanswered(calls_.ofDriversThatGoOn(), patience);
}

}  // namespace nord_driver::test
