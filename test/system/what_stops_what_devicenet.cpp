// "What stops what" over DeviceNet: each wheel behind an SK TU3-DEV.
#include <algorithm>
#include <initializer_list>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "system/devicenet_robot.h"
#include "system/node_ends.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {
namespace {

constexpr std::uint32_t kFirstPoll = 0x42D, kPollsApart = 8, kFirstAnswer = 0x3C5;
constexpr std::size_t kAssemblyLength = 5;
// Of the right module, MAC id 6: its explicit answers, and requests on its unconnected port.
constexpr std::uint32_t kRightAnswers = 0x433, kRightUnconnected = 0x436;
constexpr char kInterrupted[] =
    "drive right stopped: its connection to the bus was reset, or left operation, without being asked";

class DevicenetStopRig final : public StopRig {
 public:
  explicit DevicenetStopRig(double cycle_rate) : robot_(options(cycle_rate)) {
    robot_.bus().setTap([this](const CanFrame& frame, sim::SimulatedDnBus::Sender sender, Instant at) {
      see(frame, at);
      tells_state_ = tells_state_ || sender == sim::SimulatedDnBus::Sender::kForeign;
    });
  }

  DrivenRobot& robot() override { return robot_; }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee() override { return robot_.bus().referee().report(); }

  void step() override {
    beginCycle();
    tells_state_ = false;
    robot_.step();
  }
  bool sawUnaskedState() const override { return tells_state_; }
  void passWithoutTheDriver(Duration span) override { robot_.bus().run(span); }
  void setBusPresent(bool present) override { robot_.bus().setInterfacePresent(present); }

  /// Somebody else says this.
  void say(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    const std::vector<std::uint8_t> data{bytes};
    robot_.bus().inject(dataFrame(id, data));
  }

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
  bool tells_state_ = false;
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

INSTANTIATE_TEST_SUITE_P(Devicenet, NodeEnds,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>}),
                                            ::testing::ValuesIn(endMoments())),
                         nameOfEnd);

/// "A node changes state unasked": its connection is released by others, or it says that it shuts down.
StopRow stateRow(const char* name, void (*cause)(WhatStopsWhat&)) {
  return {name, Known::kNodeState, Reaction::kOneIsGone, After::kLatched, kInterrupted, cause};
}

DevicenetStopRig& devicenet(WhatStopsWhat& test) {
  return static_cast<DevicenetStopRig&>(test.rig());
}

INSTANTIATE_TEST_SUITE_P(
    DevicenetModule, WhatStopsWhat,
    ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>}, StopBus{"25Hz", makeRig<25>}),
                       ::testing::Values(stateRow("PollReleasedByOthers",
                                                  [](WhatStopsWhat& test) {
                                                    devicenet(test).say(kRightUnconnected, {0, 0x4C, 3, 1, 2});
                                                  }),
                                         stateRow("ShutsDown",
                                                  [](WhatStopsWhat& test) {
                                                    devicenet(test).say(kRightAnswers, {6, 0xCE, 1, 0, 1, 0, 3, 0});
                                                  }))),
    nameOfStop);

}  // namespace
}  // namespace nord_driver::test
