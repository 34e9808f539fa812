#include "link/can/make_can_link.h"
#include "sim/canopen/can_conversation.h"
#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

/// The same services with the drive on a CAN bus.
class Canopen : public SimNodeTest {
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
    ASSERT_TRUE(comes("732#R1", "732#7F"));
    ASSERT_TRUE(eventually([](const SimDrive& drive) { return drive.status_word == 0x0B70; }));
  }
  /// Repeats `request` every 50 ms until this very frame comes, for at most ten seconds.
  bool comes(const std::string& request, const std::string& answer, Duration limit = seconds(10.0)) {
    for (const Instant end = can->now() + limit; can->now() < end;) {
      can->send(nord_driver::frame(request));
      const Instant until = can->now() + std::chrono::milliseconds{50};
      link::ReceivedCanFrame received;
      while (can->waitReadable(until) && can->receive(received)) {
        if (nord_driver::text(received.frame) == answer) return true;
      }
    }
    return false;
  }
  std::unique_ptr<link::CanLink> can;
};

// A trip shows as an emergency message, the exchange in the truth; the referee watches the CAN bus.
TEST_F(Canopen, FaultsAndTruth) {
  can->send(nord_driver::frame("000#0132"));
  EXPECT_TRUE(comes("232#7E040000", "1B2#310B0000"));
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.in_data_exchange && drive.control_word == 0x047E; }));
  EXPECT_EQ("yes, no rule broken", trigger("referee"));
  SimTrip::Request request;
  request.number = 30;
  EXPECT_EQ("left: tripped with fault 30", call<SimTrip>("left/trip", request).message);
  EXPECT_TRUE(comes("232#7E040000", "0B2#1023010000000000"));
  can->send(nord_driver::frame("000#0332"));
  EXPECT_TRUE(comes("732#R1", "732#05"));
  EXPECT_THAT(trigger("referee"), testing::StartsWith("no, 1 x an NMT command"));
}

TEST_F(Canopen, ParametersAndSilence) {
  EXPECT_TRUE(comes("632#4066200100000000", "5B2#4B662001C8000000"));
  SimParameterChannel::Request request;
  request.refuse = true;
  request.error = 1;
  request.number = 102;
  call<SimParameterChannel>("left/parameter_channel", request);
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
