// What a restore would write to a drive, in which order, and what it leaves out.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/parameter_dump.h"

namespace nord_driver::tools {

/// When a parameter is written: what may move a motor after what cannot, and what the bus reaches the drive by at the
/// very end, when everything else has been verified.
enum class RestoreStage : std::uint8_t {
  kNeutral,
  kMotion,       ///< decides whether and how the motor follows: P104, inputs, sources
  kProcessData,  ///< what the words of the bus mean and how long they may stay away: P543 to P548, P513, P105 last
  kReach,        ///< address, baud rate, source of the control word, layout of the telegrams
};

RestoreStage stageOf(std::uint16_t number) noexcept;

/// Of the bus settings, the stages kProcessData and kReach.
enum class BusSettings : std::uint8_t {
  kReachable,  ///< those that leave the drive where it is on the bus; the others are left out
  kNone,
  kAll,
};

struct RestoreOptions {
  bool persistent = false;  ///< EEPROM; otherwise RAM, lost at power off
  bool save_same = false;   ///< with `persistent`: also what has its value already, perhaps in RAM only
  BusSettings bus_settings = BusSettings::kReachable;
};

struct RestoreChange {
  catalogue::ParameterAddress address;
  std::int32_t before = 0;  ///< raw
  std::int32_t after = 0;   ///< raw
};

struct RestorePlan {
  struct LeftOut {
    catalogue::ParameterAddress address;
    std::int32_t wanted = 0;            ///< raw, in the dump
    std::optional<std::int32_t> there;  ///< raw, in the drive
    std::string why;                    ///< a clause
  };

  std::vector<RestoreChange> changes;  ///< in the order of writing
  std::vector<Dump::Value> same;       ///< what the drive has already
  std::vector<LeftOut> left_out;       ///< differs and stays as it is
};

/// Reads from the drive what the dump has of settings; writes nothing. What resets a device and P560, which decides
/// where writes go, are in no plan. Throws Trouble when the drive stops answering, or `end_asked`; UsageError when the
/// dump is of another series.
RestorePlan planRestore(DriveParameters& drive, const Dump& dump, const RestoreOptions& options,
                        const std::atomic<bool>& end_asked);

/// For people: each value from and to, what is left out and why, and how many they are.
std::string planText(const RestorePlan& plan, const catalogue::DriveCatalogue& known, bool persistent);

/// Whether two raw values mean the same: a word may have come with or without its sign.
bool meansSame(const catalogue::DriveCatalogue& known, const catalogue::ParameterAddress& address, std::int32_t first,
               std::int32_t second);

/// A raw value in words: "2.50 s".
std::string rawText(const catalogue::DriveCatalogue& known, const catalogue::ParameterAddress& address,
                    std::int32_t raw);

}  // namespace nord_driver::tools
