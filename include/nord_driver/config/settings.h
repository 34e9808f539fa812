// Configuration as question and answer, so that no layer below the node sees ROS.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nord_driver {

/// A wrong configuration: one sentence naming the key, the value and what was expected.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A group of named values. Every getter throws ConfigError when the value is there but of another kind; integers are
/// accepted where numbers are expected. Every key asked for is remembered, so that the rest can be named as unknown.
class Settings {
 public:
  virtual ~Settings() = default;

  virtual bool has(const std::string& key) const = 0;
  virtual std::optional<double> number(const std::string& key) const = 0;
  virtual std::optional<std::int64_t> integer(const std::string& key) const = 0;
  virtual std::optional<bool> boolean(const std::string& key) const = 0;
  virtual std::optional<std::string> text(const std::string& key) const = 0;
  /// A list of texts; a single text counts as a list of one.
  virtual std::optional<std::vector<std::string>> texts(const std::string& key) const = 0;

  /// The keys of this group that are there, whatever their kind.
  virtual std::vector<std::string> keys() const = 0;
  /// The full name of a key as a user wrote it ("~bus/baud_rate"), for error sentences.
  virtual std::string fullName(const std::string& key) const = 0;
};

/// One drive of the configuration: its name and its settings.
struct DriveSettings {
  std::string name;
  std::shared_ptr<const Settings> settings;
};

}  // namespace nord_driver
