#include "process_campaign/process_calls.h"

#include <ros/ros.h>

#include <utility>

#include "nord_driver/ReadParameter.h"

namespace nord_driver::test {

namespace {

constexpr char kNode[] = "nord_driver/";

}  // namespace

ProcessCalls::~ProcessCalls() {
  end();
}

void ProcessCalls::begin(const std::string& label, const std::string& service,
                         std::function<CallOutcome(const std::string&)> call) {
  threads_.emplace_back([this, label, service, call = std::move(call)] {
    if (ros::service::exists(kNode + service, false)) carryOutOne(label, service, call);
  });
}

void ProcessCalls::readOn(const std::string& drive, std::uint16_t number) {
  threads_.emplace_back([this, drive, number] {
    ros::ServiceClient client;
    const auto read = [number, &client](const std::string& name) {
      ReadParameter service;
      service.request.number = number;
      if (!client.isValid()) client = connectTo<ReadParameter>(name);
      return outcomeOf(client, service);
    };
    for (;;) {
      {
        const std::lock_guard<std::mutex> lock{mutex_};
        if (ending_) return;
      }
      const std::string name = drive + "/read_parameter";
      if (client.isValid() || ros::service::exists(kNode + name, false)) carryOutOne(name, name, read);
      ros::WallDuration(0.002).sleep();
    }
  });
}

void ProcessCalls::carryOutOne(const std::string& label, const std::string& service,
                               const std::function<CallOutcome(const std::string&)>& call) {
  Call* place = nullptr;
  {
    const std::lock_guard<std::mutex> lock{mutex_};
    if (!driver_lives_) return;
    calls_.emplace_back();
    place = &calls_.back();
    place->made.service = label;
    place->made.begin = ros::Time::now().toSec() - start_;
  }
  const CallOutcome outcome = call(kNode + service);
  const std::lock_guard<std::mutex> lock{mutex_};
  place->made.end = ros::Time::now().toSec() - start_;
  place->made.success = outcome.answer.success;
  place->made.message = outcome.answer.message;
  place->made.not_carried_out = outcome.not_carried_out;
}

void ProcessCalls::end() {
  {
    const std::lock_guard<std::mutex> lock{mutex_};
    ending_ = true;
  }
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void ProcessCalls::driverBegan() {
  const std::lock_guard<std::mutex> lock{mutex_};
  driver_lives_ = true;
}

void ProcessCalls::driverEnds() {
  const std::lock_guard<std::mutex> lock{mutex_};
  driver_lives_ = false;
  for (Call& call : calls_) call.orphaned = call.orphaned || !call.made.end;
}

std::vector<MadeCall> ProcessCalls::of(const std::string& label) const {
  const std::lock_guard<std::mutex> lock{mutex_};
  std::vector<MadeCall> found;
  for (const Call& call : calls_) {
    if (call.made.service == label) found.push_back(call.made);
  }
  return found;
}

std::vector<MadeCall> ProcessCalls::ofDriversThatGoOn() const {
  const std::lock_guard<std::mutex> lock{mutex_};
  std::vector<MadeCall> found;
  for (const Call& call : calls_) {
    if (!call.orphaned) found.push_back(call.made);
  }
  return found;
}

}  // namespace nord_driver::test
