// The signals of a drive as configured: single bits users switch and read, and analogue inputs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/bus_report.h"

namespace nord_driver::cycle {

enum class SignalSource : std::uint8_t {
  kBusInBit,      ///< to the inverter: bit 0..7 of the setpoint that carries bus I/O in bits
  kControlBit,    ///< to the inverter: bit 8 or 9 of the control word
  kModuleOutput,  ///< to the bus module: DO1, DO2
  kBusOutBit,     ///< from the inverter: bit 0..7 of the actual value that carries bus I/O out bits
  kStatusBit,     ///< from the inverter: bit 10 or 13 of the status word
  kDigitalInput,  ///< from the inverter: a terminal, by the actual value with the state of inputs and outputs
  kRelay,         ///< from the inverter: a relay or digital output, in the same word
  kModuleInput,   ///< from the bus module: DI1 to DI4
  kAnalogInput,   ///< from the inverter: 1, 2, by an actual value of its own
};

/// Users switch it; otherwise they read it.
constexpr bool isOutput(SignalSource source) noexcept {
  return source == SignalSource::kBusInBit || source == SignalSource::kControlBit ||
         source == SignalSource::kModuleOutput;
}

struct SignalSetup {
  std::string name;
  SignalSource source = SignalSource::kModuleOutput;
  std::uint8_t number = 1;  ///< as its source counts: bus_in_bit_0 has 0, module_output_1 has 1
  bool hold = false;        ///< an output: stays as commanded; otherwise it goes off with the time-out
  bool may_move = false;    ///< an output: its function in P480 may be one that can move, enable or acknowledge
};

/// Each source can be an output once.
constexpr std::size_t kMaxSignalOutputs = 8 + 2 + 2;

/// Throws ConfigError.
std::vector<SignalSetup> readSignals(const Settings& drive, profile::Series series);

/// Throws ConfigError where the bus does not carry what the signals need.
void checkSignalsCarried(const Settings& drive, const std::vector<SignalSetup>& signals, const DriveIdentity& identity);

/// "bus_in_bit_3".
std::string sourceText(const SignalSetup& signal);

/// The element of P480 that says what an output does in the inverter; none for outputs of the module.
std::optional<std::uint8_t> busBitElement(const SignalSetup& signal) noexcept;

/// The bit of "digital I/O status" that shows a terminal or a relay; none where the series has no such one (BU 0020
/// 6.1.2, 6.2.2, 7.3.7; BU 0280 5.1.3).
std::optional<std::uint8_t> digitalIoBit(const SignalSetup& signal, profile::Series series) noexcept;

}  // namespace nord_driver::cycle
