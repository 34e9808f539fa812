#include "link/modbus/modbus_settings.h"

#include <algorithm>
#include <cstdlib>

namespace nord_driver::link {

namespace {

unsigned code(ModbusFunction function) noexcept {
  return static_cast<unsigned>(function);
}

bool isRead(ModbusFunction function) noexcept {
  return function == ModbusFunction::kReadHoldingRegisters || function == ModbusFunction::kReadInputRegisters;
}

bool checkBlock(const char* name, const RegisterBlock& block, std::uint16_t most, Sentence& reason) {
  for (const WordRange& part : block.parts) {
    if (part.count == 0 || part.count > most) {
      reason.format("%s: a part of %u registers, expected 1 to %u for function %u", name, part.count, most,
                    code(block.function));
      return false;
    }
    if (part.end() > kMostImageWords) {
      reason.format("%s: words %u to %u, expected an image of at most %zu words", name, part.first, part.end() - 1,
                    kMostImageWords);
      return false;
    }
    if (block.address + part.end() > 65536u) {
      reason.format("%s/address: %u, the image ends at register %u, expected at most 65535", name, block.address,
                    block.address + part.end() - 1);
      return false;
    }
  }
  return true;
}

bool checkFunctions(const ModbusSettings& settings, Sentence& reason) {
  const ModbusFunction in = settings.inputs.function, out = settings.outputs.function;
  if (!isRead(in) && in != ModbusFunction::kReadWriteRegisters) {
    reason.format("inputs/function: %u, expected 3, 4 or 23", code(in));
  } else if (out != ModbusFunction::kWriteRegisters && out != ModbusFunction::kReadWriteRegisters) {
    reason.format("outputs/function: %u, expected 16 or 23", code(out));
  } else if ((in == ModbusFunction::kReadWriteRegisters) != (out == ModbusFunction::kReadWriteRegisters)) {
    reason.format(
        "inputs/function: %u and outputs/function: %u, expected 23 for both or for none: it moves both images",
        code(in), code(out));
  } else if (in == ModbusFunction::kReadWriteRegisters &&
             settings.inputs.parts.empty() != settings.outputs.parts.empty()) {
    reason.format("function 23 with one image only, expected inputs and outputs");
  } else if (settings.running && !isRead(settings.running->function)) {
    reason.format("running/function: %u, expected 3 or 4", code(settings.running->function));
  } else {
    return true;
  }
  return false;
}

bool checkTimes(const ModbusSettings& settings, Sentence& reason) {
  struct {
    const char* name;
    Duration value;
  } const times[] = {{"response_timeout", settings.response_timeout},
                     {"connect_timeout", settings.connect_timeout},
                     {"first_pause", settings.first_pause},
                     {"longest_pause", settings.longest_pause}};
  for (const auto& time : times) {
    if (time.value >= std::chrono::milliseconds{1} && time.value <= std::chrono::seconds{60}) continue;
    reason.format("%s: %.3f s, expected 0.001 to 60 s", time.name, toSeconds(time.value));
    return false;
  }
  return true;
}

}  // namespace

std::optional<ServerName> serverName(const std::string& text, Sentence& reason) {
  ServerName name;
  const std::size_t bracket = text.find(']');
  const bool is_bracketed = !text.empty() && text.front() == '[' && bracket != std::string::npos;
  const std::size_t colon = is_bracketed ? text.find(':', bracket) : text.find(':');
  const bool is_plain_v6 = !is_bracketed && std::count(text.begin(), text.end(), ':') > 1;
  name.host = is_bracketed ? text.substr(1, bracket - 1) : is_plain_v6 ? text : text.substr(0, colon);
  const std::string port = colon == std::string::npos || is_plain_v6 ? "502" : text.substr(colon + 1);
  char* end = nullptr;
  const unsigned long number = std::strtoul(port.c_str(), &end, 10);
  const bool is_number = !port.empty() && port.find_first_not_of("0123456789") == std::string::npos && *end == '\0';
  const bool ends_well = !is_bracketed || bracket + 1 == text.size() || text[bracket + 1] == ':';
  if (name.host.empty() || name.host.find_first_of(" /[]") != std::string::npos || !is_number || number < 1 ||
      number > 65535 || !ends_well) {
    reason.format(
        "server: \"%s\", expected a host name or an address, and a port from 1 to 65535 behind a colon if it "
        "is not 502 (192.168.0.10:502, [fe80::1]:502)",
        text.c_str());
    return std::nullopt;
  }
  name.port = static_cast<std::uint16_t>(number);
  return name;
}

bool checkModbusSettings(const ModbusSettings& settings, Sentence& reason) {
  if (!serverName(settings.server, reason) || !checkFunctions(settings, reason)) return false;
  if (!settings.diagnosis.empty() && !serverName(settings.diagnosis, reason)) return false;
  if (!checkBlock("inputs", settings.inputs, kMostReadRegisters, reason)) return false;
  if (!checkBlock("outputs", settings.outputs, mostRegistersWritten(settings.outputs.function), reason)) return false;
  for (const std::uint16_t word : settings.control_words) {
    const auto& parts = settings.outputs.parts;
    const auto holds = [word](const WordRange& part) { return word >= part.first && word < part.end(); };
    if (std::any_of(parts.begin(), parts.end(), holds)) continue;
    reason.format("a control word at word %u of the outputs, expected it in a part that is written", word);
    return false;
  }
  return checkTimes(settings, reason);
}

}  // namespace nord_driver::link
