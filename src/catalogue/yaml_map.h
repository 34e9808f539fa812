// A map of a catalogue file, read key by key: what is wrong is said in one sentence with file, line, key, value and what
// was expected.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver::catalogue {

/// Where a thing stands: "config/parameters/sk5xxe.yaml:12".
struct Place {
  std::string file;
  int line = 0;  ///< from 1 on
};

/// "FILE:LINE: PATH: VALUE is not valid, expected EXPECTED"; throw what this returns.
ConfigError wrongValue(const std::string& file, const YAML::Node& value, const std::string& path,
                       const std::string& expected);

/// "FILE:LINE: MESSAGE"; throw what this returns.
ConfigError wrongPlace(const Place& place, const std::string& message);

/// The map in a file. Throws ConfigError when it cannot be read or is none.
YAML::Node loadMap(const std::string& file);

/// A whole number, decimal or as 0x1F; none when the text is something else.
std::optional<std::int64_t> wholeNumber(const std::string& text);
/// A number; none when the text is something else.
std::optional<double> decimalNumber(const std::string& text);

class YamlMap {
 public:
  /// `path` names the map in sentences ("P509"); empty for the whole file. Throws when `node` is no map or holds a key
  /// twice.
  YamlMap(std::string file, std::string path, const YAML::Node& node);

  /// Every getter throws ConfigError when the value is there but of another kind, and remembers the key.
  std::optional<std::string> text(const std::string& key);
  std::optional<double> number(const std::string& key);
  std::optional<std::int64_t> integer(const std::string& key);
  std::optional<bool> flag(const std::string& key);
  /// A text or a list of texts; empty when it is absent.
  std::vector<std::string> texts(const std::string& key);
  /// Any value; an undefined node when it is absent.
  YAML::Node node(const std::string& key);

  /// Throws ConfigError naming the first key nobody asked for, and the one it may be a slip of.
  void rejectUnknown() const;

  ConfigError wrong(const std::string& key, const std::string& expected) const;
  ConfigError missing(const std::string& key, const std::string& expected) const;
  Place place() const;
  std::string file() const { return file_; }
  std::string pathOf(const std::string& key) const;

 private:
  YAML::Node find(const std::string& key) const;

  std::string file_;
  std::string path_;
  YAML::Node node_;
  std::vector<std::string> asked_;
};

}  // namespace nord_driver::catalogue
