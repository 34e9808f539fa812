#include "link/serial/uart_requests.h"

#include <asm/termbits.h>
#include <errno.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

namespace nord_driver::link::uart {

namespace {

template <typename Argument>
int request(int descriptor, unsigned long what, Argument argument) noexcept {
  return ::ioctl(descriptor, what, argument) == 0 ? 0 : -errno;
}

}  // namespace

int setLine(int descriptor, BaudRate rate) noexcept {
  struct termios2 line {};
  if (const int error = request(descriptor, TCGETS2, &line)) return error;
  // termios2, because PROFIBUS rates such as 93.75 and 187.5 kbit/s have no constant of their own. 8E1 (EN 50170: 8
  // data bits, even parity, 1 stop bit), no flow control, no translation. INPCK without PARMRK turns a character with a
  // parity error into a zero, which the telegram's checksum then rejects.
  line.c_iflag = INPCK;
  line.c_oflag = 0;
  line.c_lflag = 0;
  line.c_cflag = CS8 | CREAD | CLOCAL | PARENB | BOTHER | (BOTHER << IBSHIFT);
  line.c_ispeed = rate.bitsPerSecond();
  line.c_ospeed = rate.bitsPerSecond();
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  return request(descriptor, TCSETS2, &line);
}

int readLine(int descriptor, LineState& state) noexcept {
  struct termios2 line {};
  if (const int error = request(descriptor, TCGETS2, &line)) return error;
  state.output_rate = line.c_ospeed;
  state.input_rate = line.c_ispeed;
  state.even_parity = (line.c_cflag & PARENB) != 0 && (line.c_cflag & (PARODD | CMSPAR)) == 0;
  state.eight_data_bits = (line.c_cflag & CSIZE) == CS8;
  state.one_stop_bit = (line.c_cflag & CSTOPB) == 0;
  return 0;
}

int setRs485(int descriptor, const Rs485Settings& settings) noexcept {
  struct serial_rs485 raw {};
  if (settings.enabled) raw.flags |= SER_RS485_ENABLED;
  if (settings.rts_on_send) raw.flags |= SER_RS485_RTS_ON_SEND;
  if (settings.rts_after_send) raw.flags |= SER_RS485_RTS_AFTER_SEND;
  if (settings.rx_during_tx) raw.flags |= SER_RS485_RX_DURING_TX;
  raw.delay_rts_before_send = settings.delay_before_ms;
  raw.delay_rts_after_send = settings.delay_after_ms;
  return request(descriptor, TIOCSRS485, &raw);
}

int readRs485(int descriptor, Rs485Settings& settings) noexcept {
  struct serial_rs485 raw {};
  if (const int error = request(descriptor, TIOCGRS485, &raw)) return error;
  settings.enabled = (raw.flags & SER_RS485_ENABLED) != 0;
  settings.rts_on_send = (raw.flags & SER_RS485_RTS_ON_SEND) != 0;
  settings.rts_after_send = (raw.flags & SER_RS485_RTS_AFTER_SEND) != 0;
  settings.rx_during_tx = (raw.flags & SER_RS485_RX_DURING_TX) != 0;
  settings.delay_before_ms = raw.delay_rts_before_send;
  settings.delay_after_ms = raw.delay_rts_after_send;
  return 0;
}

int requestLowLatency(int descriptor) noexcept {
  struct serial_struct serial {};
  if (const int error = request(descriptor, TIOCGSERIAL, &serial)) return error;
  serial.flags |= ASYNC_LOW_LATENCY;
  return request(descriptor, TIOCSSERIAL, &serial);
}

int readCounters(int descriptor, RawLineCounters& counters) noexcept {
  struct serial_icounter_struct raw {};
  if (const int error = request(descriptor, TIOCGICOUNT, &raw)) return error;
  counters.parity = static_cast<std::uint32_t>(raw.parity);
  counters.framing = static_cast<std::uint32_t>(raw.frame);
  counters.overrun = static_cast<std::uint32_t>(raw.overrun);
  counters.buffer_overrun = static_cast<std::uint32_t>(raw.buf_overrun);
  return 0;
}

int flushInput(int descriptor) noexcept {
  return request(descriptor, TCFLSH, TCIFLUSH);
}

int flushOutput(int descriptor) noexcept {
  return request(descriptor, TCFLSH, TCOFLUSH);
}

}  // namespace nord_driver::link::uart
