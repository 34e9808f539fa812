// What of the drives' and the bus's state is worth a line in the log, and how grave it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalogue/fault_words.h"
#include "cycle/snapshot.h"
#include "node/bus_log_debouncer.h"
#include "nord_driver/core/time.h"

namespace nord_driver::node {

struct LogLine {
  enum class Level : std::uint8_t { kInfo, kWarn, kError };
  Level level = Level::kInfo;
  std::string text;
};

/// The drives of a node as the log names them and their services.
struct LoggedDrives {
  std::string node;  ///< its full name: "/nord_driver"
  std::vector<std::string> names;
  /// One per drive: whose ~<drive>/enable enables it, its own or that of the drive that it follows; empty: ~enable, the
  /// base's, and the drives of the base are acknowledged together.
  std::vector<std::string> enabled_as;
  std::vector<catalogue::FaultWords> faults;  ///< one per drive
  std::string bus = {};                       ///< what the transport opens, as configured; empty: nothing
  std::string bus_key = {};                   ///< where that is configured: "~bus/device"
  bool read_only = false;                     ///< every call that acknowledges or enables is refused
};

/// Polled with the newest snapshot; what came and went between two of them is not lost where it is counted.
class StateLog {
 public:
  explicit StateLog(LoggedDrives drives);

  /// The lines due at `now`: a fault as soon as its number is known, at the latest after two seconds; a stop of the base
  /// at once; the bus as BusLogDebouncer has it.
  std::vector<LogLine> poll(const cycle::CycleSnapshot& snapshot, Instant now);

 private:
  struct FaultState {
    std::uint64_t seen = 0;  // of DriveSnapshot::faults
    bool met = false;        // the drive has been online
    bool stood = false;      // the fault was there when the drive was met
    bool due = false;
    Instant since{};
  };

  void pollBus(const cycle::CycleSnapshot& snapshot, Instant now, std::vector<LogLine>& lines);
  void pollFault(const cycle::DriveSnapshot& drive, std::size_t index, Instant now, std::vector<LogLine>& lines);
  void pollStop(const cycle::CycleSnapshot& snapshot, std::vector<LogLine>& lines);
  std::string faultSentence(std::size_t index, std::uint16_t number, const std::string& remembered) const;

  LoggedDrives drives_;
  std::vector<FaultState> faults_;
  BusLogDebouncer bus_;
  std::string last_stop_;  // without what changes in its sentence
};

}  // namespace nord_driver::node
