// What a serial line is told at its opening.
#pragma once

#include <cstdint>
#include <string>

#include "core/baud_rate.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// Who switches an RS-485 adapter between sending and listening. Most adapters do it by themselves; a bare UART with a
/// transceiver has the kernel do it with RTS (TIOCSRS485).
struct Rs485Settings {
  bool enabled = false;               ///< false: the driver is not asked, whatever it was told before stays
  bool rts_on_send = true;            ///< level of RTS while sending
  bool rts_after_send = false;        ///< level of RTS otherwise
  bool rx_during_tx = false;          ///< the receiver hears what we send: an echo
  std::uint32_t delay_before_ms = 0;  ///< between RTS and the first bit, 0..100 ms
  std::uint32_t delay_after_ms = 0;   ///< between the last bit and RTS, 0..100 ms
};

/// Whether our own telegrams come back to us before the answers.
enum class EchoMode : std::uint8_t {
  kAuto,  ///< found out from the first telegrams
  kOff,
  kOn,
};

struct SerialSettings {
  std::string device;  ///< "/dev/ttyUSB0", a link below /dev/serial/by-id, or a link to a pty
  BaudRate baud_rate{500'000};
  Rs485Settings rs485{};
  EchoMode echo = EchoMode::kAuto;
  bool follow_adapter = true;  ///< a plain device that vanished is taken under another name, by its USB serial number
};

}  // namespace nord_driver::link
