// The pauses between attempts to connect, by a clock of the test's.
#include <gtest/gtest.h>

#include <vector>

#include "link/modbus/backoff.h"

namespace nord_driver::link::test {
namespace {

using std::chrono::milliseconds;

// As bus/gateway has it: 50 ms, doubled, never longer than 500 ms.
TEST(Backoff, PausesDoubleUpToTheLongestAndBeginAnew) {
  Backoff backoff{milliseconds{50}, milliseconds{500}};
  Instant now{std::chrono::hours{1}};
  std::vector<long> pauses;
  for (int i = 0; i < 6; ++i) {
    const Instant again = backoff.failed(now);
    pauses.push_back(std::chrono::duration_cast<milliseconds>(again - now).count());
    now = again + milliseconds{7};  // the attempt itself
  }
  EXPECT_EQ((std::vector<long>{50, 100, 200, 400, 500, 500}), pauses);
  backoff.succeeded();
  EXPECT_EQ(now + milliseconds{50}, backoff.failed(now));
}

// However long a gateway is away: 10 s of it are 23 attempts.
TEST(Backoff, AMissingServerIsAskedTwiceASecond) {
  Backoff backoff{milliseconds{50}, milliseconds{500}};
  const Instant begin{std::chrono::hours{1}};
  int attempts = 0;
  for (Instant now = begin; now < begin + std::chrono::seconds{10}; now = backoff.failed(now)) ++attempts;
  EXPECT_EQ(23, attempts);
}

}  // namespace
}  // namespace nord_driver::link::test
