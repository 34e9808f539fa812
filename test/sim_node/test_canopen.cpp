#include "sim_node/can_bus_test.h"

namespace nord_driver::sim_node {
namespace {

/// The same services with the drive on a CAN bus.
class Canopen : public CanBusTest {
 protected:
  Canopen() : CanBusTest(std::chrono::milliseconds{50}) {}

  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(CanBusTest::SetUp());
    ASSERT_TRUE(comes("732#R1", "732#7F"));
    ASSERT_TRUE(isReady());
  }
};

// A trip shows as an emergency message, the exchange in the truth; the referee watches the CAN bus.
TEST_F(Canopen, FaultsAndTruth) {
  send("000#0132");
  EXPECT_TRUE(comes("232#7E040000", "1B2#310B0000"));
  EXPECT_TRUE(isExchanging(0x047E));
  EXPECT_EQ("yes, no rule broken", trigger("referee"));
  trip();
  EXPECT_TRUE(comes("232#7E040000", "0B2#1023010000000000"));
  send("000#0332");
  EXPECT_TRUE(comes("732#R1", "732#05"));
  EXPECT_THAT(trigger("referee"), testing::StartsWith("no, 1 x an NMT command"));
}

TEST_F(Canopen, ParametersAndSilence) {
  EXPECT_TRUE(comes("632#4066200100000000", "5B2#4B662001C8000000"));
  refuseP102();
  EXPECT_TRUE(comes("632#4066200100000000", "5B2#8066200102000106"));
  set("left/mute", true);
  EXPECT_FALSE(comes("732#R1", "732#7F", seconds(0.5)));
  set("left/mute", false);
  EXPECT_TRUE(comes("732#R1", "732#7F"));
}

// The 24 V of a gateway off: its node is silent, and with it both inverters; on again it boots up. What no source gives a
// supply of its own has none.
TEST_F(Canopen, PowerModule) {
  const std::string reads_lift = "628#4066200100000000";
  ASSERT_TRUE(comes(reads_lift, "5A8#4B662001C8000000"));
  EXPECT_EQ("yes, lift: 24 V of its module off, the station is silent", set("lift/power_module", false));
  EXPECT_FALSE(comes("728#R1", "728#7F", seconds(0.5)));
  EXPECT_FALSE(comes(reads_lift, "5A8#4B662001C8000000", seconds(0.5)));
  EXPECT_EQ("yes, tilt: 24 V of its module on", set("tilt/power_module", true));
  EXPECT_TRUE(comes("728#R1", "728#00")) << "the boot-up message";
  EXPECT_TRUE(comes(reads_lift, "5A8#4B662001C8000000"));
  EXPECT_EQ("no, left: has a module of its own; unplug takes the power from both", set("left/power_module", false));
  EXPECT_TRUE(comes("732#R1", "732#7F"));
}

}  // namespace
}  // namespace nord_driver::sim_node
