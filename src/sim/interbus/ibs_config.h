// What is configured of a simulated InterBus ring and its gateway beside the drives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/sim_config.h"

namespace nord_driver::sim {

struct BusKind;

/// `DriveConfig::bus` of a drive in the ring. Its address is its place there.
struct IbsDriveConfig {
  bool drivecom = false;  ///< P551 on
  unsigned ppo_type = 1;  ///< P507: 1 or 2
  /// Words from the image's start; none: behind the drive before it in the ring.
  std::optional<unsigned> input_offset{};
  std::optional<unsigned> output_offset{};
  bool array_sub_by_table = false;  ///< PCP sub-index 4 (n - 1) + 1 instead of n, of arrays without sets
};

/// A register that says whether the ring runs: `value` in the bits of `mask` while it does, and 0 otherwise.
struct IbsRunning {
  unsigned address = 0;
  Word mask = 1;
  Word value = 1;
};

/// Compact PCP by registers: two blocks of seven holding registers each (`PcpServer`).
struct IbsPcp {
  unsigned invoke_address = 0;
  unsigned result_address = 0;
  unsigned first_reference = 2;  ///< communication reference of the first drive of the ring; the next ones follow
  bool initiate = true;          ///< connections have to be initiated first
};

/// `SimConfig::bus` of an InterBus ring.
struct IbsBusConfig {
  std::string gateway = "127.0.0.1:0";  ///< of the loopback; port 0: a free one
  unsigned unit = 1;
  unsigned input_address = 0;   ///< input and holding registers
  unsigned output_address = 0;  ///< holding registers; where both images have a register it is read as an input
  bool swapped = false;         ///< the bytes of each word
  bool pcp_word = false;
  std::optional<IbsRunning> running{};
  std::optional<unsigned> watchdog{};  ///< holding register, ms; 0 there: off
  std::optional<IbsPcp> pcp{};
};

/// Port of "127.0.0.1:PORT" or "localhost:PORT". Throws ConfigError.
std::uint16_t gatewayPort(const std::string& gateway);

/// The driver's own keys: `bus: {gateway: 127.0.0.1:1502, inputs: {address: 0}, ...}`, of a drive `ppo_type`,
/// `profile`, `array_sub_index`, `input_offset` and `output_offset`.
BusKind interbusKind();

}  // namespace nord_driver::sim
