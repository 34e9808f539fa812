// The telegrams of a gateway's connections as the trace has them.
#pragma once

#include <mutex>

#include "link/modbus/telegram_listener.h"
#include "nord_driver/trace/telegram_trace.h"
#include "transport/interbus/interbus_config.h"

namespace nord_driver {

/// Two connections have a thread each, and the ring takes one writer: they wait for each other, and the bus cycle for
/// none.
class ModbusTrace final : public link::TelegramListener {
 public:
  explicit ModbusTrace(const InterbusConfig& config);

  void handleTelegram(const link::HeardTelegram& telegram) noexcept override;
  const TelegramTrace& trace() const noexcept { return trace_; }

 private:
  std::mutex mutex_;
  TelegramTrace trace_;
};

}  // namespace nord_driver
