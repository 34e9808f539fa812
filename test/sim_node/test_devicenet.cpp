#include "sim_node/can_bus_test.h"

namespace nord_driver::sim_node {
namespace {

/// The same services with the drive on DeviceNet.
class Devicenet : public CanBusTest {
 protected:
  Devicenet() : CanBusTest(std::chrono::milliseconds{500}) {}

  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(CanBusTest::SetUp());
    for (int i = 0; i < 2; ++i) {  // the duplicate-MAC check of scanner 0Ah
      send("457#00 FF FF 01 00 00 00");
      can->sleepUntil(can->now() + std::chrono::milliseconds{1100});
    }
    ASSERT_TRUE(comes("44E#0A 4B 03 01 03 0A", "44B#0ACB00"));
    for (const char* size : {"44C#0A 0E 05 02 07", "44C#0A 0E 05 02 08"}) ASSERT_TRUE(comes(size, "44B#0A8E0500"));
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(comes("44C#0A 10 05 02 09 10 27", "44B#0A901027"));  // 10 s
  }
};

// Polls show in the truth, a trip in the status word; the referee watches.
TEST_F(Devicenet, FaultsAndTruth) {
  EXPECT_TRUE(comes("44D#00 7E 04 00 00", "3C9#00310B0000"));
  EXPECT_TRUE(isExchanging(0x047E));
  EXPECT_EQ("yes, no rule broken", trigger("referee"));
  trip();
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return (drive.status_word & 8) != 0; }));
  EXPECT_TRUE(comes("44C#0A 0E 6B 01 00", "44B#0A8E1E00")) << "P700";
  send("44E#0A 4B 03 01 31 0A");
  EXPECT_TRUE(comes("44C#0A 0E 03 01 01", "44B#0A8E09"));
  EXPECT_THAT(trigger("referee"), testing::StartsWith("no, 1 x an allocation with choice bits that cannot be"));
}

TEST_F(Devicenet, ParametersAndSilence) {
  EXPECT_TRUE(comes("44C#0A 0E 65 01 02", "44B#0A8EC800"));
  refuseP102();
  EXPECT_TRUE(comes("44C#0A 0E 65 01 02", "44B#0A940EFF"));
  set("left/mute", true);
  EXPECT_FALSE(comes("44C#0A 0E 03 01 01", "44B#0A8E09", seconds(0.4)));
  set("left/mute", false);
  EXPECT_TRUE(comes("44C#0A 0E 03 01 01", "44B#0A8E09"));
}

// The 24 V of a gateway off: it is silent, and with it both inverters; on again it checks its MAC id.
TEST_F(Devicenet, PowerModule) {
  const std::string check = "467#00E80300000000";
  ASSERT_TRUE(comes("466#0A 4B 03 01 01 0A", "463#0ACB00"));
  EXPECT_EQ("yes, lift: 24 V of its module off, the station is silent", set("lift/power_module", false));
  EXPECT_FALSE(comes("464#0A 0E 03 01 01", "463#0A8E0C", seconds(0.4)));
  EXPECT_EQ("yes, tilt: 24 V of its module on", set("tilt/power_module", true));
  EXPECT_TRUE(comes("464#0A 0E 03 01 01", check)) << "its duplicate-MAC request";
  EXPECT_EQ("no, left: has a module of its own; unplug takes the power from both", set("left/power_module", false));
}

}  // namespace
}  // namespace nord_driver::sim_node
