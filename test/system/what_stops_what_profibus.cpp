// "What stops what" over PROFIBUS: each wheel behind an SK TU3-PBR.
#include "nord_driver/core/bytes.h"
#include "system/node_ends.h"
#include "system/simulated_robot.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {
namespace {

constexpr std::uint8_t kFirstStation = 3;
constexpr std::size_t kControlOffset = 15;  // SD2 head of 7 bytes, PKW of 8 (PPO 1)
constexpr std::size_t kDataTelegram = 21;   // with PZD of 4, FCS and ED
constexpr std::size_t kFunctionOffset = 3;  // SD1 telegram: an answer without data
constexpr std::uint8_t kNotActivated = 0x03;
constexpr char kInterrupted[] =
    "drive right stopped: its connection to the bus was reset, or left operation, without being asked";

class ProfibusStopRig final : public StopRig {
 public:
  explicit ProfibusStopRig(double cycle_rate) : robot_(options(cycle_rate)) {}

  DrivenRobot& robot() override { return robot_; }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee() override { return robot_.segment().referee().report(); }

  void step() override {
    beginCycle();
    robot_.link().record(true);
    const Instant start = robot_.transport().now();
    robot_.step();
    const Instant exchanged = start + robot_.exchangeTime();
    for (DriveIndex i = 0; i < kDrives; ++i) {
      const auto [request, answer] = robot_.link().lastExchange(static_cast<std::uint8_t>(kFirstStation + i));
      const std::vector<std::uint8_t> sent = fromHex(request), came = fromHex(answer);
      if (sent.size() == kDataTelegram) sawSent(i, wordAt(sent, 0), wordAt(sent, 2));
      if (came.size() == kDataTelegram) sawStatus(i, wordAt(came, 0), exchanged);
      if (i == 1) tells_state_ = came.size() == 6 && came[kFunctionOffset] == kNotActivated;
    }
  }
  /// RS is its answer to the exchange: it is in data exchange no longer.
  bool sawUnaskedState() const override { return tells_state_; }
  void passWithoutTheDriver(Duration span) override { robot_.segment().run(span); }

  void setBusPresent(bool present) override { robot_.segment().setDevicePresent(present); }

  /// The module of the right drive loses its supply for a moment; the inverter does not.
  void restartRightModule() {
    robot_.segment().station(1).setPowered(false);
    robot_.segment().station(1).setPowered(true);
  }

  /// Every cycle asks for an answer.
  Duration silenceCounts() const override { return Duration::zero(); }
  /// The watchdog of the slave.
  Duration driveSideTimeout() const override { return std::chrono::milliseconds{200}; }

 private:
  static SimulatedRobot::Options options(double cycle_rate) {
    SimulatedRobot::Options options;
    options.node = stopSettings(cycle_rate);
    return options;
  }
  static Word wordAt(const std::vector<std::uint8_t>& telegram, std::size_t offset) {
    return static_cast<Word>(telegram[kControlOffset + offset] << 8 | telegram[kControlOffset + offset + 1]);
  }

  SimulatedRobot robot_;
  bool tells_state_ = false;
};

template <int kCycleRate>
std::unique_ptr<StopRig> makeRig() {
  return std::make_unique<ProfibusStopRig>(kCycleRate);
}

// The default, and one where drive_timeout is three cycles, not 50 ms.
INSTANTIATE_TEST_SUITE_P(Profibus, WhatStopsWhat,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>},
                                                              StopBus{"25Hz", makeRig<25>}),
                                            ::testing::ValuesIn(stopRows())),
                         nameOfStop);

INSTANTIATE_TEST_SUITE_P(Profibus, NodeEnds,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>}),
                                            ::testing::ValuesIn(endMoments())),
                         nameOfEnd);

ProfibusStopRig& profibus(WhatStopsWhat& test) {
  return static_cast<ProfibusStopRig&>(test.rig());
}

// At 200 cycles a second it is set up again in less than drive_timeout, 50 ms: without being told, its drive would run on.
INSTANTIATE_TEST_SUITE_P(
    ProfibusStation, WhatStopsWhat,
    ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>}, StopBus{"200Hz", makeRig<200>}),
                       ::testing::Values(StopRow{"RestartsItself", Known::kNodeState, Reaction::kOneIsGone,
                                                 After::kLatched, kInterrupted,
                                                 [](WhatStopsWhat& test) { profibus(test).restartRightModule(); }})),
    nameOfStop);

}  // namespace
}  // namespace nord_driver::test
