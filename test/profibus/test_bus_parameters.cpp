#include <gtest/gtest.h>

#include <stdexcept>

#include "profibus/bus_parameters.h"
#include "profibus/frame_count.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

const StationAddress kMaster = *StationAddress::from(1);

TEST(StationAddress, Is0To126) {
  EXPECT_EQ(0, StationAddress::from(0)->value());
  EXPECT_EQ(126, StationAddress::from(126)->value());
  EXPECT_FALSE(StationAddress::from(-1));
  EXPECT_FALSE(StationAddress::from(127));
  EXPECT_TRUE(StationAddress{}.isUnnamed());
}

// The table of the usual master cards, in bit times.
TEST(BusParameters, OfTheStandardRates) {
  struct {
    std::uint32_t baud, slot, max_tsdr, tid1, tid2;
    int retries;
  } const kRows[] = {
      {9'600, 100, 60, 37, 60, 1},         {19'200, 100, 60, 37, 60, 1},      {45'450, 640, 400, 225, 400, 1},
      {93'750, 100, 60, 37, 60, 1},        {187'500, 100, 60, 37, 60, 1},     {500'000, 200, 100, 37, 100, 1},
      {1'500'000, 300, 150, 37, 150, 1},   {3'000'000, 400, 250, 46, 250, 2}, {6'000'000, 600, 450, 57, 450, 3},
      {12'000'000, 1000, 800, 76, 800, 4},
  };
  for (const auto& row : kRows) {
    const BusParameters bus = BusParameters::forBaudRate(BaudRate{row.baud}, kMaster);
    EXPECT_NO_THROW(bus.validate()) << row.baud;
    EXPECT_EQ(row.slot, bus.slot_bits) << row.baud;
    EXPECT_EQ(row.max_tsdr, bus.max_tsdr_bits) << row.baud;
    EXPECT_EQ(row.tid1, bus.idleBits()) << row.baud;
    EXPECT_EQ(row.tid2, bus.broadcastIdleBits()) << row.baud;
    EXPECT_EQ(row.retries, bus.max_retries) << row.baud;
    EXPECT_EQ(11u, bus.min_tsdr_bits);
  }
}

// 37 bit times at 500 kbit/s are 74 us, the slot of 200 bit times 400 us.
TEST(BusParameters, BecomeTimeInOnePlace) {
  BusParameters bus = BusParameters::forBaudRate(BaudRate{500'000}, kMaster);
  EXPECT_EQ(74us, bus.idleTime());
  EXPECT_EQ(200us, bus.broadcastIdleTime());
  EXPECT_EQ(400us, bus.slotTime());
  bus.slot_time = 8ms;
  EXPECT_EQ(8ms, bus.slotTime());
}

TEST(BusParameters, RefuseARateThatIsNone) {
  try {
    BusParameters::forBaudRate(BaudRate{115'200}, kMaster);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(0u, std::string{error.what()}.find("115200 bit/s is no PROFIBUS rate"));
  }
}

TEST(BusParameters, AreCheckedAsAWhole) {
  const auto refused = [](auto&& change) {
    BusParameters bus = BusParameters::forBaudRate(BaudRate{19'200}, kMaster);
    bus.validate();
    change(bus);
    try {
      bus.validate();
      return false;
    } catch (const std::invalid_argument&) {
      return true;
    }
  };
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.master = StationAddress{}; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.slot_bits = 74; }));
  EXPECT_FALSE(refused([](BusParameters& bus) { bus.slot_bits = 75; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.slot_bits = 16'384; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.slot_time = 3ms; }));  // 75 bit times are 3.9 ms
  EXPECT_FALSE(refused([](BusParameters& bus) { bus.slot_time = 4ms; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.slot_time = 1001ms; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.min_tsdr_bits = 10; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.max_retries = 16; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.probe_interval = Duration::zero(); }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.operate_interval = Duration{-1}; }));
  EXPECT_TRUE(refused([](BusParameters& bus) { bus.baud = BaudRate{0}; }));
}

// FC 6D first, then 5D and 7D in turns, 6D again after a reset.
TEST(FrameCount, BeginsWithFcvClearAndThenToggles) {
  FrameCount count;
  EXPECT_EQ(0x20, count.bits());
  EXPECT_EQ(0x20, count.bits());
  count.answered();
  EXPECT_EQ(0x10, count.bits());
  count.answered();
  EXPECT_EQ(0x30, count.bits());
  count.answered();
  EXPECT_EQ(0x10, count.bits());
  count.reset();
  EXPECT_EQ(0x20, count.bits());
  count.answered();
  EXPECT_EQ(0x10, count.bits());
}

}  // namespace
}  // namespace nord_driver::profibus
