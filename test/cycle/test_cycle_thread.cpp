// The thread keeps the rate of its cycle by the transport's clock and ends when it is told to.
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <string>

#include "cycle/cycle_thread.h"
#include "cycle/scripted_transport.h"

namespace nord_driver::cycle {
namespace {

using std::chrono::milliseconds;

/// Notes when cycles began and lets the test wait until enough have passed. Time moves only by exchange and sleep.
class PacedTransport final : public Transport {
 public:
  void configure(const Settings&, const std::vector<DriveSettings>&, double) override {}
  Instant now() const noexcept override { return time_; }
  void sleepUntil(Instant when) noexcept override {
    if (when > time_) time_ = when;
  }
  void exchange(const std::vector<profile::ProcessOutput>&, std::vector<DriveExchange>& inputs) noexcept override {
    inputs[0] = {};
    const std::unique_lock<std::mutex> lock(mutex_);
    if (starts_.size() < kNoted) starts_.push_back(time_);
    time_ += starts_.size() == kLateCycle ? milliseconds{35} : milliseconds{2};
    if (starts_.size() == kNoted) enough_.notify_all();
  }
  bool connected() const noexcept override { return true; }
  DriveIdentity identity(DriveIndex) const override { return {}; }

  /// The first starts, as soon as there are enough of them.
  std::vector<Instant> starts() {
    std::unique_lock<std::mutex> lock(mutex_);
    enough_.wait_for(lock, std::chrono::seconds{10}, [this] { return starts_.size() == kNoted; });
    return starts_;
  }
  static constexpr std::size_t kNoted = 10, kLateCycle = 5;

 private:
  Instant time_{std::chrono::hours{1}};  // the cycle's thread only
  std::mutex mutex_;
  std::condition_variable enough_;
  std::vector<Instant> starts_;
};

struct Running {
  explicit Running(const RealTimeOptions& options = {}) : ports{1}, cycle{config(), transport, ports, false} {
    thread = std::make_unique<CycleThread>(cycle, transport, options);
  }
  static CycleConfig config() {
    CycleConfig config;
    config.drives.resize(1);
    config.drives[0].name = "only";
    return config;
  }
  PacedTransport transport;
  CyclePorts ports;
  BusCycle cycle;
  std::unique_ptr<CycleThread> thread;
};

TEST(CycleThreadTest, BeginsACycleEveryPeriodAndDoesNotCatchUpWithALateOne) {
  Running running;
  const std::vector<Instant> starts = running.transport.starts();
  ASSERT_EQ(PacedTransport::kNoted, starts.size());
  for (std::size_t i = 1; i < starts.size(); ++i) {
    // Two cycles in a row would tell the drives nothing new: after the late one the rhythm begins anew.
    const Duration expected = i == PacedTransport::kLateCycle ? milliseconds{35} : milliseconds{10};
    EXPECT_EQ(expected, starts[i] - starts[i - 1]) << "cycle " << i;
  }
}

// It would hang here otherwise.
TEST(CycleThreadTest, EndsWhenItIsDestroyed) {
  Running running;
  ASSERT_EQ(PacedTransport::kNoted, running.transport.starts().size());
  running.thread.reset();
  EXPECT_NE(Instant{}, running.ports.readSnapshot().time) << "its last picture stays";
}

TEST(CycleThreadTest, SaysWhatTheSystemRefused) {
  EXPECT_EQ("", Running{}.thread->refused());
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanLockMemory = false;
#else
constexpr bool kCanLockMemory = true;
#endif

/// kB of this process that stay in memory.
long lockedMemory() {
  std::ifstream status{"/proc/self/status"};
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmLck:", 0) == 0) return std::stol(line.substr(6));
  }
  return -1;
}

// Whether it may is the system's to say: what this test may lock itself tells.
TEST(CycleThreadTest, LocksTheMemoryOrSaysThatItCannot) {
  if (!kCanLockMemory) GTEST_SKIP() << "the sanitizers have replaced mlockall";
  const bool allowed = ::mlockall(MCL_CURRENT) == 0;
  ::munlockall();
  ASSERT_EQ(0, lockedMemory());
  RealTimeOptions options;
  options.lock_memory = true;
  const std::string refused = Running{options}.thread->refused();
  const long locked = lockedMemory();
  ::munlockall();
  EXPECT_EQ(allowed, refused.empty()) << refused;
  EXPECT_EQ(allowed, locked > 0) << locked << " kB";
}

/// The thread of this process with this name; 0: there is none.
pid_t threadNamed(const std::string& name) {
  for (const auto& task : std::filesystem::directory_iterator{"/proc/self/task"}) {
    std::ifstream file{task.path() / "comm"};
    std::string found;
    if (std::getline(file, found) && found == name) return std::stoi(task.path().filename().string());
  }
  return 0;
}

/// Whether a thread of this process may have a priority, which is the system's to say.
bool mayHavePriority() {
  sched_param real_time{}, ordinary{};
  real_time.sched_priority = 1;
  const bool allowed = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &real_time) == 0;
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  return allowed;
}

// Found by its name in `top -H`, by whoever looks after its priority.
TEST(CycleThreadTest, TakesItsPriorityOrSaysThatItCannot) {
  const bool allowed = mayHavePriority();
  RealTimeOptions options;
  options.priority = 3;
  Running running{options};
  running.transport.starts();
  const pid_t thread = threadNamed("bus cycle");
  ASSERT_NE(0, thread);
  sched_param parameters{};
  ASSERT_EQ(0, ::sched_getparam(thread, &parameters));
  EXPECT_EQ(allowed, running.thread->refused().empty()) << running.thread->refused();
  EXPECT_EQ(allowed ? SCHED_FIFO : SCHED_OTHER, ::sched_getscheduler(thread));
  EXPECT_EQ(allowed ? 3 : 0, parameters.sched_priority);
}

/// Prints what a process without rights is refused, and ends.
[[noreturn]] void printRefusalWithoutRights() {
  constexpr rlimit kNone{0, 0};
  ::setrlimit(RLIMIT_MEMLOCK, &kNone);
  ::setrlimit(RLIMIT_RTPRIO, &kNone);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3]{};
  ::syscall(SYS_capset, &header, none);
  RealTimeOptions options;
  options.priority = 7;
  options.lock_memory = true;
  std::cerr << Running{options}.thread->refused() << std::endl;
  std::_Exit(0);
}

TEST(CycleThreadDeathTest, SaysEachThingThatTheSystemRefuses) {
  if (!kCanLockMemory) GTEST_SKIP() << "the sanitizers have replaced mlockall";
  EXPECT_EXIT(printRefusalWithoutRights(), ::testing::ExitedWithCode(0),
              "memory cannot be locked .*; SCHED_FIFO priority 7 is not allowed");
}

}  // namespace
}  // namespace nord_driver::cycle
