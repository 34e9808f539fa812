// The CANopen transport asks its interface no more than it must: what it has counted is a question to the kernel. Drives
// behind one SDO server have it in turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "sim/canopen/simulated_can_bus.h"
#include "transport/canopen/canopen.h"
#include "transport/canopen/canopen_settings.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class AskedCanBus final : public sim::SimulatedCanBus {
 public:
  using sim::SimulatedCanBus::SimulatedCanBus;
  link::CanCounters counters() const noexcept override {
    ++asked_;
    return sim::SimulatedCanBus::counters();
  }
  unsigned asked() const noexcept { return asked_; }

 private:
  mutable unsigned asked_ = 0;
};

/// Two drives a hundred times a second, and the counters copied in each cycle, as the driver does.
class OnACanopenBus : public ::testing::Test {
 protected:
  void begin() { transport_.configure(settings_.bus, settings_.drives, 100.0); }
  void run(Duration span) {
    const Instant end = transport_.now() + span;
    while (transport_.now() < end) {
      const Instant start = transport_.now();
      transport_.exchange(outputs_, inputs_);
      counters_ = transport_.counters();
      transport_.sleepUntil(start + milliseconds{10});
    }
  }
  static sim::SimConfig simConfig() {
    sim::SimConfig config;
    config.bus = sim::CanBusConfig{};
    for (std::uint8_t i = 0; i < 2; ++i) {
      sim::DriveConfig drive;
      drive.name = i == 0 ? "drive0" : "drive1";
      drive.address = static_cast<std::uint8_t>(3 + i);
      drive.bus = sim::CanDriveConfig{};
      config.drives.push_back(drive);
    }
    return config;
  }

  test::CanopenSettings settings_;
  AskedCanBus* bus_ = nullptr;
  CanopenTransport transport_{[this](const link::CanSettings&) {
    auto bus = std::make_unique<AskedCanBus>(simConfig());
    bus_ = bus.get();
    return bus;
  }};
  std::vector<profile::ProcessOutput> outputs_{2};
  std::vector<DriveExchange> inputs_{2};
  BusCounters counters_;
};

class OnAnAskedBus : public OnACanopenBus {
 protected:
  OnAnAskedBus() {
    begin();
    run(seconds{3});
  }
};

// On SocketCAN each question is a system call: a few in a second, however short the cycle is.
TEST_F(OnAnAskedBus, WhatTheInterfaceHasCountedIsNotAskedForInEachCycle) {
  ASSERT_TRUE(inputs_[0].inverter_answers && inputs_[1].inverter_answers);
  const unsigned before = bus_->asked();
  run(seconds{10});
  EXPECT_GE(bus_->asked() - before, 10u);
  EXPECT_LE(bus_->asked() - before, 20u);
}

// They are told within a second all the same, each time and by their number.
TEST_F(OnAnAskedBus, LostFramesAreToldWithinASecond) {
  while (transport_.pollEvent()) {
  }
  for (const unsigned all : {1u, 2u, 3u}) {
    bus_->overflow(1);
    run(seconds{1});
    EXPECT_EQ(all, counters_.value(bus_counter::kOverruns));
    const auto told = transport_.pollEvent();
    ASSERT_TRUE(told);
    EXPECT_EQ("can0: received frames were lost, " + std::to_string(all) +
                  " since the start: this computer took them too late",
              told->text.str());
    EXPECT_FALSE(transport_.pollEvent());
  }
}

// What was counted stays counted when the interface is gone.
TEST_F(OnAnAskedBus, TheLastOnesBeforeItGoesAreCounted) {
  bus_->overflow(2);
  run(milliseconds{100});
  bus_->setInterfacePresent(false);
  run(seconds{1});
  EXPECT_EQ(2u, counters_.value(bus_counter::kOverruns));
}

// A node that answers has power and the right bit rate: why it is refused is told, of each node once, whatever the others do.
TEST_F(OnACanopenBus, NodesThatAreRefusedAreNoMatterOfWires) {
  for (const std::size_t drive : {0u, 1u}) settings_.drive(drive).set("vendor_id", 0x999);
  begin();
  std::vector<std::string> told;
  for (int i = 0; i < 20; ++i) {
    run(seconds{1});
    while (const auto event = transport_.pollEvent()) told.push_back(event->text.str());
    EXPECT_TRUE(transport_.connected()) << i;
    EXPECT_STREQ("", transport_.busText().c_str()) << "the drives' notes are shown then";
  }
  const std::string note = transport_.note(0).text;
  EXPECT_NE(std::string::npos, note.find("vendor id")) << note;
  EXPECT_EQ((std::vector<std::string>{"node 3: " + note, "node 4: " + std::string{transport_.note(1).text}}), told);
}

