// The telegrams between master 1 and a NORD module 7531h at address 8 (or 9), typed from the layouts.
#pragma once

#include "profibus/wire.h"

namespace nord_driver::profibus {

constexpr const char* kFdlStatus8 = "10 08 01 49 52 16";
constexpr const char* kFdlStatus9 = "10 09 01 49 53 16";
constexpr const char* kHere8 = "10 01 08 00 09 16";
constexpr const char* kHere9 = "10 01 09 00 0A 16";
constexpr const char* kDiag6D = "68 05 05 68 88 81 6D 3C 3E F0 16";
constexpr const char* kDiag5D = "68 05 05 68 88 81 5D 3C 3E E0 16";
constexpr const char* kDiag7D = "68 05 05 68 88 81 7D 3C 3E 00 16";
constexpr const char* kWantsPrm = "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 75 31 37 16";
constexpr const char* kReady = "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 75 31 3E 16";
constexpr const char* kSetPrm5D = "68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 00 25 16";
constexpr const char* kChkCfg7D = "68 07 07 68 88 81 7D 3E 3E F3 F1 E6 16";
constexpr const char* kGetCfg5D = "68 05 05 68 88 81 5D 3B 3E DF 16";
constexpr const char* kHasPpo1 = "68 07 07 68 81 88 08 3E 3B F3 F1 6E 16";
constexpr const char* kSetPrm7D = "68 0C 0C 68 88 81 7D 3D 3E 88 0A 01 0B 75 31 00 45 16";
constexpr const char* kChkCfg5D = "68 07 07 68 88 81 5D 3E 3E F3 F1 C6 16";
constexpr const char* kShortAcknowledge = "E5";
constexpr const char* kExchange7D = "68 0F 0F 68 08 01 7D 00 00 00 00 00 00 00 00 04 7E 00 00 08 16";
constexpr const char* kExchange5D = "68 0F 0F 68 08 01 5D 00 00 00 00 00 00 00 00 04 7E 00 00 E8 16";
constexpr const char* kExchange6D = "68 0F 0F 68 08 01 6D 00 00 00 00 00 00 00 00 04 7E 00 00 F8 16";
constexpr const char* kInputs = "68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4D 16";
constexpr const char* kInputsDh = "68 0F 0F 68 01 08 0A 00 00 00 00 00 00 00 00 0B 31 00 00 4F 16";
constexpr const char* kNotActivated = "10 01 08 03 0C 16";

constexpr const char* kDiag9of6D = "68 05 05 68 89 81 6D 3C 3E F1 16";
constexpr const char* kWantsPrm9 = "68 0B 0B 68 81 89 08 3E 3C 02 05 00 FF 75 31 38 16";
constexpr const char* kSetPrm9 = "68 0C 0C 68 89 81 5D 3D 3E 88 0A 01 0B 75 31 00 26 16";
constexpr const char* kChkCfg9 = "68 07 07 68 89 81 7D 3E 3E F3 F1 E7 16";
constexpr const char* kDiag9of5D = "68 05 05 68 89 81 5D 3C 3E E1 16";
constexpr const char* kReady9 = "68 0B 0B 68 81 89 08 3E 3C 00 0C 00 01 75 31 3F 16";
constexpr const char* kExchange9of7D = "68 0F 0F 68 09 01 7D 00 00 00 00 00 00 00 00 04 7E 00 00 09 16";
constexpr const char* kExchange9of5D = "68 0F 0F 68 09 01 5D 00 00 00 00 00 00 00 00 04 7E 00 00 E9 16";
constexpr const char* kInputs9 = "68 0F 0F 68 01 09 08 00 00 00 00 00 00 00 00 0B 31 00 00 4E 16";

/// Standby in PPO 1: no parameter order, control word 047E, setpoint 0.
inline std::vector<std::uint8_t> standby() {
  return fromHex("00 00 00 00 00 00 00 00  04 7E 00 00");
}

/// One module at address 8 and the way there, one request per cycle.
class NordWire : public Wire {
 public:
  explicit NordWire(const BusParameters& bus = quietBus(), const SlaveConfig& slave = nordModule(8))
      : Wire(bus, {slave}) {
    master.setOutputs(0, standby());
  }

  void cycle(const std::string& request, const std::string& answer, const char* file = __builtin_FILE(),
             int line = __builtin_LINE()) {
    startCycle();
    sends(request, file, line);
    receives(answer);
    cycleEnds(file, line);
  }

  void isFound() { cycle(kFdlStatus8, kHere8); }
  void isFree() { cycle(kDiag6D, kWantsPrm); }
  void takesParameters() { cycle(kSetPrm5D, kShortAcknowledge); }
  void takesConfiguration() { cycle(kChkCfg7D, kShortAcknowledge); }
  /// In the first exchange it announces a diagnosis, and does not answer the question for it.
  void announcesWithoutTelling(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    startCycle();
    sends(kExchange7D, file, line);
    receives(kInputsDh);
    for (int i = 0; i < 2; ++i) {
      sends(kDiag5D, file, line);
      staysSilent();
    }
    cycleEnds(file, line);
  }
  /// Somebody sends on and on, until the cycle ends: nothing of ours goes out. The cycle has begun.
  void neverFallsSilent() {
    for (const Instant begin = now; !master.cycleDone() && now < begin + std::chrono::seconds{10};) {
      advanceBits(11);
      arrives("FF");
      EXPECT_TRUE(master.pollTransmit(now).empty());
      if (!master.cycleDone() && now >= *master.nextDeadline()) master.handleTimeout(now);
    }
  }
  /// Found before its watchdog has run out: it hears the next word, and is asked for its diagnosis. The next exchange
  /// carries FC 7D.
  void isGoneOnWith(const std::string& diagnosis = kReady, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE()) {
    startCycle();
    sends(kExchange6D, file, line);
    receives(kInputs);
    sends(kDiag5D, file, line);
    receives(diagnosis);
    cycleEnds(file, line);
  }
  /// The whole start-up; the next exchange carries FC 7D.
  void startsUp() {
    isFound();
    isFree();
    takesParameters();
    takesConfiguration();
    cycle(kDiag5D, kReady);
    EXPECT_EQ(SlavePhase::kDataExchange, status().phase);
    forgetEvents();
  }
};

}  // namespace nord_driver::profibus
