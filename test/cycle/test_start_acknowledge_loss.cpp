// acknowledge_at_start and a drive that falls silent again before its fault is acknowledged: what it comes back with may
// have come under this node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::Contains;

class StartAcknowledgeAfterALoss : public ::testing::Test, protected CycleBench {
 protected:
  StartAcknowledgeAfterALoss() : CycleBench{acknowledging(), true} {}
  static CycleConfig acknowledging() {
    CycleConfig config = CycleBench::config();
    config.acknowledge_bus_timeouts = true;
    return config;
  }
  void trip(DriveIndex drive, std::uint16_t number) {
    transport.inverters[drive].fault = true;
    transport.of_drive[drive][700] = number;
  }
  bool latched(DriveIndex drive) { return snapshot().drives[drive].fault_latched; }
};

class StartAcknowledgeAfterALossBack : public StartAcknowledgeAfterALoss,
                                       public ::testing::WithParamInterface<std::uint16_t> {};

// Its fault was met and read, and the other wheel is absent. Back an hour later its fault is not the one that was met, be
// it of the same number; and auto_enable does not follow.
TEST_P(StartAcknowledgeAfterALossBack, TheFaultStays) {
  trip(kLeft, 102);
  transport.inverters[kRight].silent = true;
  run(1000);
  transport.inverters[kLeft].silent = true;
  run(100);
  EXPECT_THAT(events(), Contains("warning: drive left: its fault is not acknowledged at start: it fell silent before "
                                 "that could be done"));
  trip(kLeft, GetParam());
  transport.inverters[kLeft].silent = transport.inverters[kRight].silent = false;
  run(1500);
  EXPECT_TRUE(latched(kLeft));
  EXPECT_TRUE(transport.inverters[kLeft].fault);
  EXPECT_FALSE(snapshot().base.enabled);
}

INSTANTIATE_TEST_SUITE_P(WithE10, StartAcknowledgeAfterALossBack, ::testing::Values(102, 108));

// Lost before its number was read it counts as not met yet, but for as long only as a number is awaited.
TEST_F(StartAcknowledgeAfterALoss, ADriveThatStaysAwayIsNotMetAnew) {
  transport.inverters[kLift].fault = true;  // P700 is refused
  run(500);
  transport.inverters[kLift].silent = true;
  run(1100);
  EXPECT_THAT(events(),
              Contains("warning: drive lift: its fault is not acknowledged at start: it fell silent before its "
                       "number (P700) was read"));
  trip(kLift, 102);
  transport.inverters[kLift].silent = false;
  run(1000);
  EXPECT_TRUE(latched(kLift));
  EXPECT_FALSE(snapshot().base.enabled);
}

}  // namespace
}  // namespace nord_driver::cycle
