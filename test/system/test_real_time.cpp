// The bus cycle at 500 Hz in real time: it allocates nothing, touches no page for the first time, and comes late only where
// the machine was.
//
// usage: test_real_time [SECONDS] [INTERFACE]   seconds of driving (10); a CAN interface such as vcan0 or virtual:NAME,
// without which the drives are on PROFIBUS behind a pty. What was measured stands in a line that begins with "soak:".
#include <fcntl.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cycle/bus_cycle.h"
#include "cycle/cycle_thread.h"
#include "sim/canopen/can_bus_thread.h"
#include "sim/profibus/pty_bus.h"
#include "support/count_allocations.h"
#include "support/map_settings.h"
#include "support/overslept_waits.h"
#include "transport/canopen/canopen.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::test {

int wanted_seconds = 10;
std::string interface;  // empty: a pty

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr double kRate = 500.0;  // Hz
constexpr int kPriority = 50;    // of SCHED_FIFO, where that is permitted
constexpr std::size_t kMostLate = 100'000;

bool takePriority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
}

/// A period that took at least half of one too long.
struct Late {
  Instant end{};
  Duration length{};
  Duration waited{};  ///< of it the thread was ready to run, and did not: as the kernel counts it
};

/// What one thread's periods were.
class Periods {
 public:
  explicit Periods(Duration period) : period_(period) { late_.reserve(kMostLate); }
  ~Periods() {
    if (schedstat_ >= 0) ::close(schedstat_);
  }
  Periods(const Periods&) = delete;
  Periods& operator=(const Periods&) = delete;

  /// By the thread, once a period.
  void tick() noexcept {
    const Instant now = Clock::now();
    if (schedstat_ < 0) schedstat_ = ::open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC);
    const unsigned long long waited = runDelay();
    if (count_++ == 0) {
      first_ = now;
    } else if (now - last_ >= 1.5 * period_ && late_.size() < kMostLate) {
      late_.push_back({now, now - last_, std::chrono::nanoseconds{waited - waited_}});
    }
    last_ = now;
    waited_ = waited;
  }
  const std::vector<Late>& late() const noexcept { return late_; }
  std::uint64_t count() const noexcept { return count_; }
  Duration span() const noexcept { return last_ - first_; }

 private:
  /// ns; "running waiting slices".
  unsigned long long runDelay() noexcept {
    char text[128] = {};
    if (::pread(schedstat_, text, sizeof text - 1, 0) <= 0) return 0;
    char* end = text;
    static_cast<void>(std::strtoull(end, &end, 10));
    return std::strtoull(end, &end, 10);
  }

  const Duration period_;
  std::vector<Late> late_;
  std::uint64_t count_ = 0;
  unsigned long long waited_ = 0;
  int schedstat_ = -1;
  Instant first_{}, last_{};
};

/// Looks on in the cycle's thread.
class Witness final : public cycle::CycleObserver {
 public:
  explicit Witness(Duration period) : periods(period) {}

  void handleCycle(const std::vector<profile::ProcessOutput>& /*outputs*/, const std::vector<DriveExchange>& /*inputs*/,
                   const cycle::CycleSnapshot& /*snapshot*/) noexcept override {
    if (!counting) return;
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    const long faults = usage.ru_minflt + usage.ru_majflt;
    if (periods.count() == 0) {
      countThisThread(true);
      faults_before_ = faults;
    }
    page_faults = faults - faults_before_;
    periods.tick();
  }

  std::atomic<bool> counting{false};
  std::atomic<long> page_faults{0};
  Periods periods;

 private:
  long faults_before_ = 0;
};

/// The same period, the same scheduler, and nothing to do. On one processor: what a host takes from a virtual one while that
/// is idle, no thread on another one sees, nor does the kernel count it.
class BareTimer {
 public:
  BareTimer(Duration period, bool priority, unsigned processor) : periods(period) {
    thread_ = std::thread([this, period, priority, processor] {
      cpu_set_t only;
      CPU_ZERO(&only);
      CPU_SET(processor, &only);
      id_ = thisThread();
      is_pinned_ = ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only) == 0;
      ::prctl(PR_SET_TIMERSLACK, 1);
      if (priority) takePriority(kPriority);
      Instant next = Clock::now();
      while (!stop_) {
        periods.tick();
        next = std::max(next + period, Clock::now());
        const auto since = next.time_since_epoch();
        const auto whole = std::chrono::duration_cast<seconds>(since);
        const timespec until{whole.count(), static_cast<long>(std::chrono::nanoseconds(since - whole).count())};
        ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      }
    });
  }
  void end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  bool isPinned() const noexcept { return is_pinned_; }
  long thread() const noexcept { return id_; }
  ~BareTimer() { end(); }
  BareTimer(const BareTimer&) = delete;
  BareTimer& operator=(const BareTimer&) = delete;

  Periods periods;

 private:
  std::atomic<bool> stop_{false};
  std::atomic<bool> is_pinned_{false};
  std::atomic<long> id_{0};
  std::thread thread_;
};

