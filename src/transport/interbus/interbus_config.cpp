#include "transport/interbus/interbus_config.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <string>

#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "profile/process_data_order.h"
#include "transport/interbus/pcp_config.h"

namespace nord_driver {

namespace {

using link::ModbusFunction;
using profile::Series;

constexpr std::int64_t kLastRegister = 65535;
constexpr std::int64_t kLargestWord = 0xFFFF;
constexpr double kLongestWindow = 0.005;  // s, unless somebody wants more

std::uint16_t readRegister(const Settings& bus, const std::string& key) {
  return static_cast<std::uint16_t>(integerOr(bus, key, 0, 0, kLastRegister));
}

bool hasAny(const Settings& settings, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return settings.has(key); });
}

ModbusFunction readFunction(const Settings& bus, const std::string& key, ModbusFunction fallback,
                            std::initializer_list<ModbusFunction> known) {
  std::string codes;
  for (const ModbusFunction function : known) {
    codes += (codes.empty() ? "" : ", ") + std::to_string(static_cast<unsigned>(function));
  }
  noteSetting(bus, key, {"one of " + codes, "", "", std::to_string(static_cast<unsigned>(fallback))});
  const auto code = bus.integer(key);
  if (!code) return fallback;
  for (const ModbusFunction function : known) {
    if (*code == static_cast<std::int64_t>(function)) return function;
  }
  throw wrongSetting(bus, key, std::to_string(*code), "one of the functions " + codes);
}

// One of two words; without any it is the first.
bool isSecond(const Settings& settings, const std::string& key, const std::string& first, const std::string& second) {
  const std::string text = wordOr(settings, key, first, first + ", " + second);
  if (text != first && text != second) throw wrongSetting(settings, key, "\"" + text + "\"", first + " or " + second);
  return text == second;
}

void readBlocks(const Settings& bus, link::ModbusSettings& server) {
  server.inputs.function = readFunction(bus, "inputs/function", ModbusFunction::kReadInputRegisters,
                                        {ModbusFunction::kReadHoldingRegisters, ModbusFunction::kReadInputRegisters,
                                         ModbusFunction::kReadWriteRegisters});
  server.inputs.address = readRegister(bus, "inputs/address");
  const bool both = server.inputs.function == ModbusFunction::kReadWriteRegisters;
  server.outputs.function = readFunction(bus, "outputs/function",
                                         both ? ModbusFunction::kReadWriteRegisters : ModbusFunction::kWriteRegisters,
                                         {ModbusFunction::kWriteRegisters, ModbusFunction::kReadWriteRegisters});
  server.outputs.address = readRegister(bus, "outputs/address");
}

std::optional<link::RunningFlag> readRunning(const Settings& bus, ModbusFunction inputs) {
  if (!hasAny(bus, {"running/address", "running/function", "running/mask", "running/value"})) return std::nullopt;
  link::RunningFlag flag;
  const bool as_inputs = inputs == ModbusFunction::kReadInputRegisters;
  flag.function = readFunction(bus, "running/function",
                               as_inputs ? ModbusFunction::kReadInputRegisters : ModbusFunction::kReadHoldingRegisters,
                               {ModbusFunction::kReadHoldingRegisters, ModbusFunction::kReadInputRegisters});
  flag.address = static_cast<std::uint16_t>(requiredInteger(bus, "running/address", 0, kLastRegister));
  flag.mask = static_cast<Word>(integerOr(bus, "running/mask", 1, 1, kLargestWord));
  flag.value = static_cast<Word>(integerOr(bus, "running/value", flag.mask, 0, kLargestWord));
  if ((flag.value & ~flag.mask) != 0) {
    throw wrongSetting(
        bus, "running/value", std::to_string(flag.value),
        "no other bits than running/mask, " + std::to_string(flag.mask) + ", has: the ring would never seem to run");
  }
  return flag;
}

std::optional<link::WatchdogRegister> readWatchdog(const Settings& bus) {
  if (!hasAny(bus, {"watchdog/address", "watchdog/value"})) return std::nullopt;
  link::WatchdogRegister watchdog;
  watchdog.address = static_cast<std::uint16_t>(requiredInteger(bus, "watchdog/address", 0, kLastRegister));
  watchdog.value = static_cast<Word>(requiredInteger(bus, "watchdog/value", 1, kLargestWord));
  return watchdog;
}

void checkWatchdog(const Settings& bus, const link::ModbusSettings& server) {
  if (!server.watchdog) return;
  for (const WordRange& part : server.outputs.parts) {
    const unsigned first = server.outputs.address + part.first, end = server.outputs.address + part.end();
    if (server.watchdog->address < first || server.watchdog->address >= end) continue;
    throw wrongSetting(bus, "watchdog/address", std::to_string(server.watchdog->address),
                       "a register outside the output image, which takes registers " + std::to_string(first) + " to " +
                           std::to_string(end - 1));
  }
}

// SK TU1, TU2 and TU3-IBS (BU 0070 2).
void checkSeries(const Settings& settings, Series series) {
  for (const Series known : {Series::kSk300e, Series::kSk5xxe, Series::kSk700e, Series::kSk750e}) {
    if (series == known) return;
  }
  throw wrongSetting(settings, "series", std::string("\"") + profile::toString(series) + "\"",
                     "a series that takes an InterBus technology unit (sk300e, sk5xxe, sk700e, sk750e)");
}

