#include "transport/interbus/modbus_trace.h"

#include "transport/interbus/modbus_packet.h"
#include "transport/interbus/modbus_text.h"

namespace nord_driver {

ModbusTrace::ModbusTrace(const InterbusConfig& config)
    : trace_(kLinkTypeRawIp, ModbusText{config}, TelegramTrace::kCapacity, ModbusText::raw) {}

void ModbusTrace::handleTelegram(const link::HeardTelegram& telegram) noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  const TraceKind kind = telegram.sent ? TraceKind::kSent : TraceKind::kReceived;
  for (std::size_t at = 0; at < telegram.bytes.size(); at += kLongestPacket - kPacketHeader) {
    trace_.record(kind, toPacket(telegram, at), telegram.time);
  }
}

}  // namespace nord_driver
