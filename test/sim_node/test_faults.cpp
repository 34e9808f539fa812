#include <nord_driver/SimTrip.h>
#include <nord_driver/SimWarn.h>

#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

class Faults : public SimNodeTest {
 protected:
  static SimTrip::Response trip(std::uint16_t number, bool cause_stays) {
    SimTrip::Request request;
    request.number = number;
    request.cause_stays = cause_stays;
    return call<SimTrip>("left/trip", request);
  }
};

// A fault whose cause stays cannot be acknowledged before clear_cause, neither over the bus nor at the device.
TEST_F(Faults, StandWithTheirCause) {
  bus->startUp();
  EXPECT_EQ("left: tripped with fault 21", trip(21, true).message);
  EXPECT_EQ("0B 38 00 00", bus->pzdUntil("047E 0000", "0B 38 00 00"));
  bus->exchange("66A4 0000 0000 0000", "047E 0000");
  EXPECT_EQ("46 A4 00 00 00 00 00 15", bus->exchange("66A4 0000 0000 0000", "047E 0000").substr(0, 23));  // P700[-01]
  bus->pzd("04FE 0000");
  EXPECT_EQ("0B 38 00 00", bus->pzd("047E 0000"));
  EXPECT_EQ("no, left: no fault, or its cause stands", trigger("left/acknowledge"));
  EXPECT_EQ("yes, left: the cause is gone, the fault waits for its acknowledgement", trigger("left/clear_cause"));
  EXPECT_EQ("0B 38 00 00", bus->pzd("047E 0000"));
  bus->pzd("04FE 0000");
  EXPECT_EQ("0B 31 00 00", bus->pzdUntil("047E 0000", "0B 31 00 00"));
}

// A fault without a standing cause is acknowledged at the device, too.
TEST_F(Faults, AreAcknowledgedAtTheDevice) {
  trip(102, false);
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.fault_number == 102; }));
  EXPECT_EQ("yes, left: acknowledged at the device", trigger("left/acknowledge"));
  EXPECT_EQ(0, truth().fault_number);
}

TEST_F(Faults, NeedANumberAndMains) {
  EXPECT_EQ("left: number is 0; expected a fault number as P700 shows it, 102 for E10.2", trip(0, false).message);
  set("left/power_inverter", false);
  EXPECT_EQ("left: off, cannot trip with 21", trip(21, false).message);
  EXPECT_FALSE(trip(21, false).success);
}

// A warning is bit 7 of the status word, as long as it stands.
TEST_F(Faults, WarningsComeAndGo) {
  SimWarn::Request request;
  request.number = 21;
  EXPECT_EQ("left: warns with 21", call<SimWarn>("left/warn", request).message);
  EXPECT_EQ(0x0BF0, truth().status_word);
  EXPECT_EQ("left: no warning", call<SimWarn>("left/warn", {}).message);
  EXPECT_EQ(0x0B70, truth().status_word);
}

}  // namespace
}  // namespace nord_driver::sim_node
