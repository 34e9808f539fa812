// Any text as a GSD file: read to its end, and every problem names a line of it.
#include <algorithm>
#include <string>

#include "fuzz.h"
#include "profibus/gsd_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nord_driver;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const profibus::GsdFile file = profibus::parseGsd(text);
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (const profibus::GsdProblem& problem : file.problems) {
    fuzz::require(problem.line >= 1 && problem.line <= lines && !problem.text.empty());
  }
  fuzz::require(file.user_parameters.size() <= 237);
  for (const profibus::GsdModule& module : file.modules) {
    fuzz::require(module.user_parameters.size() <= 237);
    file.module(module.name);
  }
  file.maxTsdrBits(500'000);
  return 0;
}
