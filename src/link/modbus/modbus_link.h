// The images of a Modbus/TCP server, moved by a thread that owns the socket, so that the bus cycle waits for nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "core/latest_value.h"
#include "link/modbus/modbus_connection.h"
#include "link/modbus/modbus_exchange.h"
#include "link/modbus/register_link.h"

namespace nord_driver::link {

/// Connects, exchanges once for each output image given, and connects again after a pause when something went wrong:
/// first_pause, doubled up to longest_pause, and first_pause again once an exchange was good.
///
/// give(), take() and report() neither wait nor take memory: images change hands in triple buffers.
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
  const RegisterInputs& take() noexcept override { return inputs_.read(); }
  const LinkReport& report() noexcept override { return reports_.read(); }
  bool waitAnswers(Instant until) noexcept override;
  Instant now() const noexcept override { return std::chrono::steady_clock::now(); }
  void sleepUntil(Instant when) noexcept override;

 private:
  struct Outputs {
    std::uint64_t number = 0;
    RegisterImage words;
  };

  void work() noexcept;
  bool connect() noexcept;
  void exchangeOnce() noexcept;
  void waitForOutputs() noexcept;
  void failed() noexcept;
  void pause(Instant until) noexcept;
  void count(ModbusTrouble trouble) noexcept;
  void tell(LinkState state) noexcept;
  bool ending() const noexcept { return ending_.load(std::memory_order_relaxed); }

  const ModbusSettings settings_;
  ModbusConnection connection_;
  ModbusExchange exchange_;
  Sentence problem_;  // with the settings

  // Of the cycle.
  std::uint64_t given_ = 0;
  std::thread thread_;

  // Between the threads.
  LatestValue<Outputs> outputs_;
  LatestValue<RegisterInputs> inputs_;
  LatestValue<LinkReport> reports_;
  Wakeup fresh_;    // outputs were given
  Wakeup answers_;  // inputs or a report
  Wakeup stop_;
  std::atomic<bool> ending_{false};

  // Of the thread.
  RegisterInputs newest_;
  LinkReport report_;
  std::uint64_t last_outputs_ = 0;
  Duration pause_{};
  bool started_ = false;  // the watchdog is set on this connection
};

}  // namespace nord_driver::link
