// Takes orders from the thread of the bus cycle to the one that has the connection, and the answers back.
#pragma once

#include <cstdint>

#include "core/latest_value.h"
#include "link/modbus/modbus_acyclic.h"
#include "link/modbus/register_link.h"
#include "link/modbus/register_order.h"
#include "link/modbus/wakeup.h"

namespace nord_driver::link {

/// Nobody waits and nothing takes memory. A newer order takes the place of one that still waits.
class OrderDesk {
 public:
  // The cycle's thread.
  std::uint64_t place(const RegisterOrder& order) noexcept {
    orders_.write({++placed_, order});
    return placed_;
  }
  const RegisterAnswer& answer() noexcept { return answers_.read(); }

  // The connection's thread.
  /// Carries out the order that waits. False: it failed by the connection, which is of no use any more. Only an
  /// exception is counted: what is wrong with a connection counts whoever ends it.
  bool serve(ModbusAcyclic& acyclic, const ModbusConnection& connection, const Wakeup& stop,
             LinkCounters& counters) noexcept {
    const Numbered& newest = orders_.read();
    if (newest.number == served_) return true;
    served_ = newest.number;
    RegisterAnswer answer;
    answer.number = newest.number;
    const bool good = acyclic.carryOut(newest.order, answer, stop);
    answers_.write(answer);
    if (good) return true;
    if (connection.trouble() != ModbusTrouble::kException) return false;
    ++counters.exceptions;
    return true;
  }
  /// Gives up the order that waits: there is no connection.
  void refuse(const Sentence& reason) noexcept {
    const Numbered& newest = orders_.read();
    if (newest.number == served_) return;
    served_ = newest.number;
    RegisterAnswer answer;
    answer.number = newest.number;
    answer.not_taken = true;
    answer.text = reason;
    answers_.write(answer);
  }

 private:
  struct Numbered {
    std::uint64_t number = 0;
    RegisterOrder order;
  };

  std::uint64_t placed_ = 0;
  std::uint64_t served_ = 0;
  LatestValue<Numbered> orders_;
  LatestValue<RegisterAnswer> answers_;
};

}  // namespace nord_driver::link
