// A Modbus telegram of the gateway in a few words: what it asks or answers, and the process data by the manual's names.
#pragma once

#include <string>

#include "nord_driver/trace/telegram_trace.h"
#include "transport/interbus/interbus_config.h"
#include "transport/interbus/modbus_packet.h"

namespace nord_driver {

/// "write 100 to 103: left STW 047F SW1 2000, right STW 047E SW1 0000". Registers are decimal, words hexadecimal, as
/// they mean, not as they lie there.
class ModbusText {
 public:
  explicit ModbusText(const InterbusConfig& config) : config_(config) {}

  std::string operator()(const TraceRecord& record) const;
  /// The bytes of the telegram, without the headers that were made up around them.
  static std::string raw(const TraceRecord& record);

 private:
  std::string request(ByteView bytes) const;
  std::string answer(ByteView bytes, unsigned first) const;
  std::string words(ByteView values, unsigned first, bool written) const;
  std::string drives(ByteView values, unsigned first, bool written) const;

  InterbusConfig config_;
};

}  // namespace nord_driver
