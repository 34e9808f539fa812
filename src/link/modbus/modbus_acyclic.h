// What is asked of the server beside the images: whether its bus runs, its watchdog, and orders.
#pragma once

#include <cstdint>

#include "link/modbus/modbus_connection.h"
#include "link/modbus/register_order.h"

namespace nord_driver::link {

/// The register that says whether the bus behind the server runs, as read.
struct RunningState {
  bool known = false;
  Instant asked{};
  bool bus_runs = true;  ///< true where no such register is configured
  Word value = 0;
};

class ModbusAcyclic {
 public:
  /// Both are kept by reference.
  ModbusAcyclic(const ModbusSettings& settings, ModbusConnection& connection) noexcept
      : settings_(settings), connection_(connection) {}

  // Each is false when it failed: `reason()`. Without the register in the settings there is nothing to fail.
  bool writeWatchdog(const Wakeup& stop) noexcept;
  /// Reads it back. A server that does not hold it is not used, for it would not do what was counted on.
  bool checkWatchdog(const Wakeup& stop) noexcept;
  bool readRunning(RunningState& state, const Wakeup& stop) noexcept;
  /// One request; `answer` has no number.
  bool carryOut(const RegisterOrder& order, RegisterAnswer& answer, const Wakeup& stop) noexcept;

  const Sentence& reason() const noexcept { return reason_; }
  std::uint64_t requests() const noexcept { return requests_; }

 private:
  bool ask(const ModbusRequest& request, const Wakeup& stop) noexcept;
  bool watchdogFailed() noexcept;

  const ModbusSettings& settings_;
  ModbusConnection& connection_;
  Sentence reason_;
  std::uint64_t requests_ = 0;
};

}  // namespace nord_driver::link
