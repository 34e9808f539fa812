// Writes doc/parameters.md, or tells why it cannot.
#include <cstdio>
#include <exception>
#include <fstream>

#include "documents/parameter_document.h"

int main() {
  try {
    const auto document = nord_driver::documents::documentOf(NORD_DRIVER_SOURCE_DIR);
    for (const std::string& problem : document.problems) std::fprintf(stderr, "%s\n", problem.c_str());
    std::ofstream file{NORD_DRIVER_SOURCE_DIR "/doc/parameters.md"};
    file << document.text;
    return document.problems.empty() && file.good() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
