// Compact PCP as the simulated gateway offers it: a block of registers to invoke services, and one for their results.
//
// BU 0070 6.3: initiate, read and write, one word of parameter channel per ring cycle, parameters as objects 2000h +
// number. What the manual leaves out is from others: numbers of services and confirmations (ABB NIBA-01, chapter 6), of
// errors (Lenze EDSIBS 5.6.8), sub-indices as on CANopen (BU 0060 p. 61). The blocks are the simulator's own.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/interbus/ibs_ring.h"

namespace nord_driver::sim {

class PcpServer {
 public:
  /// `ring` must outlive it.
  PcpServer(const IbsPcp& config, IbsRing& ring);

  void advance(Instant now) noexcept;
  bool hasInvoke(unsigned address) const noexcept { return in(address, config_.invoke_address); }
  bool hasResult(unsigned address) const noexcept { return in(address, config_.result_address); }
  Word invokeAt(unsigned address) const noexcept { return invoke_[address - config_.invoke_address]; }
  Word resultAt(unsigned address) const noexcept { return result_[address - config_.result_address]; }
  void write(unsigned address, Word value) noexcept;
  /// After the last word of a request was written: the service in the block is carried out, once.
  void invoked(Instant now) noexcept;

  std::uint64_t services() const noexcept { return services_; }

 private:
  static constexpr unsigned kWords = 7;

  struct Error {
    unsigned class_and_code = 0;
    unsigned additional = 0;
  };

  static bool in(unsigned address, unsigned block) noexcept { return address >= block && address - block < kWords; }
  void carryOut() noexcept;
  Error access(DriveUnit& drive, bool write) noexcept;
  std::optional<std::size_t> driveOf(Word reference) const noexcept;

  IbsPcp config_;
  IbsRing& ring_;
  std::array<Word, kWords> invoke_{}, order_{}, result_{};
  std::vector<bool> connected_;  // by drive
  std::optional<Instant> due_;
  std::uint64_t services_ = 0;
};

}  // namespace nord_driver::sim