/// One on each processor.
std::vector<std::unique_ptr<BareTimer>> bareTimers(Duration period, bool priority) {
  std::vector<std::unique_ptr<BareTimer>> all;
  const unsigned processors = std::max(1u, std::thread::hardware_concurrency());
  for (unsigned i = 0; i < processors; ++i) all.push_back(std::make_unique<BareTimer>(period, priority, i));
  return all;
}

std::vector<DriveSettings> drives() {
  std::vector<DriveSettings> all;
  for (const char* const name : {"left", "right"}) {
    auto settings = std::make_shared<MapSettings>(std::string{"drives/"} + name + "/");
    settings->set("address", static_cast<int>(3 + all.size())).set("series", "sk5xxe").set("pole_pairs", 2);
    settings->set("gear_ratio", 20.0).set("joint", name);
    all.push_back({name, settings});
  }
  return all;
}

/// Driver and simulator, each with its threads.
class RealRobot {
 public:
  explicit RealRobot(bool priority) {
    sim::SimConfig simulated;
    for (const char* const name : {"left", "right"}) {
      sim::DriveConfig drive;
      drive.name = name;
      drive.address = static_cast<std::uint8_t>(3 + simulated.drives.size());
      if (!interface.empty()) drive.bus = sim::CanDriveConfig{};
      simulated.drives.push_back(drive);
    }
    MapSettings node{""};
    node.set("left_wheel", "left").set("right_wheel", "right").set("wheel_separation", 0.5).set("wheel_radius", 0.1);
    node.set("cycle_rate", kRate);
    config_ = cycle::readCycleConfig(node, drives());
    config_.real_time.priority = priority ? kPriority : 0;
    config_.real_time.lock_memory = priority;
    // The simulator's threads take over how this one is scheduled: just above, as a module's own processor is always there.
    if (priority) takePriority(kPriority + 1);
    if (interface.empty()) {
      simulated.bus.as<sim::DpBusConfig>().baud_rate = 1'500'000;
      const std::string place = "/tmp/nord_real_time." + std::to_string(::getpid());
      bus_ = std::make_unique<sim::PtyBus>(simulated, place);
      transport_ = std::make_unique<ProfibusDpTransport>();
      transport_->configure(MapSettings{"bus/", {{"device", place}, {"baud_rate", 1'500'000}, {"slot_time", 0.0003}}},
                            drives(), kRate);
    } else {
      sim::CanBusConfig can;
      can.interface = interface;
      simulated.bus = can;
      bus_ = std::make_unique<sim::CanBusThread>(simulated);
      transport_ = std::make_unique<CanopenTransport>();
      transport_->configure(MapSettings{"bus/", {{"interface", interface}, {"bit_rate", 1'000'000}}}, drives(), kRate);
    }
    sched_param ordinary{};
    ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
    cycle_ = std::make_unique<cycle::BusCycle>(config_, *transport_, ports_, false);
    ports_.setObserver(&witness_);
    thread_ = std::make_unique<cycle::CycleThread>(*cycle_, *transport_, config_.real_time);
  }

  /// For so long, there and back.
  void drive(Duration span) {
    const Instant begin = Clock::now();
    for (Instant now = begin; now - begin < span; now = Clock::now()) {
      const bool back = (now - begin) / seconds{4} % 2 != 0;
      ports_.commandBase({{back ? -0.2 : 0.2, 0.0}, now, true});
      while (ports_.pollBusEvent()) {
      }
      while (ports_.waitCompletion(Duration::zero())) {
      }
      if (!ports_.readSnapshot().base.enabled) enable();
      std::this_thread::sleep_for(milliseconds{20});
    }
  }
  void enable() {
    if (Clock::now() < next_try_) return;
    next_try_ = Clock::now() + seconds{2};
    ports_.commandBase({{0.0, 0.0}, Clock::now(), true});
    for (const auto kind : {cycle::RequestKind::kAcknowledge, cycle::RequestKind::kEnable}) {
      cycle::Request request;
      request.id = ++last_id_;
      request.kind = kind;
      request.patience = seconds{3};
      ports_.submit(request);
    }
    ++enables;
  }
  /// Waits until the base is enabled.
  bool bringUp() {
    for (const Instant end = Clock::now() + seconds{30}; Clock::now() < end;) {
      const cycle::CycleSnapshot& now = ports_.readSnapshot();
      if (now.base.enabled) return true;
      if (std::all_of(now.drives.begin(), now.drives.end(), [](const auto& drive) { return drive.device.complete; })) {
        enable();
      }
      std::this_thread::sleep_for(milliseconds{20});
    }
    return false;
  }
  cycle::CyclePorts& ports() { return ports_; }
  Witness& witness() { return witness_; }
  void end() { thread_.reset(); }
  Duration period() const { return config_.period(); }
  std::string refused() const { return thread_->refused(); }

