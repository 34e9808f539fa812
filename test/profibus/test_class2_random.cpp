// A class-2 master against a slave that answers anything at any time: each record comes to exactly one end, in time.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "profibus/class2_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr const char* kSilence = "";
constexpr std::array<const char*, 18> kAnswers{
    kSilence,
    "E5",
    "10 01 08 09 12 16",  // NR
    "10 01 08 00 09 16",  // OK
    "10 01 08 02 0B 16",  // RR
    "10 01 08 01 0A 16",  // UE
    kNotActivated,
    kGrant,
    "68 09 09 68 81 88 08 32 31 56 30 00 C8 C2 16",  // a grant that wants a longer Send_Timeout
    kAccepted,
    "68 09 09 68 81 88 08 32 30 D7 80 A9 00 73 16",  // Initiate refused
    kClass2Written,
    kClass2ReadDone,
    "68 09 09 68 81 88 08 32 30 DE 80 B5 00 86 16",  // busy
    kIdleBack,
    "68 08 08 68 81 88 08 32 30 58 01 13 DF 16",     // Abort
    "68 09 09 68 81 88 08 32 30 5F 00 65 08 40 16",  // a wrong check sum
    "55 AA 68 68",
};

class Class2AgainstAnything {
 public:
  explicit Class2AgainstAnything(std::uint32_t seed) : random_(seed) {
    times_.response_timeout = 200ms;
    master_.emplace(quietBus(), std::vector<StationAddress>{station(8)}, times_);
    master_->restart(now_);
  }

  /// Until the record has its result, or `limit` is over.
  std::size_t resultsOf(const RecordRequest& request, Duration limit) {
    EXPECT_TRUE(master_->submitRecord(0, request));
    const Instant end = now_ + limit;
    std::size_t results = 0;
    while (now_ < end && results == 0) {
      step(end);
      while (master_->pollRecord()) ++results;
    }
    return results;
  }
  /// Lets what is left come to its end.
  std::size_t resultsIn(Duration span) {
    const Instant end = now_ + span;
    std::size_t results = 0;
    while (now_ < end) {
      step(end);
      while (master_->pollRecord()) ++results;
    }
    return results;
  }

 private:
  void step(Instant end) {
    if (!master_->wantsBus(now_)) {
      now_ = std::min(end, std::max(now_ + 1ns, master_->nextDeadline().value_or(end)));
      return;
    }
    const ByteView telegram = master_->pollTransmit(now_);
    if (telegram.empty()) {
      ASSERT_TRUE(master_->nextDeadline());
      now_ = std::max(now_, *master_->nextDeadline());
      master_->handleTimeout(now_);
      return;
    }
    now_ += 10ms;
    const char* answer = kAnswers[random_() % kAnswers.size()];
    if (*answer != '\0') master_->handleBytes(fromHex(answer), now_);
  }

  std::mt19937 random_;
  Class2Times times_;
  std::optional<Class2Master> master_;
  Instant now_{1h};
};

TEST(Class2, ComesToOneEndWhateverIsAnswered) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    Class2AgainstAnything run{seed};
    for (int record = 0; record < 4; ++record) {
      ASSERT_EQ(1u, run.resultsOf(record % 2 == 0 ? writeOrder() : readAnswer(), 5s)) << "seed " << seed;
      ASSERT_EQ(0u, run.resultsIn(500ms)) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace nord_driver::profibus
