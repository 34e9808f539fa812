// The nodes in real time on a bus between processes, both ends in this process. A wait has a deadline and ends as soon
// as it can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "link/can/make_can_link.h"
#include "sim/canopen/can_bus_thread.h"
#include "sim/canopen/can_conversation.h"

namespace nord_driver::sim {
namespace {

SimConfig onVirtualBus() {
  SimConfig config = oneCanDrive();
  config.bus.as<CanBusConfig>().interface = "virtual:sim_test_" + std::to_string(::getpid());
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
  void send(const std::string& text) { link_->send(nord_driver::frame(text)); }
  /// Asks again every 20 ms until this very frame comes, or ten seconds are over.
  bool sees(const std::string& request, const std::string& answer) {
    for (const Instant end = link_->now() + kPatience; link_->now() < end;) {
      send(request);
      if (comes(answer, std::chrono::milliseconds(20))) return true;
    }
    return false;
  }
  /// Asks once, as a question that waits for its answer must be.
  bool learns(const std::string& request, const std::string& answer) {
    send(request);
    return comes(answer, kPatience);
  }

 private:
  static constexpr std::chrono::seconds kPatience{10};

  bool comes(const std::string& answer, Duration limit) {
    const Instant until = link_->now() + limit;
    link::ReceivedCanFrame received;
    while (link_->waitReadable(until) && link_->receive(received)) {
      if (nord_driver::text(received.frame) == answer) return true;
    }
    return false;
  }

  std::unique_ptr<link::CanLink> link_;
  bool opened_ = false;
};

/// A virtual bus whose time can jump, as it does for a process that the machine keeps from running.
class JumpingLink : public link::CanLink {
 public:
  explicit JumpingLink(const std::string& interface)
      : inner_(link::makeCanLink(settings(interface), link::CanRole::kOwner)) {}

  void jump(Duration span) { ahead_ = ahead_.load() + span.count(); }

  bool open() noexcept override { return inner_->open(); }
  void close() noexcept override { inner_->close(); }
  bool isOpen() const noexcept override { return inner_->isOpen(); }
  link::CanSend send(const CanFrame& frame) noexcept override { return inner_->send(frame); }
  bool receive(link::ReceivedCanFrame& received) noexcept override { return inner_->receive(received); }
  bool waitReadable(Instant until) noexcept override { return inner_->waitReadable(until - ahead()); }
  void sleepUntil(Instant when) noexcept override { inner_->sleepUntil(when - ahead()); }
  Instant now() const noexcept override { return inner_->now() + ahead(); }
  link::CanState state() const noexcept override { return inner_->state(); }
  link::CanCounters counters() const noexcept override { return inner_->counters(); }
  const std::string& lastError() const noexcept override { return inner_->lastError(); }
  const char* advice() const noexcept override { return inner_->advice(); }

 private:
  static link::CanSettings settings(const std::string& interface) {
    link::CanSettings settings;
    settings.interface = interface;
    return settings;
  }
  Duration ahead() const noexcept { return Duration{ahead_.load()}; }

  std::unique_ptr<link::CanLink> inner_;
  std::atomic<Duration::rep> ahead_{0};
};

// The trace of BU 0060 p. 96 once more, through sockets.
TEST(CanBusThread, ServesAVirtualBus) {
  const SimConfig config = onVirtualBus();
  CanBusThread bus{config};
  EXPECT_EQ(config.bus.as<CanBusConfig>().interface, bus.where());
  Client client{config.bus.as<CanBusConfig>().interface};
  ASSERT_TRUE(client.opened());
  EXPECT_TRUE(client.sees("732#R1", "732#7F"));
  EXPECT_TRUE(client.learns("632#4018100200000000", "5B2#4318100201000000"));
  client.send("000#0132");
  EXPECT_TRUE(client.sees("232#7E040000", "1B2#310B0000"));
  bus.withModel([](RobotSim& robot) { robot.drive(0).inverter().trip(30, false); });
  EXPECT_TRUE(client.sees("232#7E040000", "0B2#1023010000000000"));
  EXPECT_EQ("no rule broken", bus.refereeReport());
}

// A simulator that was kept from running for 200 ms has not sent what its master waits for: a master that takes its
// nodes for lost and looks before it commands again (0000) breaks no rule, though they are operational as before.
TEST(CanBusThread, ItsOwnStandstillIsNotTheMastersFault) {
  const SimConfig config = onVirtualBus();
  auto own_link = std::make_unique<JumpingLink>(config.bus.as<CanBusConfig>().interface);
  JumpingLink& link = *own_link;
  CanBusThread bus{config, std::move(own_link)};
  Client client{config.bus.as<CanBusConfig>().interface};
  ASSERT_TRUE(client.opened());
  ASSERT_TRUE(client.sees("732#R1", "732#7F"));
  client.send("000#0132");
  ASSERT_TRUE(client.sees("232#7E040000", "1B2#310B0000"));
  const auto rpdos = [&] { return bus.withStations([](CanStations& all) { return all.node(0).counters().rpdos; }); };
  std::uint64_t before = 0;
  bus.withStations([&](CanStations& stations) {  // it stands still as long as this takes
    before = stations.node(0).counters().rpdos;
    link.jump(std::chrono::milliseconds(200));
    for (const char* text : {"232#7E040000", "232#00000000", "232#7E040000"}) client.send(text);
  });
  for (const Instant end = link.now() + seconds(10.0); rpdos() < before + 3 && link.now() < end;)
    std::this_thread::yield();
  EXPECT_GE(rpdos(), before + 3);
  EXPECT_EQ("no rule broken", bus.refereeReport());
}

TEST(CanBusThread, RunsWhatTheConfigurationAsksFor) {
  const SimConfig config = onVirtualBus();
  const std::unique_ptr<RunningBus> bus = runBus(config);
  EXPECT_EQ(config.bus.as<CanBusConfig>().interface, bus->where());
  try {
    CanBusThread second{config};
    FAIL() << "two simulators on one bus";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("bus/interface: "));
  }
}

}  // namespace
}  // namespace nord_driver::sim
