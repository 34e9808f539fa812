// The images of a Modbus/TCP server, moved by a thread that owns the socket, so that the bus cycle waits for nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

#include "core/latest_value.h"
#include "link/modbus/backoff.h"
#include "link/modbus/diagnosis_connection.h"
#include "link/modbus/modbus_acyclic.h"
#include "link/modbus/modbus_connection.h"
#include "link/modbus/modbus_exchange.h"
#include "link/modbus/order_desk.h"
#include "link/modbus/register_link.h"

namespace nord_driver::link {

/// Connects, exchanges once for each output image given, and connects again after a pause when something went wrong:
/// first_pause, doubled up to longest_pause, and first_pause again once an exchange was good. The first exception after a
/// good exchange takes no pause, but counts as one: the next image is the next try.
///
/// Before the watchdog is set, and read back, no image is written but one that stops what an earlier connection may have
/// left running: a server that refuses its watchdog register may take words all the same.
///
/// With `settings.diagnosis` the running register, the read back of the watchdog and orders go over a second connection;
/// without it they take turns with the images. The inputs are never younger than what is known of the running register,
/// so a second connection that fails makes them old, too.
///
/// give(), order(), take(), answer() and report() neither wait nor take memory: what they pass on lies in triple
/// buffers.
class ModbusLink final : public RegisterLink {
 public:
  /// `settings` that do not pass checkModbusSettings() keep it from opening.
  explicit ModbusLink(const ModbusSettings& settings, LookUp look_up = ::getaddrinfo);
  ~ModbusLink() override;
  ModbusLink(const ModbusLink&) = delete;
  ModbusLink& operator=(const ModbusLink&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept { return thread_.joinable(); }
  std::uint64_t give(const RegisterImage& outputs) noexcept override;
  std::uint64_t look() noexcept override;
  std::uint64_t order(const RegisterOrder& order) noexcept override;
  const RegisterAnswer& answer() noexcept override { return diagnosis_ ? diagnosis_->answer() : desk_.answer(); }
  const RegisterInputs& take() noexcept override { return inputs_.read(); }
  const LinkReport& report() noexcept override;
  bool waitAnswers(Instant until) noexcept override;
  Instant now() const noexcept override { return std::chrono::steady_clock::now(); }
  void sleepUntil(Instant when) noexcept override;

 private:
  struct Outputs {
    std::uint64_t number = 0;
    RegisterImage words;
    bool only_reads = false;
  };

  void work() noexcept;
  bool connect() noexcept;
  /// An image that was not tried yet. Not a look, which has no words.
  bool stops(const Outputs& outputs) const noexcept {
    return outputs.number != last_outputs_ && !outputs.only_reads && exchange_.stops(outputs.words);
  }
  bool writeStop() noexcept;
  bool startWatchdog() noexcept;
  bool isWatchdogHeld() noexcept;
  bool exchangeOnce() noexcept;
  bool readRunning() noexcept;
  void waitForOutputs() noexcept;
  void failed() noexcept { failed(connection_.trouble(), connection_.exception()); }
  void failed(ModbusTrouble trouble, unsigned exception) noexcept;
  void pause(Instant until, bool is_kept) noexcept;
  void tell(LinkState state) noexcept;
  bool ending() const noexcept { return ending_.load(std::memory_order_relaxed); }

  const ModbusSettings settings_;
  ModbusConnection connection_;
  ModbusExchange exchange_;
  ModbusAcyclic acyclic_;
  std::optional<DiagnosisConnection> diagnosis_;
  Sentence problem_;  // with the settings

  // Of the cycle.
  std::uint64_t given_ = 0;
  LinkReport whole_report_;  // of both connections
  std::thread thread_;

  // Between the threads.
  LatestValue<Outputs> outputs_;
  LatestValue<RegisterInputs> inputs_;
  LatestValue<LinkReport> reports_;
  OrderDesk desk_;
  Wakeup fresh_;    // outputs or an order were given
  Wakeup answers_;  // inputs or a report
  Wakeup stop_;
  std::atomic<bool> ending_{false};

  // Of the thread.
  RegisterInputs newest_;
  RegisterInputs unwatched_;  // read behind words that stop, before the watchdog was set: nobody is told of them
  LinkReport report_;
  std::uint64_t last_outputs_ = 0;
  Backoff backoff_;
  bool started_ = false;  // the watchdog is set on this connection
};

}  // namespace nord_driver::link
