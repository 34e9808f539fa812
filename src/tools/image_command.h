// nord_param image: the input words of a gateway and whose they are, to look for the drives in it. Writes nothing.
#pragma once

#include <yaml-cpp/yaml.h>

#include <atomic>
#include <string>
#include <vector>

#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"
#include "transport/image_view.h"

namespace nord_driver::tools {

struct ImageOptions {
  bool once = false;      ///< show it, and end
  bool json = false;      ///< an object a line
  std::size_t words = 0;  ///< at least; 0: up to the last word of a drive
  Duration patience{};    ///< for the first inputs
};

/// A line for each word under a heading; those of `changed` are marked. `changed` is as long as `words`, or empty.
std::string imageTable(const std::string& where, const std::vector<ImageWord>& words, const std::vector<bool>& changed);
/// The same as one JSON object.
std::string imageJson(const std::string& where, const std::vector<ImageWord>& words, const std::vector<bool>& changed);
/// "    12.34 s  word 3, register 8003, right, actual value 1: 0000 -> 0123".
std::string changeLine(double time, const ImageWord& word, Word before);
std::string changeJson(double time, const ImageWord& word, Word before);

/// Shows the image on stdout, then each word that changes, until `end_asked`, and last which ones did. False, and said
/// on stderr: none came in time. `file` has its port. Throws ConfigError, and UsageError where the transport has none.
bool showImage(const YAML::Node& file, Transport& transport, const ImageOptions& options,
               const std::atomic<bool>& end_asked);

}  // namespace nord_driver::tools
