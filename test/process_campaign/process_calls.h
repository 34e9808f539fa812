// Service calls of several users at once, each in a thread of its own: when they began, how they ended.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "process_campaign/process_rules.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {

/// What a call brought: `Answer`, and where there was none, why.
struct CallOutcome {
  Answer answer;
  std::string not_carried_out;
};

template <typename Service>
CallOutcome outcomeOf(ros::ServiceClient& client, Service& service) {
  if (!client.isValid()) return {{}, "no connection was made"};
  if (client.call(service)) return {{service.response.success != 0, service.response.message}, ""};
  return {{}, client.isValid() ? "its handler failed" : "its connection was lost"};
}

/// One call over a connection of its own, without waiting for the service.
template <typename Service>
CallOutcome outcomeOf(const std::string& name, Service& service) {
  ros::ServiceClient client = connectTo<Service>(name);
  return outcomeOf(client, service);
}

class ProcessCalls {
 public:
  ProcessCalls() = default;
  ~ProcessCalls();
  ProcessCalls(const ProcessCalls&) = delete;
  ProcessCalls& operator=(const ProcessCalls&) = delete;

  /// Their times are told from then on, s.
  void startAt(double time) { start_ = time; }
  /// Calls `service` of the driver, if there is one just now, under the name `label`; `call` carries it out. Comes back at
  /// once.
  void begin(const std::string& label, const std::string& service, std::function<CallOutcome(const std::string&)> call);
  /// A user who reads a parameter of that drive again and again, until the end, over a connection that stays as long as
  /// the driver.
  void readOn(const std::string& drive, std::uint16_t number);
  /// No new ones; waits for those that run.
  void end();
  /// The driver is about to be ended: who waits for its answer may get none, and nobody calls before it has begun anew.
  void driverEnds();
  void driverBegan();
  std::vector<MadeCall> of(const std::string& label) const;
  /// All but those that were under way when a driver was ended.
  std::vector<MadeCall> ofDriversThatGoOn() const;

 private:
  struct Call {
    MadeCall made;
    bool orphaned = false;  ///< its driver was ended meanwhile
  };

  void carryOutOne(const std::string& label, const std::string& service,
                   const std::function<CallOutcome(const std::string&)>& call);

  mutable std::mutex mutex_;
  double start_ = 0.0;
  bool ending_ = false;
  bool driver_lives_ = true;
  std::deque<Call> calls_;
  std::vector<std::thread> threads_;
};

}  // namespace nord_driver::test
