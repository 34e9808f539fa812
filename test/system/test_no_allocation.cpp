// The cycle's thread allocates nothing from 100 cycles after data exchange on, a drive loss and a parameter read
// included: whoever allocates in it may wait for a lock another thread holds, and a stop word with it.
//
// A program of its own, in real time over a pty, because it replaces malloc. Not built under sanitizers, which do the
// same.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>

#include "cycle/cycle_thread.h"
#include "sim/profibus/pty_bus.h"
#include "support/count_allocations.h"
#include "support/map_settings.h"
#include "support/passing_transport.h"
#include "trace/trace_feed.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;

/// Passes everything on; marks its thread as counted when told to.
class CountingTransport final : public PassingTransport {
 public:
  CountingTransport() : PassingTransport(std::make_unique<ProfibusDpTransport>()) {}

  void exchange(const std::vector<profile::ProcessOutput>& outputs,
                std::vector<DriveExchange>& inputs) noexcept override {
    ++cycles;
    countThisThread(counting);
    if (spoil) spoiled_ = std::make_unique<int>(1);
    PassingTransport::exchange(outputs, inputs);
  }

  std::atomic<unsigned long> cycles{0};
  std::atomic<bool> counting{false};
  std::atomic<bool> spoil{false};

 private:
  std::unique_ptr<int> spoiled_;
};

/// With `true` both drives are behind one module SK CU4, the second in PPO 3: its parameters come by records.
class NoAllocation : public ::testing::TestWithParam<bool> {
 protected:
  NoAllocation() : link_path_("/tmp/nord_no_allocation_" + std::to_string(getpid())), bus_(simConfig(), link_path_) {
    std::vector<DriveSettings> drives;
    for (const char* name : {"left", "right"}) {
      auto settings = std::make_shared<MapSettings>(std::string{"~drives/"} + name + "/");
      const bool left = name == std::string{"left"};
      settings->set("address", left || GetParam() ? 3 : 4).set("series", "sk5xxe").set("pole_pairs", 2);
      if (GetParam()) settings->set("module", "sk_cu4").set("inverter", left ? 1 : 2).set("ppo_type", left ? 1 : 3);
      settings->set("joint", name).set("gear_ratio", 20.0);
      drives.push_back({name, settings});
    }
    const MapSettings node{"~",
                           {{"left_wheel", std::string{"left"}},
                            {"right_wheel", std::string{"right"}},
                            {"wheel_separation", 0.5},
                            {"wheel_radius", 0.1},
                            {"drive_timeout", 1.0}}};
    const cycle::CycleConfig config = cycle::readCycleConfig(node, drives);
    // A busy machine may hold the pty's other end up for long: neither a watchdog nor a late answer shall end this
    // test.
    const MapSettings bus{"~bus/", {{"device", bus_.devicePath()}, {"watchdog", 5.0}, {"slot_time", 0.05}}};
    transport_.configure(bus, drives, config.cycle_rate);
    ports_ = std::make_unique<cycle::CyclePorts>(drives.size());
    ports_->setObserver(&feed_);
    cycle_ = std::make_unique<cycle::BusCycle>(config, transport_, *ports_, false);
    thread_ = std::make_unique<cycle::CycleThread>(*cycle_, transport_, cycle::RealTimeOptions{});
  }

  static sim::SimConfig simConfig() {
    sim::SimConfig config;
    for (const char* name : {"left", "right"}) {
      sim::DriveConfig drive;
      drive.name = name;
      const bool left = name == std::string{"left"};
      drive.address = left || GetParam() ? 3 : 4;
      if (GetParam()) drive.place = left ? 1 : 2;
      config.drives.push_back(drive);
    }
    return config;
  }
  template <typename Condition>
  bool waitFor(Condition done) {
    const Instant limit = std::chrono::steady_clock::now() + seconds{30};
    while (!done()) {
      if (std::chrono::steady_clock::now() > limit) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    return true;
  }
  bool runCycles(unsigned long count) {
    const unsigned long until = transport_.cycles + count;
    return waitFor([&] { return transport_.cycles >= until; });
  }
  bool bothOnline() {
    const auto& drives = ports_->readSnapshot().drives;
    return drives[0].online && drives[1].online;
  }
  bool bothRead() {
    const auto& drives = ports_->readSnapshot().drives;
    return drives[0].device.complete && drives[1].device.complete;
  }
  cycle::Completion ask(cycle::RequestKind kind, std::uint16_t parameter = 0) {
    cycle::Request request;
    request.id = 1;
    request.kind = kind;
    request.patience = seconds{10};
    if (kind == cycle::RequestKind::kReadParameter) request.drive = 0;
    request.parameter.number = parameter;
    request.parameter.shape = profile::ParameterShape::kPerSet;
    ports_->submit(request);
    return ports_->waitCompletion(seconds{15}).value_or(cycle::Completion{});
  }

  std::string link_path_;
  sim::PtyBus bus_;
  CountingTransport transport_;
  trace::TraceFeed feed_{2};
  std::unique_ptr<cycle::CyclePorts> ports_;
  std::unique_ptr<cycle::BusCycle> cycle_;
  std::unique_ptr<cycle::CycleThread> thread_;
};

INSTANTIATE_TEST_SUITE_P(Modules, NoAllocation, ::testing::Bool());

TEST_P(NoAllocation, InTheCyclesThreadOverALossAndAParameterRead) {
  ASSERT_TRUE(waitFor([this] { return bothOnline(); }));
  ASSERT_TRUE(runCycles(100));
  allocations = 0;
  transport_.counting = true;
  ASSERT_TRUE(runCycles(20));

  EXPECT_TRUE(waitFor([this] { return bothRead(); }));
  EXPECT_EQ(500, ask(cycle::RequestKind::kReadParameter, 105).parameter.raw);
  EXPECT_FALSE(ask(cycle::RequestKind::kReadParameter, 999).success);
  ports_->tuneBase({1.1, 0.9, 1.05, true});
  EXPECT_TRUE(ask(cycle::RequestKind::kEnable).success);
  ports_->commandBase({{0.2, 0.1}, std::chrono::steady_clock::now(), true});
  EXPECT_TRUE(runCycles(40));

  bus_.withModel([](sim::RobotSim& robot) { robot.drive(1).setPlugged(false); });
  EXPECT_TRUE(waitFor([this] { return !ports_->readSnapshot().drives[1].online; }));
  EXPECT_TRUE(runCycles(20));
  bus_.withModel([](sim::RobotSim& robot) { robot.drive(1).setPlugged(true); });
  EXPECT_TRUE(waitFor([this] { return bothOnline() && bothRead(); }));
  EXPECT_TRUE(ask(cycle::RequestKind::kDisable).success);
  EXPECT_TRUE(runCycles(20));
  EXPECT_EQ(0u, allocations);

  // And this test would have noticed.
  transport_.spoil = true;
  EXPECT_TRUE(runCycles(3));
  EXPECT_GT(allocations, 0u);
}

}  // namespace
}  // namespace nord_driver::test
