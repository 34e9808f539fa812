#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "profibus/nord_wire.h"

namespace {

bool counting = false;
std::size_t allocations = 0;

void* allocate(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc{};
}

}  // namespace

// The whole test program runs on these; they count only where a test asks for it.
void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace nord_driver::profibus {
namespace {

/// Sends broadcasts and one request of the master into the void, and hands it this answer.
void converse(DpMaster& master, Instant& now, ByteView answer) {
  while (!master.cycleDone()) {
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
  const std::vector<std::vector<std::uint8_t>> answers{fromHex(kHere8),  fromHex(kWantsPrm), fromHex("E5"),
                                                       fromHex("E5"),    fromHex(kReady),    fromHex(kInputs),
                                                       fromHex(kInputs), fromHex(kInputsDh), fromHex(kReady)};
  const std::vector<std::uint8_t> outputs = standby();
  const std::vector<std::uint8_t> noise(300, 0x68);
  DpMaster master{BusParameters::forBaudRate(BaudRate{19'200}, station(1)), {nordModule(8)}};
  Instant now{std::chrono::hours{1}};

  counting = true;
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
      while (!master.cycleDone()) {
        now = std::max(now, *master.nextDeadline());
        if (master.pollTransmit(now).empty()) master.handleTimeout(now);
      }
    }
    while (master.pollEvent()) {
    }
  }
  counting = false;

  EXPECT_EQ(0u, allocations);
  EXPECT_EQ(9u, master.status(0).counters.exchanges);
  EXPECT_EQ(3u, master.status(0).counters.losses);
}

}  // namespace
}  // namespace nord_driver::profibus
