// What the simulated gateway answers on Modbus/TCP: the ring's words as registers, and a watchdog.
//
// Written from MODBUS Messaging on TCP/IP V1.0b and MODBUS Application Protocol V1.1b3.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "sim/interbus/ibs_ring.h"
#include "sim/interbus/pcp_server.h"

namespace nord_driver::sim {

/// Header (7 bytes) and at most 253 bytes.
constexpr std::size_t kLongestModbus = 260;
using ModbusBytes = FixedBytes<kLongestModbus>;

/// The length of the request `bytes` begin with; 0: not enough of it is there, or it is none.
std::size_t modbusLength(ByteView bytes) noexcept;

/// What an experimenter does to the answers.
struct GatewaySwitches {
  bool silent = false;                      ///< requests are carried out, and not answered
  Duration delay{0};                        ///< answers come that much later
  std::optional<std::uint8_t> exception{};  ///< every request is refused with this code
  std::uint16_t wrong_transaction = 0;      ///< added to the transaction number of the answers
};

class RegisterGateway {
 public:
  /// `ring` must outlive it.
  RegisterGateway(const IbsBusConfig& config, IbsRing& ring);

  /// The watchdog: without a write for its time the outputs become 0.
  void advance(Instant now) noexcept;
  /// The answer to one whole request; empty: none is given.
  ModbusBytes handle(ByteView request, Instant now) noexcept;

  void setSwitches(const GatewaySwitches& switches) noexcept { switches_ = switches; }
  const GatewaySwitches& switches() const noexcept { return switches_; }
  /// Requests that write registers, since the beginning.
  std::uint64_t writes() const noexcept { return writes_; }
  /// Requests that read registers.
  std::uint64_t reads() const noexcept { return reads_; }
  std::uint64_t watchdogTrips() const noexcept { return watchdog_trips_; }

 private:
  std::uint8_t execute(ByteReader& request, std::uint8_t function, ByteWriter<kLongestModbus>& answer,
                       Instant now) noexcept;
  std::uint8_t read(unsigned first, unsigned count, bool holding, ByteWriter<kLongestModbus>& answer) noexcept;
  std::uint8_t write(unsigned first, unsigned count, ByteReader& values, Instant now) noexcept;
  std::optional<Word> registerAt(unsigned address, bool holding) const noexcept;
  Word turned(Word word) const noexcept;

  IbsBusConfig config_;
  IbsRing& ring_;
  GatewaySwitches switches_;
  Word watchdog_ = 0;  // ms
  std::optional<Instant> last_write_;
  std::uint64_t watchdog_trips_ = 0;
  std::uint64_t writes_ = 0;
  std::uint64_t reads_ = 0;
  std::optional<PcpServer> pcp_;
};

}  // namespace nord_driver::sim
