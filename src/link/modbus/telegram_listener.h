// Hears every telegram of a connection to a Modbus/TCP server, to record it.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// One telegram, and where it stands in its connection.
struct HeardTelegram {
  bool sent = false;  ///< a request; otherwise an answer, good or bad
  ByteView bytes;     ///< header and all
  Instant time{};     ///< sent: before its first byte; received: when its last byte was read
  /// The first register it is about; an answer does not say that itself.
  std::uint16_t first_register = 0;
  // Of the connection. IPv4 addresses in the order of the host; 0: it has none.
  std::uint32_t own_address = 0, server_address = 0;
  std::uint16_t own_port = 0, server_port = 0;
  std::uint32_t bytes_sent = 0, bytes_received = 0;  ///< before this telegram
};

/// Called by the threads of the links, two at the same time where there are two connections. Must not wait for anybody
/// who works, nor take memory.
class TelegramListener {
 public:
  virtual ~TelegramListener() = default;
  virtual void handleTelegram(const HeardTelegram& telegram) noexcept = 0;
};

}  // namespace nord_driver::link
