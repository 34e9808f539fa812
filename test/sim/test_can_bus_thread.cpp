// The nodes in real time on a bus between processes, both ends in this process. A wait has a deadline and ends as soon
// as it can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>

#include "nord_driver/link/make_can_link.h"
#include "nord_driver/sim/can_bus_thread.h"
#include "sim/can_conversation.h"

namespace nord_driver::sim {
namespace {

SimConfig onVirtualBus() {
  SimConfig config = oneCanDrive();
  config.can->interface = "virtual:sim_test_" + std::to_string(::getpid());
  return config;
}

class Client {
 public:
  explicit Client(const std::string& interface) {
    link::CanSettings settings;
    settings.interface = interface;
    link_ = link::makeCanLink(settings);
    opened_ = link_->open();
  }
  bool opened() const { return opened_; }
  void send(const std::string& text) { link_->send(fromText(text)); }
  /// Asks again every 20 ms until this very frame comes, or five seconds are over.
  bool sees(const std::string& request, const std::string& answer) {
    for (const Instant end = link_->now() + seconds(5.0); link_->now() < end;) {
      send(request);
      const Instant until = link_->now() + std::chrono::milliseconds(20);
      link::ReceivedCanFrame received;
      while (link_->waitReadable(until) && link_->receive(received)) {
        if (inText(received.frame) == answer) return true;
      }
    }
    return false;
  }

 private:
  std::unique_ptr<link::CanLink> link_;
  bool opened_ = false;
};

// The trace of BU 0060 p. 96 once more, through sockets.
TEST(CanBusThread, ServesAVirtualBus) {
  const SimConfig config = onVirtualBus();
  CanBusThread bus{config};
  EXPECT_EQ(config.can->interface, bus.where());
  Client client{config.can->interface};
  ASSERT_TRUE(client.opened());
  EXPECT_TRUE(client.sees("732#R1", "732#7F"));
  EXPECT_TRUE(client.sees("632#4018100200000000", "5B2#4318100201000000"));
  client.send("000#0132");
  EXPECT_TRUE(client.sees("232#7E040000", "1B2#310B0000"));
  bus.withModel([](RobotSim& robot) { robot.drive(0).inverter().trip(30, false); });
  EXPECT_TRUE(client.sees("232#7E040000", "0B2#1023010000000000"));
  EXPECT_EQ("no rule broken", bus.refereeReport());
}

TEST(CanBusThread, RunsWhatTheConfigurationAsksFor) {
  const SimConfig config = onVirtualBus();
  const std::unique_ptr<RunningBus> bus = runBus(config);
  EXPECT_EQ(config.can->interface, bus->where());
  try {
    CanBusThread second{config};
    FAIL() << "two simulators on one bus";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("bus/interface: "));
  }
}

}  // namespace
}  // namespace nord_driver::sim
