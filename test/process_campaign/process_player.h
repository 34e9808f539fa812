// Plays a scenario on the real programs, and judges it: driver and simulator are processes, the bus is a pty, a CAN
// interface or TCP.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "process_campaign/process_calls.h"
#include "process_campaign/process_rules.h"
#include "process_campaign/process_scenario.h"
#include "rostest/node_process.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {

class ProcessPlayer {
 public:
  /// The drives are at rest; `driver` runs.
  ProcessPlayer(RobotUnderTest& robot, std::unique_ptr<NodeProcess>& driver, const ProcessScenario& scenario);

  /// What did not hold; nothing when all did. Afterwards every cause has ended, nobody commands, and a driver runs.
  std::optional<std::string> play();

 private:
  /// s after the start.
  double now() const;
  void waitUntil(double at);
  void begin(const ProcessEvent& event);
  void end(const ProcessEvent& event);
  void endOver(double at);
  void enable();
  void stop(bool quick);
  void drive(double linear, double angular);
  void silence();
  void endDriver(int signal, bool waits);
  void beginDriver();
  bool simulate(const ProcessEvent& event, bool on);
  ProcessRecord record();
  std::optional<std::string> judge(double held_up);

  RobotUnderTest& robot_;
  std::unique_ptr<NodeProcess>& driver_;
  ProcessScenario scenario_;
  ProcessCalls calls_;
  double start_ = 0.0;
  std::size_t truth_from_[2] = {0, 0};
  std::vector<ProcessEvent> lasting_;
  std::vector<double> stops_;
  std::vector<TimeSpan> commanded_;
  std::string trouble_;  // what the simulator refused
};

}  // namespace nord_driver::test
