// The simulator node with its drives on a CAN bus: the bus as somebody else on it sees it.
#pragma once

#include <memory>
#include <string>

#include "link/can/make_can_link.h"
#include "sim_node/sim_node_fixture.h"
#include "support/can_text.h"

namespace nord_driver::sim_node {

class CanBusTest : public SimNodeTest {
 protected:
  /// `pause`: how long an answer is waited for before the question is repeated.
  explicit CanBusTest(Duration pause) : pause_(pause) {}

  /// The drive "left" is freshly plugged in, and nothing is wrong with it.
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
  }
  void send(const std::string& candump) { can->send(nord_driver::frame(candump)); }
  /// Repeats `request` until this very frame comes, for at most ten seconds.
  bool comes(const std::string& request, const std::string& answer, Duration limit = seconds(10.0)) {
    for (const Instant end = can->now() + limit; can->now() < end;) {
      send(request);
      const Instant until = can->now() + pause_;
      link::ReceivedCanFrame received;
      while (can->waitReadable(until) && can->receive(received)) {
        if (nord_driver::text(received.frame) == answer) return true;
      }
    }
    return false;
  }
  /// The drive "left" sees `word` as its control word in data exchange.
  static bool isExchanging(std::uint16_t word) {
    return eventually([=](const SimDrive& drive) { return drive.in_data_exchange && drive.control_word == word; });
  }
  static bool isReady() {
    return eventually([](const SimDrive& drive) { return drive.status_word == 0x0B70; });
  }
  /// Fault 30 in the drive "left".
  static void trip() {
    SimTrip::Request request;
    request.number = 30;
    EXPECT_EQ("left: tripped with fault 30", call<SimTrip>("left/trip", request).message);
  }
  /// The drive "left" answers that P102 does not exist.
  static void refuseP102() {
    SimParameterChannel::Request request;
    request.refuse = true;
    request.error = 1;
    request.number = 102;
    call<SimParameterChannel>("left/parameter_channel", request);
  }

  std::unique_ptr<link::CanLink> can;

 private:
  Duration pause_;
};

}  // namespace nord_driver::sim_node
