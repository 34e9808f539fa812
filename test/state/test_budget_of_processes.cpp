// Several processes at once, and one that is killed: no write is lost from the count.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "state/eeprom_budget.h"
#include "support/temporary_folder.h"

namespace nord_driver::state {
namespace {

const WallTime kNow = WallTime{} + std::chrono::hours{24} * 20'780;

/// A child process that does nothing but `work`, with the end of a pipe it may write to.
class Child {
 public:
  explicit Child(const std::function<void(int)>& work) {
    int ends[2];
    if (::pipe(ends) != 0) return;
    id_ = ::fork();
    if (id_ == 0) {
      ::close(ends[0]);
      try {
        work(ends[1]);
      } catch (...) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    said_ = ends[0];
  }
  ~Child() {
    kill();
    ::close(said_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its next word; false when it has ended.
  bool hear() {
    char word = 0;
    return ::read(said_, &word, 1) == 1;
  }
  void kill() {
    if (id_ > 0) ::kill(id_, SIGKILL);
    waitEnd();
  }
  /// Its exit code.
  int waitEnd() {
    int status = -1;
    if (id_ > 0) ::waitpid(id_, &status, 0);
    id_ = -1;
    return status;
  }

 private:
  pid_t id_ = -1;
  int said_ = -1;
};

// The child writes the EEPROM, as it says through the pipe, after each reservation, and is killed wherever it is.
TEST(BudgetOfProcesses, LosesNoWriteOfOneThatIsKilled) {
  const test::TemporaryFolder folder;
  std::uint64_t written = 0, runs = 0;
  for (const int words : {1, 2, 3, 5, 8, 13}) {
    Child child{[&](int pipe) {
      const EepromBudget budget{folder.path("counts.yaml"), 100'000};
      for (;;) {
        budget.reserve("left", 1, kNow);
        if (::write(pipe, "w", 1) != 1) return;
      }
    }};
    for (int i = 0; i < words; ++i) ASSERT_TRUE(child.hear());
    written += static_cast<std::uint64_t>(words);
    child.kill();
    while (child.hear()) ++written;
    ++runs;
    const EepromCount count = EepromBudget{folder.path("counts.yaml"), 100'000}.countOf("left");
    EXPECT_GE(count.writes, written) << "never too low";
    EXPECT_LE(count.writes, written + runs) << "too high by the one under way of each run";
  }
}

TEST(BudgetOfProcesses, CountsThoseOfAllAtOnce) {
  constexpr int kEach = 40;
  const test::TemporaryFolder folder;
  const auto write = [&](int) {
    const EepromBudget budget{folder.path("counts.yaml"), 100'000};
    for (int i = 0; i < kEach; ++i) budget.reserve("left", 1, kNow);
  };
  Child one{write}, two{write}, three{write};
  EXPECT_EQ(0, one.waitEnd());
  EXPECT_EQ(0, two.waitEnd());
  EXPECT_EQ(0, three.waitEnd());
  EXPECT_EQ(3u * kEach, EepromBudget(folder.path("counts.yaml"), 100'000).countOf("left").writes);
}

}  // namespace
}  // namespace nord_driver::state
