#include "transport/profibus/serial_line_config.h"

#include "config/setting_checks.h"

namespace nord_driver {

namespace {

// The kernel takes whole milliseconds, and no more than 100 of them.
std::uint32_t readDelay(const Settings& bus, const std::string& key) {
  const Duration delay = wholeMillisecondsOr(bus, key, Duration::zero(), Duration::zero(),
                                             std::chrono::milliseconds{100}, "0.001 s: Linux counts no others");
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(delay).count());
}

link::Rs485Settings readRs485(const Settings& bus) {
  link::Rs485Settings rs485;
  rs485.enabled = booleanOr(bus, "rs485/enabled", rs485.enabled);
  rs485.rts_on_send = booleanOr(bus, "rs485/rts_on_send", rs485.rts_on_send);
  rs485.rts_after_send = booleanOr(bus, "rs485/rts_after_send", rs485.rts_after_send);
  rs485.rx_during_tx = booleanOr(bus, "rs485/rx_during_tx", rs485.rx_during_tx);
  rs485.delay_before_ms = readDelay(bus, "rs485/delay_before");
  rs485.delay_after_ms = readDelay(bus, "rs485/delay_after");
  if (rs485.enabled && rs485.rts_on_send == rs485.rts_after_send) {
    throw wrongSetting(bus, "rs485/rts_after_send", rs485.rts_after_send ? "true" : "false",
                       "the opposite of rts_on_send: RTS would never switch the sender off");
  }
  return rs485;
}

std::optional<bool> asBoolean(const Settings& bus, const std::string& key) {
  try {
    return bus.boolean(key);
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

link::EchoMode readEcho(const Settings& bus) {
  // YAML makes a boolean of an unquoted on or off.
  if (const auto flag = asBoolean(bus, "echo")) return *flag ? link::EchoMode::kOn : link::EchoMode::kOff;
  const std::string text = wordOr(bus, "echo", "auto", "auto, off, on");
  if (text == "auto") return link::EchoMode::kAuto;
  if (text == "off") return link::EchoMode::kOff;
  if (text == "on") return link::EchoMode::kOn;
  throw wrongSetting(bus, "echo", "\"" + text + "\"", "auto, off or on");
}

}  // namespace

link::SerialSettings readSerialLine(const Settings& bus) {
  link::SerialSettings line;
  line.device = requiredText(bus, "device", "a serial device such as /dev/ttyUSB0");
  line.rs485 = readRs485(bus);
  line.echo = readEcho(bus);
  line.follow_adapter = booleanOr(bus, "follow_adapter", line.follow_adapter);
  return line;
}

}  // namespace nord_driver
