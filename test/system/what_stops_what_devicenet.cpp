// "What stops what" over DeviceNet: each wheel behind an SK TU3-DEV.
#include "nord_driver/core/bytes.h"
#include "system/devicenet_robot.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {
namespace {

constexpr std::uint32_t kFirstPoll = 0x42D, kPollsApart = 8, kFirstAnswer = 0x3C5;
constexpr std::size_t kAssemblyLength = 5;

class DevicenetStopRig final : public StopRig {
 public:
  explicit DevicenetStopRig(double cycle_rate) : robot_(options(cycle_rate)) {
    robot_.bus().setTap([this](const CanFrame& frame, sim::SimulatedDnBus::Sender, Instant at) { see(frame, at); });
  }

  DrivenRobot& robot() override { return robot_; }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee() override { return robot_.bus().referee().report(); }

  void step() override {
    beginCycle();
    robot_.step();
  }
  void passWithoutTheDriver(Duration span) override { robot_.bus().run(span); }
  void setBusPresent(bool present) override { robot_.bus().setInterfacePresent(present); }

  /// A poll is answered in its cycle; one answer may be late, and one lost (doc/devicenet.md).
  Duration silenceCounts() const override { return robot_.config().period() * 5 / 2; }
  /// Four times two cycles, at least 25 ms each, in steps of 10 ms.
  Duration driveSideTimeout() const override {
    return 4 * std::max<Duration>(std::chrono::milliseconds{30}, 2 * robot_.config().period());
  }

 private:
  static DevicenetRobot::Options options(double cycle_rate) {
    DevicenetRobot::Options options;
    options.node = stopSettings(cycle_rate);
    options.on_inverter = true;
    return options;
  }
  void see(const CanFrame& frame, Instant at) {
    if (frame.remote || frame.size != kAssemblyLength) return;
    for (DriveIndex i = 0; i < kDrives; ++i) {
      if (frame.id == kFirstPoll + kPollsApart * i) sawSent(i, wordAt(frame, 1), wordAt(frame, 3));
      if (frame.id == kFirstAnswer + i) sawStatus(i, wordAt(frame, 1), at);
    }
  }
  static Word wordAt(const CanFrame& frame, std::size_t offset) {
    return static_cast<Word>(frame.data[offset] | frame.data[offset + 1] << 8);
  }

  DevicenetRobot robot_;
};

template <int kCycleRate>
std::unique_ptr<StopRig> makeRig() {
  return std::make_unique<DevicenetStopRig>(kCycleRate);
}

// The default, and one where drive_timeout is three cycles, not 50 ms.
INSTANTIATE_TEST_SUITE_P(Devicenet, WhatStopsWhat,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>},
                                                              StopBus{"25Hz", makeRig<25>}),
                                            ::testing::ValuesIn(stopRows())),
                         nameOfStop);

}  // namespace
}  // namespace nord_driver::test
