#include <gtest/gtest.h>

#include "profibus/class2_wire.h"
#include "support/count_allocations.h"

namespace nord_driver::profibus {
namespace {

constexpr int kMostTelegrams = 1000;  // of one cycle, far more than there are

/// Sends broadcasts and one request of the master into the void, and hands it this answer.
void converse(DpMaster& master, Instant& now, ByteView answer) {
  for (int telegrams = 0; !master.cycleDone() && telegrams < kMostTelegrams; ++telegrams) {
    now = std::max(now, *master.nextDeadline());
    const ByteView sent = master.pollTransmit(now);
    if (sent.empty()) return master.handleTimeout(now);
    now += std::chrono::milliseconds{20};
    if (sent.size() > 4 && sent[4] == 0xFF) continue;
    return master.handleBytes(answer, now);
  }
}

// From its construction on the master takes no memory: start-up, exchange, diagnosis, retries, loss and return
// included.
TEST(NoAllocation, AfterConstruction) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  const std::vector<std::vector<std::uint8_t>> answers{fromHex(kHere8),  fromHex(kWantsPrm), fromHex("E5"),
                                                       fromHex("E5"),    fromHex(kReady),    fromHex(kInputs),
                                                       fromHex(kInputs), fromHex(kInputsDh), fromHex(kReady)};
  const std::vector<std::uint8_t> outputs = standby();
  const std::vector<std::uint8_t> noise(300, 0x68);
  DpMaster master{BusParameters::forBaudRate(BaudRate{19'200}, station(1)), {nordModule(8)}};
  Instant now{std::chrono::hours{1}};

  test::countThisThread(true);
  master.restart(now);
  for (int round = 0; round < 3; ++round) {
    for (const auto& answer : answers) {
      master.setOutputs(0, outputs);
      if (master.cycleDone()) {
        now += std::chrono::milliseconds{300};
        master.startCycle(now);
      }
      converse(master, now, answer);
    }
    master.handleBytes(noise, now);
    for (int i = 0; i < 10; ++i) {  // lost
      master.startCycle(now);
      for (int telegrams = 0; !master.cycleDone() && telegrams < kMostTelegrams; ++telegrams) {
        now = std::max(now, *master.nextDeadline());
        if (master.pollTransmit(now).empty()) master.handleTimeout(now);
      }
    }
    while (master.pollEvent()) {
    }
  }
  test::countThisThread(false);
  EXPECT_TRUE(master.cycleDone()) << "the cycle does not end";

  EXPECT_EQ(0u, test::allocations);
  EXPECT_EQ(9u, master.status(0).counters.exchanges);
  EXPECT_EQ(3u, master.status(0).counters.losses);
}

// The same of a class-2 master: connections opened, used, aborted, refused and lost.
TEST(NoAllocation, OfAClass2MasterAfterConstruction) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers have replaced malloc";
  const std::vector<std::vector<std::uint8_t>> answers{fromHex("E5"),
                                                       fromHex(kGrant),
                                                       fromHex(kAccepted),
                                                       fromHex("E5"),
                                                       fromHex(kClass2ReadDone),
                                                       fromHex("68 08 08 68 81 88 08 32 30 58 01 13 DF 16"),
                                                       fromHex(kNotActivated),
                                                       {},
                                                       {}};
  const RecordRequest request = readAnswer();
  Class2Master master{quietBus(), {station(8)}};
  Instant now{std::chrono::hours{1}};
  unsigned results = 0;

  test::countThisThread(true);
  master.restart(now);
  for (int round = 0; round < 9; ++round) {
    for (const auto& answer : answers) {
      master.submitRecord(0, request);
      for (int i = 0; i < kMostTelegrams && master.wantsBus(now); ++i) {
        if (!master.pollTransmit(now).empty()) break;
        now = std::max(now, *master.nextDeadline());
        master.handleTimeout(now);
      }
      now += std::chrono::milliseconds{3};
      if (!answer.empty()) master.handleBytes(answer, now);
      while (master.pollRecord()) ++results;
    }
  }
  master.close();
  test::countThisThread(false);

  EXPECT_EQ(0u, test::allocations);
  EXPECT_GT(results, 9u);
}

}  // namespace
}  // namespace nord_driver::profibus
