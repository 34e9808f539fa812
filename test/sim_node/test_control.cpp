#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

class Control : public SimNodeTest {};

// Status bit 9 says who controls; a standing 047F acts at once when the bus is back.
TEST_F(Control, LocalControl) {
  bus->startUp();
  bus->pzdUntil("047E 0000", "0B 31 00 00");
  EXPECT_EQ("0B 37 20 00", bus->pzdUntil("047F 2000", "0B 37 20 00"));
  EXPECT_EQ("yes, left: controlled by its terminals", set("left/local_control", true));
  EXPECT_EQ("09 31 00 00", bus->pzdUntil("047F 2000", "09 31 00 00"));
  EXPECT_EQ("yes, left: controlled by the bus", set("left/local_control", false));
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.operation_enabled && drive.frequency > 1.0; }));
}

// Terminals turn the wheel under local control, and stop it whoever controls. An enable that stood before is none: the
// drive is switched on from "ready" only.
TEST_F(Control, Terminals) {
  SimTerminals::Request request;
  request.enable = true;
  request.frequency = -10.0;
  EXPECT_EQ("left: terminals say enable with -10 Hz", call<SimTerminals>("left/terminals", request).message);
  set("left/local_control", true);
  EXPECT_EQ(0x0970, truth().status_word);
  call<SimTerminals>("left/terminals", {});
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.status_word == 0x0931; }));
  call<SimTerminals>("left/terminals", request);
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.frequency == -10.0; }));
  request.coast = true;
  request.quick_stop = true;
  EXPECT_EQ("left: terminals say enable with -10 Hz, disable voltage, quick stop",
            call<SimTerminals>("left/terminals", request).message);
  EXPECT_FALSE(truth().operation_enabled);
  EXPECT_EQ("left: terminals say OFF1", call<SimTerminals>("left/terminals", {}).message);

  request.frequency = 401.0;
  const auto refused = call<SimTerminals>("left/terminals", request);
  EXPECT_FALSE(refused.success);
  EXPECT_EQ("left: frequency is 401; expected -400 to 400 Hz", refused.message);
}

}  // namespace
}  // namespace nord_driver::sim_node
