// "What stops what" over CANopen: each wheel behind an SK TU3-CAO.
#include <algorithm>

#include "nord_driver/core/bytes.h"
#include "system/can_robot.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {
namespace {

constexpr std::uint32_t kFirstReceivePdo = 0x203, kFirstTransmitPdo = 0x183;
constexpr std::size_t kPdoLength = 4;

class CanopenStopRig final : public StopRig {
 public:
  explicit CanopenStopRig(double cycle_rate) : robot_(options(cycle_rate)) {
    robot_.bus().setTap([this](const CanFrame& frame, sim::SimulatedCanBus::Sender, Instant at) { see(frame, at); });
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

  /// A node sends what has changed, and every 50 ms, at least two cycles: two and a half of these (doc/canopen.md).
  Duration silenceCounts() const override {
    return std::max<Duration>(std::chrono::milliseconds{50}, 2 * robot_.config().period()) * 5 / 2;
  }
  /// Node guarding, 100 ms times 3.
  Duration driveSideTimeout() const override { return std::chrono::milliseconds{300}; }

 private:
  static CanRobot::Options options(double cycle_rate) {
    CanRobot::Options options;
    options.node = stopSettings(cycle_rate);
    return options;
  }
  void see(const CanFrame& frame, Instant at) {
    if (frame.remote || frame.size != kPdoLength) return;
    for (DriveIndex i = 0; i < kDrives; ++i) {
      if (frame.id == kFirstReceivePdo + i) sawSent(i, wordAt(frame, 0), wordAt(frame, 2));
      if (frame.id == kFirstTransmitPdo + i) sawStatus(i, wordAt(frame, 0), at);
    }
  }
  static Word wordAt(const CanFrame& frame, std::size_t offset) {
    return static_cast<Word>(frame.data[offset] | frame.data[offset + 1] << 8);
  }

  CanRobot robot_;
};

template <int kCycleRate>
std::unique_ptr<StopRig> makeRig() {
  return std::make_unique<CanopenStopRig>(kCycleRate);
}

// The default, and one where drive_timeout is three cycles, not 50 ms.
INSTANTIATE_TEST_SUITE_P(Canopen, WhatStopsWhat,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>},
                                                              StopBus{"25Hz", makeRig<25>}),
                                            ::testing::ValuesIn(stopRows())),
                         nameOfStop);

}  // namespace
}  // namespace nord_driver::test
