// The second connection to a server, in a thread of its own: what is no image goes over it, so that the first one
// carries nothing but images.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "core/latest_value.h"
#include "link/modbus/backoff.h"
#include "link/modbus/modbus_acyclic.h"
#include "link/modbus/modbus_connection.h"
#include "link/modbus/order_desk.h"
#include "link/modbus/register_link.h"

namespace nord_driver::link {

/// What the images' thread is told.
struct DiagnosisState {
  RunningState running;
  std::uint64_t watchdog_read = 0;  ///< the question of askWatchdog() that was answered last
  bool watchdog_held = false;
  Sentence watchdog_text;  ///< why it is not held
  Sentence text;           ///< what is wrong with the connection; empty when nothing is
};

/// Connects, and connects again, by itself while it is open.
class DiagnosisConnection {
 public:
  /// `settings.diagnosis` is the server.
  explicit DiagnosisConnection(const ModbusSettings& settings, LookUp look_up);
  ~DiagnosisConnection();
  DiagnosisConnection(const DiagnosisConnection&) = delete;
  DiagnosisConnection& operator=(const DiagnosisConnection&) = delete;

  /// Throws std::system_error without a thread.
  void open();
  void close() noexcept;

  // The cycle's thread.
  std::uint64_t order(const RegisterOrder& order) noexcept;
  const RegisterAnswer& answer() noexcept { return desk_.answer(); }
  const LinkReport& report() noexcept { return reports_.read(); }

  // The images' thread. None waits but waitTold().
  /// Asks for the running register once more.
  void ask() noexcept { asked_.signal(); }
  /// Asks for the watchdog to be read back; the number of the question.
  std::uint64_t askWatchdog() noexcept;
  const DiagnosisState& state() noexcept { return states_.read(); }
  /// Until something new was told, `until` has come or `stop` was signalled.
  void waitTold(Instant until, const Wakeup& stop) noexcept;

 private:
  void work() noexcept;
  bool connect() noexcept;
  bool serve() noexcept;
  /// False: it refused once, and is asked anew with the next exchange.
  bool pausedAfterFailure() noexcept;
  void tell(LinkState link) noexcept;
  bool ending() const noexcept { return ending_.load(std::memory_order_relaxed); }

  const ModbusSettings settings_;  // with this server in the place of the images'
  ModbusConnection connection_;
  ModbusAcyclic acyclic_;
  Backoff backoff_;
  OrderDesk desk_;
  std::thread thread_;

  // Between the threads.
  LatestValue<DiagnosisState> states_;
  LatestValue<LinkReport> reports_;
  Wakeup asked_;
  Wakeup told_;
  Wakeup stop_;
  std::atomic<bool> ending_{false};
  std::atomic<std::uint64_t> watchdog_asked_{0};

  // Of the thread.
  DiagnosisState state_;
  LinkReport report_;
};

}  // namespace nord_driver::link
