// Everything that was published on a topic since the subscription, and waiting for what comes.
#pragma once

#include <ros/message_traits.h>
#include <ros/ros.h>

#include <boost/function.hpp>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

namespace nord_driver::test {

using Seconds = std::chrono::duration<double>;

/// How much longer everything takes where it is emulated (scripts/can_machine.sh).
inline double timeFactor() {
  const char* text = std::getenv("NORD_TIME_FACTOR");
  return text == nullptr ? 1.0 : std::atof(text);
}

/// Long enough for whatever will happen at all, on a machine that does a lot else.
inline const Seconds kPatience{20.0 * timeFactor()};

/// Filled by the spinner's threads, read by the test's. A place in the record is a count of messages: `mark()` now,
/// `since(mark)` later.
template <typename Message>
class Topic {
 public:
  using Pointer = boost::shared_ptr<const Message>;

  Topic(ros::NodeHandle& node, const std::string& name) {
    const boost::function<void(const Pointer&)> take = [this](const Pointer& message) {
      const std::lock_guard<std::mutex> lock(mutex_);
      record_.push_back(message);
      arrived_.notify_all();
    };
    subscriber_ = node.subscribe<Message>(name, 1000, take);
  }
  ~Topic() { subscriber_.shutdown(); }
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;

  std::size_t mark() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return record_.size();
  }
  std::vector<Pointer> since(std::size_t mark) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {record_.begin() + static_cast<std::ptrdiff_t>(mark), record_.end()};
  }

  /// The first message from `mark` on for which `good` holds; null when none has come within `limit`.
  template <typename Condition>
  Pointer waitFrom(std::size_t mark, Condition good, Seconds limit = kPatience) {
    std::unique_lock<std::mutex> lock(mutex_);
    Pointer found;
    arrived_.wait_for(lock, limit, [&] {
      for (; mark < record_.size() && !found; ++mark) {
        if (good(*record_[mark])) found = record_[mark];
      }
      return found != nullptr;
    });
    return found;
  }
  /// The same for what was measured from now on: what was true before does not count, though it comes late. Without a
  /// stamp, and with one of a clock that stands at zero, for what comes from now on.
  template <typename Condition>
  Pointer waitNext(Condition good, Seconds limit = kPatience) {
    const ros::Time now = ros::Time::now();
    const auto later = [&](const Message& message) {
      const ros::Time* stamp = ros::message_traits::timeStamp(message);
      return (stamp == nullptr || stamp->isZero() || *stamp >= now) && good(message);
    };
    return waitFrom(mark(), later, limit);
  }
  Pointer next(Seconds limit = kPatience) {
    return waitNext([](const Message&) { return true; }, limit);
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Pointer> record_;
  ros::Subscriber subscriber_;
};

}  // namespace nord_driver::test
