#include "link/serial/line_setup.h"

#include <errno.h>

#include "link/error_text.h"

namespace nord_driver::link {

namespace {

constexpr double kMaxRateError = 0.005;

double rateError(std::uint32_t wanted, std::uint32_t real) noexcept {
  return (static_cast<double>(real) - wanted) / wanted;
}

bool isOff(std::uint32_t wanted, std::uint32_t real) noexcept {
  const double error = rateError(wanted, real);
  return error > kMaxRateError || error < -kMaxRateError;
}

const char* word(bool value) noexcept {
  return value ? "true" : "false";
}

}  // namespace

bool setUpLine(SerialSystem& system, int descriptor, BaudRate rate, LineDemand demand, Sentence& reason) noexcept {
  const std::uint32_t wanted = rate.bitsPerSecond();
  if (const int result = system.setLine(descriptor, rate)) {
    reason.format("refuses 8E1 at %u bit/s: %s", wanted, ErrorText{-result}.c_str());
    return false;
  }
  LineState real;
  if (const int result = system.readLine(descriptor, real)) {
    reason.format("does not tell its settings: %s", ErrorText{-result}.c_str());
    return false;
  }
  if (demand == LineDemand::kNone) return true;

  const bool input_is_off = real.input_rate != 0 && isOff(wanted, real.input_rate);
  if (isOff(wanted, real.output_rate) || input_is_off) {
    const std::uint32_t nearest = input_is_off ? real.input_rate : real.output_rate;
    reason.format("cannot do %u bit/s: its nearest rate is %u bit/s, %+.1f %% off where 0.5 %% is bearable", wanted,
                  nearest, 100.0 * rateError(wanted, nearest));
    return false;
  }
  if (!real.even_parity) {
    reason.format("cannot do even parity, without which no PROFIBUS station understands a character");
    return false;
  }
  if (!real.eight_data_bits || !real.one_stop_bit) {
    reason.format("cannot do characters of eight data bits and one stop bit");
    return false;
  }
  return true;
}

bool setUpRs485(SerialSystem& system, int descriptor, const Rs485Settings& wanted, Sentence& reason) noexcept {
  if (!wanted.enabled) return true;
  Rs485Settings real;
  int result = system.setRs485(descriptor, wanted);
  if (result == 0) result = system.readRs485(descriptor, real);
  if (result != 0) {
    const bool unknown = result == -ENOTTY || result == -EINVAL || result == -EOPNOTSUPP;
    reason.format("cannot switch RS-485 by RTS (%s)%s", ErrorText{-result}.c_str(),
                  unknown ? ": an adapter that switches by itself needs no bus/rs485" : "");
    return false;
  }
  const auto differs = [&reason](const char* name, bool want, bool got) noexcept {
    if (want != got) reason.format("takes bus/rs485/%s as %s, not as %s", name, word(got), word(want));
    return want != got;
  };
  if (differs("enabled", wanted.enabled, real.enabled) ||
      differs("rts_on_send", wanted.rts_on_send, real.rts_on_send) ||
      differs("rts_after_send", wanted.rts_after_send, real.rts_after_send) ||
      differs("rx_during_tx", wanted.rx_during_tx, real.rx_during_tx)) {
    return false;
  }
  if (wanted.delay_before_ms != real.delay_before_ms || wanted.delay_after_ms != real.delay_after_ms) {
    reason.format("takes bus/rs485/delay_before and delay_after as %u and %u ms, not as %u and %u ms",
                  real.delay_before_ms, real.delay_after_ms, wanted.delay_before_ms, wanted.delay_after_ms);
    return false;
  }
  return true;
}

// An FTDI adapter holds received bytes back for 16 ms unless told not to. Drivers without such a knob refuse: no harm.
void setUpLatency(SerialSystem& system, int descriptor, const char* device, Sentence& warning) noexcept {
  static_cast<void>(system.requestLowLatency(descriptor));
  const int milliseconds = system.latencyTimer(device);
  if (milliseconds > 1) {
    warning.format(
        "%s holds every answer back for up to %d ms: its latency_timer could not be set to 1 ms (a udev rule can, see "
        "doc/adapters.md)",
        device, milliseconds);
  }
}

}  // namespace nord_driver::link
