// "What stops what" over CANopen: each wheel behind an SK TU3-CAO.
#include <algorithm>

#include "nord_driver/core/bytes.h"
#include "system/can_robot.h"
#include "system/node_ends.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {
namespace {

constexpr std::uint32_t kFirstReceivePdo = 0x203, kFirstTransmitPdo = 0x183;
constexpr std::uint32_t kErrorControl = 0x700;
constexpr std::size_t kPdoLength = 4;
constexpr std::uint8_t kRightNode = 4;
constexpr char kInterrupted[] =
    "drive right stopped: its connection to the bus was reset, or left operation, without being asked";

class CanopenStopRig final : public StopRig {
 public:
  explicit CanopenStopRig(double cycle_rate) : robot_(options(cycle_rate)) {
    robot_.bus().setTap([this](const CanFrame& frame, sim::SimulatedCanBus::Sender sender, Instant at) {
      see(frame, at);
      tells_state_ = tells_state_ || tellsState(frame, sender);
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

  /// Somebody else commands the right node (CiA 301 7.2.8.3.1).
  void commandRightNode(std::uint8_t command) {
    robot_.bus().inject(dataFrame(0x000, ByteView{FixedBytes<2>{command, kRightNode}}));
  }
  void restartRightNode() {
    robot_.node(WhatStopsWhat::kRight).setPowered(false);
    robot_.bus().run(std::chrono::milliseconds{2});
    robot_.node(WhatStopsWhat::kRight).setPowered(true);
  }

  /// A node sends what has changed, and every 50 ms, at least two cycles: two and a half of these (doc/canopen.md).
  Duration silenceCounts() const override {
    return std::max<Duration>(std::chrono::milliseconds{50}, 2 * robot_.config().period()) * 5 / 2;
  }
  /// The node's answer to guarding: without another one it is gone, at 25 Hz before its status words are missed.
  Instant noticesSilenceAt() const override { return guarded_at_ + driveSideTimeout(); }
  /// Node guarding, 100 ms times 3.
  Duration driveSideTimeout() const override { return std::chrono::milliseconds{300}; }

 private:
  static CanRobot::Options options(double cycle_rate) {
    CanRobot::Options options;
    options.node = stopSettings(cycle_rate);
    return options;
  }
  void see(const CanFrame& frame, Instant at) {
    if (frame.id == kErrorControl + kRightNode && !frame.remote) guarded_at_ = at;
    if (frame.remote || frame.size != kPdoLength) return;
    for (DriveIndex i = 0; i < kDrives; ++i) {
      if (frame.id == kFirstReceivePdo + i) sawSent(i, wordAt(frame, 0), wordAt(frame, 2));
      if (frame.id == kFirstTransmitPdo + i) sawStatus(i, wordAt(frame, 0), at);
    }
  }
  /// A command of somebody else, or a boot-up: nobody asked for either.
  static bool tellsState(const CanFrame& frame, sim::SimulatedCanBus::Sender sender) {
    const bool command = frame.id == 0x000 && sender == sim::SimulatedCanBus::Sender::kForeign;
    const bool boot_up = frame.id == 0x700u + kRightNode && !frame.remote && frame.size == 1 && frame.data[0] == 0;
    return command || boot_up;
  }
  static Word wordAt(const CanFrame& frame, std::size_t offset) {
    return static_cast<Word>(frame.data[offset] | frame.data[offset + 1] << 8);
  }

  CanRobot robot_;
  bool tells_state_ = false;
  Instant guarded_at_{};
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

INSTANTIATE_TEST_SUITE_P(Canopen, NodeEnds,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>}),
                                            ::testing::ValuesIn(endMoments())),
                         nameOfEnd);

/// "A node changes state unasked": here by the commands of others, and by a restart of its own.
StopRow stateRow(const char* name, void (*cause)(WhatStopsWhat&)) {
  return {name, Known::kNodeState, Reaction::kOneIsGone, After::kLatched, kInterrupted, cause};
}

CanopenStopRig& canopen(WhatStopsWhat& test) {
  return static_cast<CanopenStopRig&>(test.rig());
}

INSTANTIATE_TEST_SUITE_P(
    CanopenNode, WhatStopsWhat,
    ::testing::Combine(
        ::testing::Values(StopBus{"100Hz", makeRig<100>}, StopBus{"25Hz", makeRig<25>}),
        ::testing::Values(
            stateRow("StoppedByOthers", [](WhatStopsWhat& test) { canopen(test).commandRightNode(0x02); }),
            stateRow("PreOperationalByOthers", [](WhatStopsWhat& test) { canopen(test).commandRightNode(0x80); }),
            stateRow("ResetByOthers", [](WhatStopsWhat& test) { canopen(test).commandRightNode(0x81); }),
            stateRow("CommunicationResetByOthers", [](WhatStopsWhat& test) { canopen(test).commandRightNode(0x82); }),
            stateRow("RestartsItself", [](WhatStopsWhat& test) { canopen(test).restartRightNode(); }))),
    nameOfStop);

}  // namespace
}  // namespace nord_driver::test
