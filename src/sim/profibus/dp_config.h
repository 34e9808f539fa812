// What is configured of a simulated PROFIBUS segment beside its drives.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/profibus/class2_server.h"
#include "sim/profibus/record_server.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

struct BusKind;

/// `DriveConfig::bus` of a drive on PROFIBUS.
struct DpDriveConfig {
  int ppo_type = 1;              ///< 1-4, set by switch or P507; behind a module with slots the master chooses
  std::uint16_t ident = 0x7531;  ///< of a module of its own, BU 0020 10.2
};

struct ModuleSettings {
  std::uint8_t address = 126;
  /// What Get_Cfg says before a master has configured the module: slot 1 is 30h.
  bool io_byte = false;
  std::uint8_t inputs = 0;           ///< DIN1-DIN4 in bits 0-3
  std::uint32_t baud_rate = 500000;  ///< what P181 shows
  RecordSettings records;
  Class2Settings class2;
};

/// A bus module with slots. One that is not listed is there all the same, as its drives say.
struct ModuleConfig {
  std::string name;
  ModuleSettings settings;
  std::vector<ParameterPreset> parameters;  ///< P150-P160 of the module
};

/// `SimConfig::bus` of a PROFIBUS segment.
struct DpBusConfig {
  std::string device = "/tmp/nord_sim_bus";  ///< the link the programs put to their pty
  std::uint32_t baud_rate = 500000;
  std::vector<ModuleConfig> modules;
};

/// `bus: {device: PATH, baud_rate: 500000}`, of a drive `module`, `inverter`, `io_byte`, `ppo_type` and
/// `double_word_answers`, and the group `modules`.
BusKind profibusKind();

}  // namespace nord_driver::sim
