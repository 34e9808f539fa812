// Stops asked for while a drive is not heard: it may hear us, so their words are sent all the same, for a bounded time.
#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

class StopsWhileSilent : public DriveTest {
 protected:
  /// For how long `word` is sent, from now on, before 0000.
  Duration sentFor(Word word) {
    const Instant begin = now_;
    while (now_ - begin < seconds(2.0)) {
      const Word sent = silence();
      if (sent == 0x0000) break;
      EXPECT_EQ(word, sent);
    }
    return now_ - begin - kCycle;
  }
};

TEST_F(StopsWhileSilent, QuickStop) {
  run();
  fallSilent();
  drive_.requestQuickStop(now_);
  const Duration sent = sentFor(0x047B);
  EXPECT_GE(sent, seconds(1.0));
  EXPECT_LE(sent, seconds(1.05));
}

TEST_F(StopsWhileSilent, Coasting) {
  run();
  fallSilent();
  drive_.requestCoast(now_);
  const Duration sent = sentFor(0x047D);
  EXPECT_GE(sent, seconds(1.0));
  EXPECT_LE(sent, seconds(1.05));
}

}  // namespace
}  // namespace nord_driver::drive
