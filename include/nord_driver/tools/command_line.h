// What the programs' command lines have in common: their exit codes, and what a time is.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <optional>
#include <string>

namespace nord_driver::tools {

constexpr int kDone = 0, kFailed = 1, kWrongUsage = 2;

/// Nothing: go on. Otherwise the exit code; --help, --version or what is wrong has been printed. CLI11's own codes are
/// another one for each mistake.
inline std::optional<int> parseArguments(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
}

/// Of an option in seconds: a time there can be a timer for. CLI11's PositiveNumber prints a range with 300 digits, and
/// takes nan.
inline CLI::Validator positiveSeconds() {
  const auto wrong = [](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end != '\0' || !(value > 0.0)) return text + " is not valid, expected more than 0 s";
    return value > 1e9 ? text + " is not valid, expected at most 1000000000 s" : "";
  };
  return {wrong, "POSITIVE"};
}

}  // namespace nord_driver::tools
