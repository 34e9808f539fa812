// When a line of progress is drawn, and that it goes away.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/progress_bar.h"

namespace nord_driver::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class Drawn : public ::testing::Test {
 protected:
  ProgressBar bar(unsigned columns) {
    return {[this](const std::string& text) { written_ += text; }, columns};
  }
  std::string taken() {
    std::string text;
    text.swap(written_);
    return text;
  }

  std::string written_;
  const Instant start_{seconds{100}};
};

TEST_F(Drawn, OnlyAfterTwoSecondsAndNotAtEachStep) {
  ProgressBar drawn = bar(40);
  drawn.begin("reading left", 10, start_);
  drawn.advance(start_ + milliseconds{1999});
  EXPECT_EQ("", taken());
  drawn.advance(start_ + milliseconds{2000});
  EXPECT_EQ("\rreading left [###             ] 2 of 10\x1b[K", taken());
  drawn.advance(start_ + milliseconds{2100});
  EXPECT_EQ("", taken()) << "five times a second are enough";
  drawn.advance(start_ + milliseconds{2300});
  EXPECT_EQ("\rreading left [######          ] 4 of 10\x1b[K", taken());
  drawn.end();
  EXPECT_EQ("\r\x1b[K", taken());
  drawn.end();
  EXPECT_EQ("", taken());
}

TEST_F(Drawn, NeverWithoutATerminal) {
  ProgressBar drawn = bar(0);
  drawn.begin("reading left", 2, start_);
  drawn.advance(start_ + seconds{60});
  drawn.end();
  EXPECT_EQ("", taken());
}

TEST_F(Drawn, NeverWiderThanTheTerminal) {
  ProgressBar drawn = bar(12);
  drawn.begin("reading left", 2, start_);
  drawn.advance(start_ + seconds{60});
  EXPECT_EQ("\rreading lef\x1b[K", taken());
}

// More steps than were expected, or none at all.
TEST_F(Drawn, DoesNotRunOver) {
  ProgressBar drawn = bar(80);
  drawn.begin("writing", 1, start_);
  drawn.advance(start_);
  drawn.advance(start_ + seconds{3});
  EXPECT_THAT(taken(), ::testing::HasSubstr("] 1 of 1"));
  drawn.begin("writing", 0, start_);
  EXPECT_EQ("\r\x1b[K", taken());
  drawn.advance(start_ + seconds{3});
  EXPECT_THAT(taken(), ::testing::HasSubstr("] 0 of 0"));
}

}  // namespace
}  // namespace nord_driver::tools
