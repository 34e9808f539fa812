// However many calls wait for their drives, a stop is handed to the bus cycle at once.
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "node/stop_calls.h"

namespace nord_driver::node {
namespace {

using cycle::kAllDrives;
using cycle::RequestKind;

constexpr std::size_t kDrives = 2;
constexpr Duration kPatience = std::chrono::seconds{5};

/// In the place of the broker: drives that confirm nothing until the test lets them.
class SlowDrives {
 public:
  cycle::Completion carryOut(const cycle::Request& request) {
    std::unique_lock<std::mutex> lock(mutex_);
    seen_.push_back(request);
    changed_.notify_all();
    cycle::Completion answer;
    answer.id = static_cast<std::uint32_t>(seen_.size());
    answer.success = request.patience > Duration::zero();
    if (!answer.success) answer.message = "not confirmed in time: it turns";
    if (answer.success) changed_.wait(lock, [&] { return confirm_; });
    return answer;
  }
  void confirm() {
    const std::lock_guard<std::mutex> lock(mutex_);
    confirm_ = true;
    changed_.notify_all();
  }
  void waitForRequests(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return seen_.size() >= count; });
  }
  std::vector<cycle::Request> seen() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return seen_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<cycle::Request> seen_;
  bool confirm_ = false;
};

class StopCallsTest : public ::testing::Test {
 protected:
  ~StopCallsTest() override {
    drives_.confirm();
    for (std::thread& caller : callers_) caller.join();
  }
  /// They wait for their drives, each in a thread of its lane.
  template <typename Call>
  void leaveWaiting(std::uint32_t count, Call call) {
    const std::size_t before = drives_.seen().size();
    for (std::uint32_t i = 0; i < count; ++i) callers_.emplace_back(call);
    drives_.waitForRequests(before + count);
  }
  void leaveEnablesWaiting() {
    leaveWaiting(StopCalls::enableThreads(kDrives) - 2, [this] { calls_.enable(true, kAllDrives); });
  }

  SlowDrives drives_;
  StopCalls calls_{kDrives, kPatience, [this](const cycle::Request& request) { return drives_.carryOut(request); }};
  std::vector<std::thread> callers_;
};

TEST_F(StopCallsTest, HandsOverWhatIsAskedWithThePatienceOfAService) {
  drives_.confirm();
  EXPECT_TRUE(calls_.enable(true, 1).success);
  EXPECT_TRUE(calls_.enable(false, kAllDrives).success);
  EXPECT_TRUE(calls_.quickStop(0).success);
  const auto seen = drives_.seen();
  ASSERT_EQ(3u, seen.size());
  EXPECT_EQ(RequestKind::kEnable, seen[0].kind);
  EXPECT_EQ(1u, seen[0].drive);
  EXPECT_EQ(RequestKind::kDisable, seen[1].kind);
  EXPECT_EQ(kAllDrives, seen[1].drive);
  EXPECT_EQ(RequestKind::kQuickStop, seen[2].kind);
  EXPECT_EQ(0u, seen[2].drive);
  for (const cycle::Request& request : seen) EXPECT_EQ(kPatience, request.patience);
}

TEST_F(StopCallsTest, RefusesToEnableWhenItWouldTakeAThreadThatIsKeptForStops) {
  leaveEnablesWaiting();
  const std::size_t before = drives_.seen().size();
  const cycle::Completion answer = calls_.enable(true, 0);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("too many calls wait for their drives already: ask again", answer.message.c_str());
  EXPECT_EQ(before, drives_.seen().size()) << "the bus cycle has not heard of it";
}

TEST_F(StopCallsTest, DisablesWhileManyCallsOfEnableWait) {
  leaveEnablesWaiting();
  leaveWaiting(1, [this] { calls_.enable(false, kAllDrives); });
  EXPECT_EQ(RequestKind::kDisable, drives_.seen().back().kind);
  EXPECT_EQ(kPatience, drives_.seen().back().patience) << "it is followed to its end";
}

// The lane's last thread is never held: the stop is begun, and the next call finds the thread free.
TEST_F(StopCallsTest, BeginsAStopForWhichNoThreadCanWait) {
  leaveEnablesWaiting();
  leaveWaiting(1, [this] { calls_.enable(false, 0); });
  for (int i = 0; i < 3; ++i) {
    const cycle::Completion answer = calls_.enable(false, 1);
    EXPECT_FALSE(answer.success);
    EXPECT_STREQ("too many calls wait for their drives already, this one does not: not confirmed in time: it turns",
                 answer.message.c_str());
    EXPECT_EQ(RequestKind::kDisable, drives_.seen().back().kind);
    EXPECT_EQ(Duration::zero(), drives_.seen().back().patience);
  }
}

TEST_F(StopCallsTest, QuickStopsWaitForNoCallOfEnableAndNotForEachOther) {
  leaveEnablesWaiting();
  leaveWaiting(StopCalls::quickStopThreads(kDrives) - 1, [this] { calls_.quickStop(0); });
  EXPECT_EQ(kPatience, drives_.seen().back().patience);
  EXPECT_FALSE(calls_.quickStop(1).success);
  EXPECT_EQ(RequestKind::kQuickStop, drives_.seen().back().kind);
  EXPECT_EQ(1u, drives_.seen().back().drive);
}

TEST_F(StopCallsTest, AThreadThatIsFreeAgainWaitsAgain) {
  leaveEnablesWaiting();
  drives_.confirm();
  for (std::thread& caller : callers_) caller.join();
  callers_.clear();
  EXPECT_TRUE(calls_.enable(true, 0).success);
}

// A robot of many single drives is enabled drive by drive, all at once.
TEST(StopCallsThreads, AreEnoughForAllDrivesAtOnce) {
  for (const std::size_t drives : {1u, 2u, 8u, 30u}) {
    EXPECT_GE(StopCalls::enableThreads(drives), drives + 3);
    EXPECT_GE(StopCalls::quickStopThreads(drives), drives + 2);
  }
}

}  // namespace
}  // namespace nord_driver::node
