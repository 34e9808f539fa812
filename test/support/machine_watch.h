// Measures, while a test tries something, how long the machine kept its programs from running.
#pragma once

#include <dirent.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/standstill.h"

namespace nord_driver::test {

/// Two measurements, none of which knows what is tried or what came of it.
/// 1. On every processor a thread only sleeps, in steps of 5 ms, above all others where that is permitted. It sees the
/// machine stand still: a virtual one that its host does not run, a group that has used up its time.
/// 2. Driver and simulator are other processes, and may be held up alone. Nothing they say themselves is believed,
/// neither bus_status/cycle_time_max nor gaps between stamps: a driver that is late by its own fault would excuse
/// itself. The kernel counts for every thread how long it was ready to run and did not (`RunDelay`); that is read every
/// 10 ms of this process, its children, the others of its launcher (roslaunch), and the kernel's workers: one of them
/// carries what goes through a pty, and who reads or writes it waits for that worker without being ready itself. A
/// deadlock, a wait for an answer and a sleep that is too long count as nothing there. Not seen: a page that has to be
/// read from a disk, and processes somebody else has started. Seen, though it is no stranger's doing: our own threads that keep each other from the
/// processors, which is why a try is repeated twice at most and each time is told.
class MachineWatch {
 public:
  MachineWatch() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    ::sched_getaffinity(0, sizeof allowed, &allowed);
    for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
      if (!CPU_ISSET(processor, &allowed)) continue;
      sleepers_.push_back(std::make_unique<Sleeper>());
      threads_.emplace_back([this, processor, sleeper = sleepers_.back().get()] { sleepOn(processor, *sleeper); });
    }
    threads_.emplace_back([this] { followProcesses(); });
  }
  ~MachineWatch() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  MachineWatch(const MachineWatch&) = delete;
  MachineWatch& operator=(const MachineWatch&) = delete;

  /// Since this was made.
  HoldUp longest() const {
    HoldUp longest;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      longest = longest_wait_;
    }
    for (const auto& sleeper : sleepers_) {
      const std::lock_guard<std::mutex> lock(sleeper->mutex);
      const auto late = sleeper->record.longestUntil(Clock::now());
      if (late >= longest.length) longest = {late, ""};
    }
    return longest;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kStep{5}, kRead{10}, kLookForMore{250};

  struct Sleeper {
    std::mutex mutex;  // its own: nobody holds it up
    SleepRecord record{kStep, Clock::now()};
  };
  struct Thread {
    std::string name;  // of its process
    int file;          // its schedstat
    RunDelay last;
  };

  void sleepOn(int processor, Sleeper& sleeper) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    ::pthread_setaffinity_np(::pthread_self(), sizeof one, &one);
    sched_param highest{};
    highest.sched_priority = ::sched_get_priority_max(SCHED_FIFO);
    static_cast<void>(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &highest));
    while (!stop_) {
      std::this_thread::sleep_for(kStep);
      const std::lock_guard<std::mutex> lock(sleeper.mutex);
      sleeper.record.woke(Clock::now());
    }
  }

  void followProcesses() {
    std::map<std::string, Thread> followed;  // by its path
    auto looked = Clock::now() - kLookForMore;
    for (auto last = looked; !stop_; std::this_thread::sleep_for(kRead)) {
      if (Clock::now() - looked >= kLookForMore) {
        looked = Clock::now();
        lookForThreads(followed);
      }
      const auto now = Clock::now();
      readAll(followed, now - last);
      last = now;
    }
    for (auto& [path, thread] : followed) ::close(thread.file);
  }

  static std::string read(int file) {
    char text[512];
    const ssize_t count = ::pread(file, text, sizeof text, 0);
    return count > 0 ? std::string(text, static_cast<std::size_t>(count)) : std::string{};
  }
  static std::string read(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return {};
    std::string text = read(file);
    ::close(file);
    return text;
  }
  /// The names in a folder that are numbers.
  static std::vector<std::string> numbersIn(const std::string& folder) {
    std::vector<std::string> numbers;
    const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), &::closedir);
    if (!open) return numbers;
    while (const dirent* entry = ::readdir(open.get())) {
      if (entry->d_name[0] >= '0' && entry->d_name[0] <= '9') numbers.emplace_back(entry->d_name);
    }
    return numbers;
  }
  /// This process, its children, and what its launcher has started beside it.
  static bool isOurs(const std::string& stat) {
    const std::size_t behind_name = stat.rfind(')');  // "12 (name) S 34 ...", and a name may have brackets
    if (behind_name == std::string::npos || behind_name + 4 >= stat.size()) return false;
    const int parent = std::atoi(stat.c_str() + behind_name + 4);
    return parent == ::getpid() || (parent == ::getppid() && parent != 1);
  }
  /// Each is followed from the first look at it on.
  static void lookForThreads(std::map<std::string, Thread>& followed) {
    for (const std::string& process : numbersIn("/proc")) {
      const std::string folder = "/proc/" + process;
      const std::string stat = read(folder + "/stat");
      const std::string name = stat.substr(stat.find('(') + 1, stat.rfind(')') - stat.find('(') - 1);
      const bool carries_ptys = name.rfind("kworker/u", 0) == 0;
      if (process != std::to_string(::getpid()) && !isOurs(stat) && !carries_ptys) continue;
      for (const std::string& thread : numbersIn(folder + "/task")) {
        const std::string path = folder + "/task/" + thread + "/schedstat";
        if (followed.count(path) != 0) continue;
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) continue;
        followed.emplace(path, Thread{name, file, RunDelay::from(read(file)).value_or(RunDelay{})});
      }
    }
  }
  void readAll(std::map<std::string, Thread>& followed, std::chrono::duration<double> window) {
    HoldUp longest;
    for (auto at = followed.begin(); at != followed.end();) {
      Thread& thread = at->second;
      const auto now = RunDelay::from(read(thread.file));
      if (!now) {  // it has ended
        ::close(thread.file);
        at = followed.erase(at);
        continue;
      }
      const auto waited = longestWait(thread.last, *now, window);
      if (waited > longest.length) longest = {waited, thread.name};
      thread.last = *now;
      ++at;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (longest.length > longest_wait_.length) longest_wait_ = longest;
  }

  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  HoldUp longest_wait_;
  std::vector<std::unique_ptr<Sleeper>> sleepers_;
  std::vector<std::thread> threads_;
};

}  // namespace nord_driver::test
