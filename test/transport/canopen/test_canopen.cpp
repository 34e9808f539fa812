// The CANopen transport asks its interface no more than it must: what it has counted is a question to the kernel.
#include <gtest/gtest.h>

#include <memory>

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
class OnAnAskedBus : public ::testing::Test {
 protected:
  OnAnAskedBus() {
    const test::CanopenSettings settings;
    transport_.configure(settings.bus, settings.drives, 100.0);
    run(seconds{3});
  }
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

}  // namespace
}  // namespace nord_driver
