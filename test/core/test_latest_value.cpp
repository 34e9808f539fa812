#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/latest_value.h"

namespace nord_driver {
namespace {

TEST(LatestValue, GivesTheInitialValueFirst) {
  LatestValue<int> value{7};
  EXPECT_EQ(7, value.read());
}

TEST(LatestValue, GivesTheNewestAndKeepsIt) {
  LatestValue<int> value{0};
  value.write(1);
  value.write(2);
  EXPECT_EQ(2, value.read());
  EXPECT_EQ(2, value.read());
  value.write(3);
  EXPECT_EQ(3, value.read());
}

TEST(LatestValue, AReaderBesideAWriterNeverSeesATornOrAnOlderValue) {
  struct Pair {
    long a = 0, b = 0;
  };
  LatestValue<Pair> value;
  std::atomic<bool> done{false};
  std::thread writer{[&] {
    for (long i = 1; i <= 200'000; ++i) value.write({i, -i});
    done = true;
  }};
  long last = 0;
  bool torn = false, backwards = false;
  do {
    const Pair seen = value.read();
    torn = torn || seen.a != -seen.b;
    backwards = backwards || seen.a < last;
    last = seen.a;
  } while (!done);
  writer.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(backwards);
  EXPECT_EQ(200'000, value.read().a);
}

}  // namespace
}  // namespace nord_driver
