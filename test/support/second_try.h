// A second try of what a machine that stood still has spoilt, and of nothing else.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "support/machine_watch.h"
#include "support/standstill.h"

namespace nord_driver::test {

/// The test's property in the file of results, which scripts/count_results.py adds up.
constexpr const char* kSecondTriesProperty = "second_tries";
constexpr int kMostTries = 3;

/// Tries until `isGood()` holds, at most three times. Between two tries, and only there, `prepare()` is called. A try
/// is repeated only when the watch that began with it, made by `startWatch()`, has measured a hold-up longer than
/// `excuse` and no assertion has failed; `tell(hold_up)` is told so. Otherwise the result stands.
template <typename Watch, typename Try, typename Good, typename Prepare, typename Tell>
void tryAgain(std::chrono::duration<double> excuse, const Watch& startWatch, const Try& attempt, const Good& isGood,
              const Prepare& prepare, const Tell& tell) {
  for (int tries = 1;; ++tries) {
    const auto watch = startWatch();
    attempt();
    if (isGood() || tries == kMostTries || ::testing::Test::HasFailure()) return;
    const HoldUp seen = watch->longest();
    if (seen.length <= excuse) return;
    tell(seen);
    prepare();
    if (::testing::Test::HasFailure()) return;
  }
}

/// Prints a second try and counts it among those of this test.
inline void tellSecondTry(const HoldUp& seen) {
  std::fprintf(stderr, "the machine stood still for %.3f s%s%s%s: tried again\n", seen.length.count(),
               seen.of.empty() ? "" : " (", seen.of.c_str(), seen.of.empty() ? "" : ")");
  static const ::testing::TestInfo* counted = nullptr;
  static int count = 0;
  const ::testing::TestInfo* const now = ::testing::UnitTest::GetInstance()->current_test_info();
  count = now == counted ? count + 1 : 1;
  counted = now;
  ::testing::Test::RecordProperty(kSecondTriesProperty, count);
}

/// The same with the watch of this machine. `excuse` is how long a hold-up must be to spoil a try at all: shorter ones
/// are no reason for what went wrong, and the first result stands, as it does where nothing was measured.
template <typename Try, typename Good, typename Prepare>
void tryAgainOnlyIfStoodStill(std::chrono::duration<double> excuse, const Try& attempt, const Good& isGood,
                              const Prepare& prepare) {
  tryAgain(
      excuse, [] { return std::make_unique<MachineWatch>(); }, attempt, isGood, prepare, tellSecondTry);
}
template <typename Try, typename Good>
void tryAgainOnlyIfStoodStill(std::chrono::duration<double> excuse, const Try& attempt, const Good& isGood) {
  tryAgainOnlyIfStoodStill(excuse, attempt, isGood, [] {});
}

}  // namespace nord_driver::test
