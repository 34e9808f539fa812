// What the programs' command lines have in common: their exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

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

}  // namespace nord_driver::tools
