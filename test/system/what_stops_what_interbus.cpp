// "What stops what" over InterBus: each wheel behind an SK TU3-IBS, in a ring behind a gateway.
//
// All rows are held. Two say something else here than on the other buses, and the ring has rows of its own: see
// interbusRows().
#include "nord_driver/core/bytes.h"
#include "system/interbus_robot.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {
namespace {

constexpr std::size_t kHeader = 7;  // transaction, protocol, length, unit
constexpr std::uint8_t kReadInputs = 4, kWrite = 16;

class InterbusStopRig final : public StopRig {
 public:
  explicit InterbusStopRig(const InterbusRobot::Options& options)
      : options_(options), words_each_((options.ppo_type == 1 ? 2 : 4) + (options.pcp_word ? 1 : 0)), robot_(options) {
    robot_.gateway().setTap([this](ByteView bytes, sim::SimulatedGateway::Sender sender, Instant at) {
      if (sender == sim::SimulatedGateway::Sender::kDriver) {
        seeRequest(bytes);
      } else {
        seeAnswer(bytes, at);
      }
    });
  }

  DrivenRobot& robot() override { return robot_; }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee() override { return robot_.referee(); }
  InterbusRobot& ring() { return robot_; }

  void step() override {
    beginCycle();
    ring_stands_ = false;
    robot_.step();
  }
  bool sawUnaskedState() const override { return ring_stands_; }
  void passWithoutTheDriver(Duration span) override { robot_.gateway().run(span); }
  void setBusPresent(bool present) override {
    sim::NetworkState network;
    network.port_open = present;
    robot_.gateway().setNetwork(network);
  }

  /// Each exchange brings a status word, and its age counts from the question.
  Duration silenceCounts() const override { return Duration::zero(); }
  /// The watchdog of the gateway, then P513.
  Duration driveSideTimeout() const override {
    return std::chrono::milliseconds{200} + std::chrono::milliseconds{100} * options_.telegram_timeout;
  }
  /// One rpm of 1500.
  double setpointStep() const override { return options_.drivecom ? 16384.0 / 1500.0 : 1.0; }

 private:
  Word wordAt(ByteView bytes, std::size_t offset) const {
    const auto high = bytes[offset + (options_.swapped ? 1 : 0)], low = bytes[offset + (options_.swapped ? 0 : 1)];
    return static_cast<Word>(high << 8 | low);
  }
  std::size_t placeOf(DriveIndex drive) const { return 2 * (drive * words_each_ + (options_.pcp_word ? 1 : 0)); }

  // Function 16: address, count, bytes, and the whole image.
  void seeRequest(ByteView bytes) {
    asked_ = static_cast<unsigned>(bytes[kHeader + 1] << 8 | bytes[kHeader + 2]);
    if (bytes[kHeader] != kWrite || asked_ != InterbusRobot::kOutputs) return;
    for (DriveIndex i = 0; i < kDrives; ++i) {
      const std::size_t at = kHeader + 6 + placeOf(i);
      const Word control = wordAt(bytes, at), setpoint = wordAt(bytes, at + 2);
      // DRIVECOM has no bit 10, and its setpoints are rpm (BU 0070 6.4.2); the rows speak NORD's.
      if (!options_.drivecom) {
        sawSent(i, control, setpoint);
      } else {
        const double share = toSigned(setpoint) * 16384.0 / 1500.0;
        sawSent(i, static_cast<Word>(control | 0x0400), toWord(static_cast<std::int16_t>(std::lround(share))));
      }
    }
  }
  void seeAnswer(ByteView bytes, Instant at) {
    if (bytes[kHeader] != kReadInputs) return;
    if (asked_ == InterbusRobot::kRunning) ring_stands_ = bytes[kHeader + 3] == 0;
    if (asked_ != 0) return;
    for (DriveIndex i = 0; i < kDrives; ++i) sawStatus(i, wordAt(bytes, kHeader + 2 + placeOf(i)), at);
  }