std::optional<unsigned> readOffset(const Settings& settings, const std::string& key) {
  if (!settings.has(key)) return std::nullopt;
  return static_cast<unsigned>(requiredInteger(settings, key, 0, kMostImageWords - 1));
}

InterbusDrive readDrive(const DriveSettings& source, bool has_parameters) {
  const Settings& settings = *source.settings;
  InterbusDrive drive{readDriveCommon(source)};
  checkSeries(settings, drive.series);
  if (drive.inverter != 1) {
    throw wrongSetting(settings, "inverter", std::to_string(drive.inverter),
                       "1: an InterBus technology unit serves one inverter");
  }
  drive.position = static_cast<unsigned>(requiredAddress(source, 1, interbus::kHighestPosition));
  drive.ppo_type = static_cast<unsigned>(integerOr(settings, "ppo_type", 1, 1, 2));
  drive.drive_profile =
      isSecond(settings, "profile", "nord", "drivecom") ? InterbusProfile::kDrivecom : InterbusProfile::kNord;
  if (drive.drive_profile == InterbusProfile::kDrivecom && drive.ppo_type != 1) {
    throw wrongSetting(settings, "ppo_type", std::to_string(drive.ppo_type),
                       "1: profile drivecom is effective with three words only (BU 0070 4.1)");
  }
  drive.array_sub_by_table = isSecond(settings, "array_sub_index", "element", "table");
  if (!drive.typed_max_frequency && !has_parameters) {
    throw missingSetting(settings, "max_frequency",
                         "P105 in Hz, because without bus/pcp the gateway carries no parameter channel to read it by");
  }
  return drive;
}

interbus::DriveImage imageOf(const Settings& settings, const InterbusDrive& drive) {
  interbus::DriveImage image;
  image.name = drive.name;
  image.position = drive.position;
  image.ppo_type = drive.ppo_type;
  image.value_order =
      profile::thirdBeforeSecond(drive.series) ? interbus::ValueOrder::kThreeBeforeTwo : interbus::ValueOrder::kInOrder;
  image.input_offset = readOffset(settings, "input_offset");
  image.output_offset = readOffset(settings, "output_offset");
  return image;
}

// "~" of "~bus/": what stands before the groups in the names of keys.
std::string rootOf(const Settings& bus) {
  const std::string name = bus.fullName("");
  const std::size_t at = name.rfind("bus");
  return at == std::string::npos ? std::string{} : name.substr(0, at);
}

void layOut(const Settings& bus, const interbus::ImageSettings& image, InterbusConfig& config) {
  std::string reason;
  config.map = interbus::ImageMap::make(image, reason);
  if (!config.map) throw ConfigError(rootOf(bus) + reason);
  link::ModbusSettings& server = config.server;
  server.inputs.parts = config.map->inputParts(link::kMostReadRegisters);
  server.outputs.parts = config.map->outputParts(link::mostRegistersWritten(server.outputs.function));
  server.control_words = config.map->controlWords();
  server.run_bits = config.map->runBits();
}

void checkServer(const Settings& bus, const std::string& key, const std::string& server) {
  Sentence reason;
  if (link::serverName(server, reason)) return;
  throw ConfigError(bus.fullName(key) + (reason.c_str() + std::strlen("server")));
}

void readServer(const Settings& bus, link::ModbusSettings& server) {
  server.server = requiredText(bus, "gateway", "host name or address and port of a Modbus/TCP server");
  checkServer(bus, "gateway", server.server);
  server.diagnosis = bus.text("diagnosis").value_or("");
  if (bus.has("diagnosis")) checkServer(bus, "diagnosis", server.diagnosis);
  server.unit = static_cast<std::uint8_t>(integerOr(bus, "unit", server.unit, 0, 255));
  readBlocks(bus, server);
  server.running = readRunning(bus, server.inputs.function);
  server.watchdog = readWatchdog(bus);
  server.response_timeout =
      seconds(numberOr(bus, "response_timeout", toSeconds(server.response_timeout), 0.01, 10.0, "s"));
}

}  // namespace

InterbusConfig readInterbusConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  InterbusConfig config;
  readServer(bus, config.server);
  const double window = std::min(0.25 / cycle_rate, kLongestWindow);
  config.pcp = readPcp(bus);
  config.answer_window = seconds(numberOr(bus, "answer_window", window, 0.0, 0.5 / cycle_rate, "s"));
  interbus::ImageSettings image;
  image.pcp_word = booleanOr(bus, "pcp_word", false);
  image.byte_order =
      isSecond(bus, "word_order", "as_is", "swapped") ? interbus::ByteOrder::kSwapped : interbus::ByteOrder::kAsIs;
  image.input_address = config.server.inputs.address;
  image.output_address = config.server.outputs.address;
  for (const DriveSettings& source : drives) {
    config.drives.push_back(readDrive(source, config.pcp.has_value()));
    image.drives.push_back(imageOf(*source.settings, config.drives.back()));
  }
  layOut(bus, image, config);
  checkWatchdog(bus, config.server);
  if (config.pcp) {
    config.pcp->swapped = image.byte_order == interbus::ByteOrder::kSwapped;
    checkPcp(bus, *config.pcp, config.server);
    readReferences(bus, drives, config.drives);
  }
  Sentence reason;
  if (!link::checkModbusSettings(config.server, reason)) throw ConfigError(bus.fullName("") + reason.str());
  return config;
}

}  // namespace nord_driver
