// A signal asks a program to end and leaves it its time.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tools/end_signals.h"

namespace nord_driver::tools {
namespace {

/// 0: the signal was noted, and nothing ended.
[[noreturn]] void takeSignal(int signal) {
  const std::atomic<bool>& asked = catchEndSignals();
  const bool before = asked;
  raise(signal);
  _exit(before ? 1 : asked ? 0 : 2);
}

TEST(EndSignalsDeathTest, EachIsNotedAndEndsNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(takeSignal(signal), ::testing::ExitedWithCode(0), "") << signal;
  }
}

// As `nohup` starts it, for a session that may end.
TEST(EndSignalsDeathTest, AHangUpThatIsIgnoredStaysIgnored) {
  const auto started = [] {
    std::signal(SIGHUP, SIG_IGN);
    const std::atomic<bool>& asked = catchEndSignals();
    raise(SIGHUP);
    const bool hung_up = asked;
    raise(SIGTERM);
    _exit(hung_up ? 1 : asked ? 0 : 2);
  };
  EXPECT_EXIT(started(), ::testing::ExitedWithCode(0), "");
}

// Another one ends a program as ever: SIGQUIT is the way out of one that hangs.
TEST(EndSignalsDeathTest, OthersEndItAtOnce) {
  EXPECT_EXIT(takeSignal(SIGQUIT), ::testing::KilledBySignal(SIGQUIT), "");
}

}  // namespace
}  // namespace nord_driver::tools
