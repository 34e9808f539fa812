// Which parameters users may write: a fence for a robot whose settings are done.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "config/tree_settings.h"

namespace nord_driver {

class WritableParameters {
 public:
  /// All.
  WritableParameters() = default;
  explicit WritableParameters(std::set<std::uint16_t> numbers) : numbers_(std::move(numbers)) {}

  bool allows(std::uint16_t number) const { return !numbers_ || numbers_->count(number) != 0; }
  /// "P105 may not be written: writable_parameters allows P102, P103"; empty where it may.
  std::string refusal(std::uint16_t number) const;

 private:
  std::optional<std::set<std::uint16_t>> numbers_;  // none: all
};

/// `writable_parameters`, a list of numbers or names (102, P102); all where it is absent. Throws ConfigError.
WritableParameters readWritableParameters(const TreeSettings& settings);

}  // namespace nord_driver