  unsigned enables = 0;

 private:
  cycle::CycleConfig config_;
  cycle::CyclePorts ports_{2};
  Witness witness_{nord_driver::seconds(1.0 / kRate)};
  std::unique_ptr<sim::RunningBus> bus_;
  std::unique_ptr<Transport> transport_;
  std::unique_ptr<cycle::BusCycle> cycle_;
  std::unique_ptr<cycle::CycleThread> thread_;
  Instant next_try_{};
  std::uint32_t last_id_ = 0;
};

/// Whether it would have been in time without what the kernel had it wait: for a processor, or, it or the far end, beyond
/// the end of a wait.
bool waitedForTheKernel(const Late& late, const std::vector<long>& timers, Duration period) {
  const Duration overslept = oversleptBetween(late.end - late.length, late.end, timers);
  return late.length - std::max(late.waited, overslept) <= 1.5 * period;
}

/// Late periods of the cycle for which neither the kernel nor a late bare timer is the excuse.
std::size_t ownDoing(const std::vector<Late>& cycle, const std::vector<std::unique_ptr<BareTimer>>& timers,
                     Duration period) {
  std::vector<long> threads;
  for (const auto& timer : timers) threads.push_back(timer->thread());
  std::size_t own = 0;
  for (const Late& late : cycle) {
    const auto at_that_time = [&](const Late& other) {
      return other.end >= late.end - late.length - 2 * period && other.end - other.length <= late.end + 2 * period;
    };
    const auto is_late = [&](const auto& timer) {
      const std::vector<Late>& its = timer->periods.late();
      return std::any_of(its.begin(), its.end(), at_that_time);
    };
    if (!waitedForTheKernel(late, threads, period) && std::none_of(timers.begin(), timers.end(), is_late)) ++own;
  }
  return own;
}

TEST(RealTime, TheCycleAllocatesNothingAndIsLateOnlyWithTheMachine) {
  bool priority = false;
  std::thread([&] { priority = takePriority(kPriority + 1); }).join();
  RealRobot robot{priority};
  ASSERT_TRUE(robot.bringUp()) << robot.ports().readSnapshot().base.text.c_str();
  robot.drive(seconds{2});
  const unsigned enables = robot.enables;
  Witness& witness = robot.witness();
  const auto timers = bareTimers(robot.period(), priority);
  allocations = 0;
  witness.counting = true;
  robot.drive(seconds{wanted_seconds});
  witness.counting = false;
  std::size_t bare = 0;
  for (const auto& timer : timers) {
    timer->end();
    EXPECT_TRUE(timer->isPinned());
    bare += timer->periods.late().size();
  }
  const std::string refused = robot.refused();
  robot.end();

  const Periods& periods = witness.periods;
  const std::size_t own = ownDoing(periods.late(), timers, robot.period());
  // A cycle that takes longer than a period is not caught up with; one that only begins late, by less than a period, is:
  // the next one begins in time. Without any the time that has passed is that of the cycles.
  double late = 0.0, caught_up = 0.0;
  for (const Late& one : periods.late()) {
    const Duration longer = one.length - robot.period();
    late += toSeconds(longer);
    caught_up += toSeconds(std::min(longer, robot.period()));
  }
  const double drift = toSeconds(periods.span()) - static_cast<double>(periods.count() - 1) / kRate - late;
  std::printf(
      "soak: %s %d s at %.0f Hz (%s), %llu cycles, %lu allocations in the cycle, %ld page faults in the cycle, %zu "
      "late "
      "cycles, %zu of the bare timers, %zu by the driver's own doing, %u times enabled again, drift %.4f s\n",
      interface.empty() ? "pty" : interface.c_str(), wanted_seconds, kRate,
      priority && refused.empty() ? "SCHED_FIFO" : "ordinary scheduler",
      static_cast<unsigned long long>(periods.count()), allocations.load(), witness.page_faults.load(),
      periods.late().size(), bare, own, robot.enables - enables, drift);
  EXPECT_GT(static_cast<double>(periods.count()), 0.5 * kRate * wanted_seconds);
  if (kCanCountAllocations) {
    EXPECT_EQ(0u, allocations);
  }
  EXPECT_EQ(0, witness.page_faults);
  EXPECT_EQ(0u, own);
  EXPECT_LT(periods.late().size(), kMostLate);
  EXPECT_LT(drift, 2.0 / kRate + 1e-3 * static_cast<double>(periods.late().size()));
  EXPECT_GT(drift, -2.0 / kRate - caught_up);
}

}  // namespace
}  // namespace nord_driver::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc > 1) nord_driver::test::wanted_seconds = std::atoi(argv[1]);
  if (argc > 2) nord_driver::test::interface = argv[2];
  if (argc > 3 || nord_driver::test::wanted_seconds < 1) {
    std::fprintf(stderr, "usage: test_real_time [SECONDS] [INTERFACE]\n");
    return 2;
  }
  return RUN_ALL_TESTS();
}