  InterbusRobot::Options options_;
  std::size_t words_each_;
  unsigned asked_ = 0;  // register of the request before
  bool ring_stands_ = false;
  InterbusRobot robot_;
};

InterbusRobot::Options optionsAt(double cycle_rate) {
  InterbusRobot::Options options;
  options.node = stopSettings(cycle_rate);
  return options;
}

template <int kCycleRate>
std::unique_ptr<StopRig> makeRig() {
  return std::make_unique<InterbusStopRig>(optionsAt(kCycleRate));
}
std::unique_ptr<StopRig> makeDrivecomRig() {
  InterbusRobot::Options options = optionsAt(100.0);
  options.drivecom = true;
  return std::make_unique<InterbusStopRig>(options);
}
std::unique_ptr<StopRig> makeSwappedRig() {
  InterbusRobot::Options options = optionsAt(100.0);
  options.series = "sk700e";
  options.ppo_type = 2;
  options.swapped = options.pcp_word = true;
  return std::make_unique<InterbusStopRig>(options);
}

InterbusRobot& interbus(WhatStopsWhat& test) {
  return static_cast<InterbusStopRig&>(test.rig()).ring();
}
bool saysNothing(Word status) {
  return status == 0;
}

// The driver sends its stop word to a drive it lost in motion for shutdown_timeout. Taking the enable away acknowledges
// (BU 0020 8), and between a write and the read behind it the ring moves several times: who comes back within that time
// may have lost its E10 before anybody has read it. test_interbus_network.cpp has those.
void outlastTheStopWord(WhatStopsWhat& test) {
  interbus(test).run(interbus(test).config().shutdown_timeout);
}

constexpr char kStands[] = "its connection to the bus was reset, or left operation, without being asked";

StopRow ringRow(const char* name, void (*cause)(WhatStopsWhat&), void (*end_cause)(WhatStopsWhat&)) {
  return {name, Known::kNodeState, Reaction::kAllAreGone, After::kFaultLatched, kStands, cause, nullptr, end_cause};
}

/// Those of all buses, none left out. A drive that is silent or off is zeros in a ring that runs on, and one that is only
/// not heard hears on: no time-out of its own ends it. And a ring that stands, which no bus of stations has.
std::vector<StopRow> interbusRows() {
  std::vector<StopRow> rows = stopRows();
  for (StopRow& row : rows) {
    if (row.known == Known::kSilence) {
      row.known = Known::kZeros;
      row.status_says = saysNothing;
      row.after = After::kLatched;
    } else if (row.reaction == Reaction::kNoBus && row.end_cause != nullptr) {
      row.end_cause = [](WhatStopsWhat& test) {
        outlastTheStopWord(test);
        test.rig().setBusPresent(true);
      };
    }
  }
  rows.push_back(ringRow(
      "CableOfTheRingCut", [](WhatStopsWhat& test) { interbus(test).ring().setCut(true); },
      [](WhatStopsWhat& test) {
        outlastTheStopWord(test);
        interbus(test).ring().setCut(false);
      }));
  rows.push_back(ringRow(
      "ModuleWithoutSupply",
      [](WhatStopsWhat& test) { interbus(test).module(WhatStopsWhat::kRight).setPowered(false); },
      [](WhatStopsWhat& test) {
        outlastTheStopWord(test);
        interbus(test).module(WhatStopsWhat::kRight).setPowered(true);
      }));
  return rows;
}

/// With DRIVECOM the zeros of a gateway whose watchdog has run out are words like others: "voltage disabled" (BU 0070
/// 6.4.2). The motor coasts, and no P513 trips.
std::vector<StopRow> drivecomRows() {
  std::vector<StopRow> rows = interbusRows();
  for (StopRow& row : rows) {
    if (row.reaction == Reaction::kNoBus) row.after = After::kLatched;
  }
  return rows;
}

// The default, one where drive_timeout is three cycles, not 50 ms, and SK 700E with PPO type 2, the PCP word in the
// image and the bytes of each word swapped.
INSTANTIATE_TEST_SUITE_P(Interbus, WhatStopsWhat,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeRig<100>},
                                                              StopBus{"25Hz", makeRig<25>},
                                                              StopBus{"100HzSwappedPpo2", makeSwappedRig}),
                                            ::testing::ValuesIn(interbusRows())),
                         nameOfStop);
INSTANTIATE_TEST_SUITE_P(Drivecom, WhatStopsWhat,
                         ::testing::Combine(::testing::Values(StopBus{"100Hz", makeDrivecomRig}),
                                            ::testing::ValuesIn(drivecomRows())),
                         nameOfStop);

}  // namespace
}  // namespace nord_driver::test
