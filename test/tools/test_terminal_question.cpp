// Asking whoever sits at the terminal, while the bus goes on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "support/pty_pair.h"
#include "tools/terminal_question.h"

namespace nord_driver::tools {
namespace {

/// A pty in the place of stdin.
class TerminalQuestion : public ::testing::Test {
 protected:
  TerminalQuestion() {
    const int near = ::open(pty_.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    ::dup2(near, STDIN_FILENO);
    ::close(near);
  }
  ~TerminalQuestion() override {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  /// The answer to what is typed once the question stands and the bus has gone on three times.
  bool answer(const std::string& typed) {
    int waited = 0;
    const auto meanwhile = [&] {
      if (++waited == 3) pty_.send({typed.begin(), typed.end()});
    };
    const bool agreed = askYesOrNo("write this?", meanwhile, asked_);
    EXPECT_GE(waited, 3);
    return agreed;
  }

  const int before_ = ::dup(STDIN_FILENO);
  test::PtyPair pty_;
  std::atomic<bool> asked_{false};
};

TEST_F(TerminalQuestion, OnlyYesIsYes) {
  EXPECT_TRUE(canAsk());
  EXPECT_TRUE(answer("y\n"));
  EXPECT_TRUE(answer(" Yes\n"));
  EXPECT_FALSE(answer("\n"));
  EXPECT_FALSE(answer("n\n"));
  EXPECT_FALSE(answer("yesterday\n"));
}

TEST_F(TerminalQuestion, EndsWhenTheProgramIsToEnd) {
  int waited = 0;
  EXPECT_FALSE(askYesOrNo(
      "write this?", [&] { asked_ = ++waited == 5; }, asked_));
  EXPECT_EQ(5, waited);
}

TEST_F(TerminalQuestion, AHungUpTerminalSaysNo) {
  pty_.hangUp();
  EXPECT_FALSE(askYesOrNo(
      "write this?", [] {}, asked_));
}

}  // namespace
}  // namespace nord_driver::tools
