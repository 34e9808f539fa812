// What a Modbus/TCP link is told when it is made: the server, and which registers are whose.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/register_image.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

class TelegramListener;

/// The functions used, by their codes (MODBUS Application Protocol V1.1b3, chapter 6).
enum class ModbusFunction : std::uint8_t {
  kReadHoldingRegisters = 3,
  kReadInputRegisters = 4,
  kWriteRegisters = 16,
  kReadWriteRegisters = 23,  ///< writes, then reads, in one request
};

/// What one request carries at most (chapters 6.3, 6.12, 6.17).
constexpr std::uint16_t kMostReadRegisters = 125;
constexpr std::uint16_t kMostWriteRegisters = 123;
constexpr std::uint16_t kMostReadWriteWrites = 121;

constexpr std::uint16_t mostRegistersWritten(ModbusFunction function) noexcept {
  return function == ModbusFunction::kReadWriteRegisters ? kMostReadWriteWrites : kMostWriteRegisters;
}

/// An image in the server's registers.
struct RegisterBlock {
  ModbusFunction function;
  std::uint16_t address = 0;       ///< register of the image's first word
  std::vector<WordRange> parts{};  ///< the words of the image to move, each part by one request; none: not moved
};

/// A register that says whether the bus behind the server runs.
struct RunningFlag {
  ModbusFunction function = ModbusFunction::kReadHoldingRegisters;
  std::uint16_t address = 0;
  Word mask = 1;
  Word value = 1;  ///< of the masked bits while it runs
};

/// A register that makes the server stop its outputs when requests stay away.
struct WatchdogRegister {
  std::uint16_t address = 0;
  Word value = 0;  ///< in the server's unit, mostly ms
};

struct ModbusSettings {
  std::string server;  ///< "192.168.0.10:502", "gateway", "[fe80::1]:502"
  /// A second connection, for all that is no image: `running`, the read back of the watchdog, orders. Empty: there is
  /// one connection for everything.
  std::string diagnosis{};
  std::uint8_t unit = 1;
  RegisterBlock inputs{ModbusFunction::kReadInputRegisters};
  RegisterBlock outputs{ModbusFunction::kWriteRegisters};
  /// Where the output image has control words, and their bits that are all 1 while a drive may move. Where the image
  /// takes several requests, the one in which most of them stop goes first.
  std::vector<std::uint16_t> control_words{};
  Word run_bits = 0;
  std::optional<RunningFlag> running{};
  std::optional<WatchdogRegister> watchdog{};
  Duration response_timeout{std::chrono::milliseconds{300}};  ///< of each request
  Duration connect_timeout{std::chrono::milliseconds{800}};   ///< name and connection
  Duration first_pause{std::chrono::milliseconds{50}};        ///< before the next connection; doubles
  Duration longest_pause{std::chrono::milliseconds{500}};
  /// Hears all telegrams; must outlive the link. None: nobody does.
  TelegramListener* listener = nullptr;
};

/// Host and port of "HOST", "HOST:PORT" or "[IPv6]:PORT".
struct ServerName {
  std::string host;
  std::uint16_t port = 502;  ///< the port of Modbus/TCP
};
/// None: `reason` says what was expected.
std::optional<ServerName> serverName(const std::string& text, Sentence& reason);

/// False: `reason` names the setting, its value and what was expected.
bool checkModbusSettings(const ModbusSettings& settings, Sentence& reason);

}  // namespace nord_driver::link
