#include "link/can/make_can_link.h"
#include "sim/devicenet/dn_conversation.h"
#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

/// The same services with the drive on DeviceNet.
class Devicenet : public SimNodeTest {
 protected:
  void SetUp() override {
    set("left/unplug", true);
    call<SimAnswerDelay>("left/answer_delay", {});
    call<SimParameterChannel>("left/parameter_channel", {});
    set("left/mute", false);
    set("left/unplug", false);
    link::CanSettings settings;
    ASSERT_TRUE(ros::param::get("/nord_sim/bus/interface", settings.interface));
    can = link::makeCanLink(settings);
    ASSERT_TRUE(can->open()) << can->lastError();
    for (int i = 0; i < 2; ++i) {  // the duplicate-MAC check of scanner 0Ah
      can->send(nord_driver::frame("457#00 FF FF 01 00 00 00"));
      can->sleepUntil(can->now() + std::chrono::milliseconds{1100});
    }
    ASSERT_TRUE(comes("44E#0A 4B 03 01 03 0A", "44B#0ACB00"));
    for (const char* size : {"44C#0A 0E 05 02 07", "44C#0A 0E 05 02 08"}) ASSERT_TRUE(comes(size, "44B#0A8E0500"));
    ASSERT_TRUE(eventually([](const SimDrive& drive) { return drive.status_word == 0x0B70; }));
    ASSERT_TRUE(comes("44C#0A 10 05 02 09 10 27", "44B#0A901027"));  // 10 s
  }
  /// Repeats `request` every 500 ms until this very frame comes, for at most ten seconds.
  bool comes(const std::string& request, const std::string& answer, Duration limit = seconds(10.0)) {
    for (const Instant end = can->now() + limit; can->now() < end;) {
      can->send(nord_driver::frame(request));
      const Instant until = can->now() + std::chrono::milliseconds{500};
      link::ReceivedCanFrame received;
      while (can->waitReadable(until) && can->receive(received)) {
        if (nord_driver::text(received.frame) == answer) return true;
      }
    }
    return false;
  }
  std::unique_ptr<link::CanLink> can;
};

// Polls show in the truth, a trip in the status word; the referee watches.
TEST_F(Devicenet, FaultsAndTruth) {
  EXPECT_TRUE(comes("44D#00 7E 04 00 00", "3C9#00310B0000"));
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.in_data_exchange && drive.control_word == 0x047E; }));
  EXPECT_EQ("yes, no rule broken", trigger("referee"));
  SimTrip::Request request;
  request.number = 30;
  EXPECT_EQ("left: tripped with fault 30", call<SimTrip>("left/trip", request).message);
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return (drive.status_word & 8) != 0; }));
  EXPECT_TRUE(comes("44C#0A 0E 6B 01 00", "44B#0A8E1E00")) << "P700";
  can->send(nord_driver::frame("44E#0A 4B 03 01 31 0A"));
  EXPECT_TRUE(comes("44C#0A 0E 03 01 01", "44B#0A8E09"));
  EXPECT_THAT(trigger("referee"), testing::StartsWith("no, 1 x an allocation with choice bits that cannot be"));
}

TEST_F(Devicenet, ParametersAndSilence) {
  EXPECT_TRUE(comes("44C#0A 0E 65 01 02", "44B#0A8EC800"));
  SimParameterChannel::Request request;
  request.refuse = true;
  request.error = 1;
  request.number = 102;
  call<SimParameterChannel>("left/parameter_channel", request);
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