// On its way to operation a node answers already.
TEST_F(OnACanopenBus, ANodeThatIsBeingSetUpAnswers) {
  begin();
  int booting = 0;
  for (int i = 0; i < 2000 && !inputs_[0].inverter_answers; ++i) {
    run(milliseconds{1});
    if (std::string{transport_.note(0).text} != "booting") continue;
    ++booting;
    EXPECT_TRUE(transport_.connected());
    EXPECT_STREQ("", transport_.busText().c_str());
  }
  EXPECT_GT(booting, 0);
  EXPECT_TRUE(inputs_[0].inverter_answers);
}

TEST_F(OnACanopenBus, NobodyAnswers) {
  settings_.drive(0).set("address", 50);
  settings_.drive(1).set("address", 51);
  begin();
  run(seconds{5});
  EXPECT_FALSE(transport_.connected());
  EXPECT_STREQ(
      "can0 is open, but no node answers (asked: 50, 51): power, address and bit rate (P515, P514, or the module's "
      "switches), termination? nord_param scan finds who is there",
      transport_.busText().c_str());
}

/// `gateways` SK CU4-CAO with two inverters each, whose parameters one SDO server has (index_offset).
class BehindOneServer {
 public:
  explicit BehindOneServer(std::size_t gateways) : outputs_(2 * gateways), inputs_(2 * gateways) {
    test::CanopenSettings settings{2 * gateways};
    for (std::size_t i = 0; i < settings.drives.size(); ++i) {
      settings.drive(i).set("address", addressOf(i)).set("connection", "gateway").set("inverter", inverterOf(i));
      settings.drive(i).set("parameter_servers", "index_offset");
    }
    transport_.configure(settings.bus, settings.drives, 100.0);
    for (int i = 0; i < 300; ++i) cycle();
  }
  /// How often each drive was answered in `cycles`; those of `busy` always have as many requests waiting as there is room for.
  std::vector<int> answers(const std::vector<DriveIndex>& busy, int cycles) {
    std::vector<int> count(inputs_.size(), 0);
    for (const DriveIndex drive : busy) {
      for (std::size_t i = 0; i < CanopenParameters::kCapacity; ++i) ask(drive);
    }
    for (int i = 0; i < cycles; ++i) {
      cycle();
      while (const auto result = transport_.pollResult()) {
        ++count[result->id];
        ask(static_cast<DriveIndex>(result->id));
      }
    }
    return count;
  }
  bool allAnswer() const {
    return std::all_of(inputs_.begin(), inputs_.end(),
                       [](const DriveExchange& input) { return input.inverter_answers; });
  }

 private:
  static int addressOf(std::size_t drive) { return static_cast<int>(10 + drive / 2); }
  static int inverterOf(std::size_t drive) { return static_cast<int>(1 + drive % 2); }
  void ask(DriveIndex drive) {
    profile::ParameterRequest request;
    request.id = static_cast<std::uint32_t>(drive);
    request.number = 102;
    request.parameter_set = 1;
    request.shape = profile::ParameterShape::kPerSet;
    EXPECT_TRUE(transport_.submit(drive, request));
  }
  void cycle() {
    const Instant start = transport_.now();
    transport_.exchange(outputs_, inputs_);
    transport_.sleepUntil(start + milliseconds{10});
  }
  sim::SimConfig simConfig() const {
    sim::SimConfig config;
    config.bus = sim::CanBusConfig{};
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      sim::DriveConfig drive;
      drive.name = "drive" + std::to_string(i);
      drive.address = static_cast<std::uint8_t>(addressOf(i));
      drive.place = static_cast<unsigned>(inverterOf(i));
      drive.bus = sim::CanDriveConfig{};
      drive.bus.as<sim::CanDriveConfig>().connection = sim::CanConnection::kGateway;
      config.drives.push_back(drive);
    }
    return config;
  }

  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_;
  CanopenTransport transport_{
      [this](const link::CanSettings&) { return std::make_unique<sim::SimulatedCanBus>(simConfig()); }};
};

// One that has something to ask all the time leaves the others their turn.
TEST(CanopenTurns, InvertersBehindOneServerAreServedInTurn) {
  BehindOneServer robot{1};
  ASSERT_TRUE(robot.allAnswer());
  const std::vector<int> count = robot.answers({0, 1}, 100);
  EXPECT_GE(count[0], 10);
  EXPECT_NEAR(count[0], count[1], 1);
}

// A turn at one server is none at another: they do not take each other's, however they fall out of step.
TEST(CanopenTurns, EachServerHasItsOwnTurns) {
  BehindOneServer robot{2};
  ASSERT_TRUE(robot.allAnswer());
  const std::vector<int> count = robot.answers({0, 1, 2, 3}, 100);
  for (const int of : count) EXPECT_GE(of, 10);
  EXPECT_NEAR(count[0], count[1], 1);
  EXPECT_NEAR(count[2], count[3], 1);
}

}  // namespace
}  // namespace nord_driver
