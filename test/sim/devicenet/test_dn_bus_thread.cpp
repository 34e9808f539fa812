// The modules in real time on a virtual bus.
#include <gtest/gtest.h>

#include "link/can/make_can_link.h"
#include "sim/bus_kind.h"
#include "sim/devicenet/dn_bus_thread.h"
#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

TEST(DnBusThread, IsRunByItsTransport) {
  SimConfig config = dnGateway();
  config.bus.as<DnBusConfig>().interface = "virtual:dn_thread";
  const std::unique_ptr<RunningBus> bus = runBus(config);
  EXPECT_EQ("virtual:dn_thread", bus->where());
  link::CanSettings settings;
  settings.interface = "virtual:dn_thread";
  const std::unique_ptr<link::CanLink> link = link::makeCanLink(settings, link::CanRole::kMember);
  ASSERT_TRUE(link->open()) << link->lastError();
  link::ReceivedCanFrame received;
  const Instant deadline = link->now() + std::chrono::seconds(10);
  std::string heard;
  while (heard.empty() && link->now() < deadline) {
    if (link->waitReadable(deadline) && link->receive(received)) heard = nord_driver::text(received.frame);
  }
  EXPECT_EQ("44F#", heard.substr(0, 4)) << "its duplicate-MAC request";
  EXPECT_EQ("no rule broken", bus->refereeReport());
  EXPECT_EQ(1u, bus->withModel([](RobotSim& robot) { return robot.modules().size(); }));
}

}  // namespace
}  // namespace nord_driver::sim
