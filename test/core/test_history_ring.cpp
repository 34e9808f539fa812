#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "nord_driver/core/history_ring.h"

namespace nord_driver {
namespace {

// Records are numbered from 0; before they come there is nothing to read.
TEST(HistoryRing, KeepsWhatWasPushed) {
  HistoryRing<int> ring{3};
  EXPECT_EQ(0u, ring.pushed());
  EXPECT_FALSE(ring.read(0));
  ring.push(10);
  ring.push(11);
  EXPECT_EQ(2u, ring.pushed());
  EXPECT_EQ(0u, ring.oldest());
  EXPECT_EQ(10, ring.read(0));
  EXPECT_EQ(11, ring.read(1));
  EXPECT_FALSE(ring.read(2));
}

// A full ring overwrites its oldest record, and a number stands for its own record only.
TEST(HistoryRing, OverwritesTheOldest) {
  HistoryRing<int> ring{3};
  for (int i = 0; i < 7; ++i) ring.push(10 + i);
  EXPECT_EQ(7u, ring.pushed());
  EXPECT_EQ(4u, ring.oldest());
  EXPECT_FALSE(ring.read(3));
  EXPECT_EQ(14, ring.read(4));
  EXPECT_EQ(16, ring.read(6));
  EXPECT_FALSE(ring.read(7));
}

// Copying beside a writer that laps the reader all the time: a record is whole and the one asked for, or it is absent.
TEST(HistoryRing, AReaderBesideAWriterNeverSeesATornRecord) {
  using Record = std::array<std::uint64_t, 33>;
  constexpr std::uint64_t kRecords = 300'000;
  HistoryRing<Record> ring{8};
  std::atomic<bool> go{false}, done{false};
  std::thread writer{[&] {
    while (!go) std::this_thread::yield();
    Record record;
    for (std::uint64_t i = 0; i < kRecords; ++i) {
      record.fill(i);
      ring.push(record);
    }
    done = true;
  }};
  std::uint64_t whole = 0, absent = 0, wrong = 0;
  go = true;
  bool last = false;
  do {
    last = done;  // one more pass when the writer is ready: a loaded machine may give us no turn beside it
    const std::uint64_t end = ring.pushed();
    for (std::uint64_t number = ring.oldest(); number < end; ++number) {
      const auto record = ring.read(number);
      if (!record) {
        ++absent;
        continue;
      }
      ++whole;
      for (const std::uint64_t word : *record) wrong += word != number ? 1 : 0;
    }
  } while (!last);
  writer.join();
  EXPECT_EQ(0u, wrong);
  EXPECT_GT(whole, 0u);
  EXPECT_EQ(kRecords, ring.pushed());
  for (std::uint64_t number = ring.oldest(); number < kRecords; ++number) EXPECT_TRUE(ring.read(number));
  RecordProperty("absent", static_cast<int>(absent));
}

}  // namespace
}  // namespace nord_driver
