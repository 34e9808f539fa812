// What was read of a drive's parameters, to be judged.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

namespace nord_driver::commissioning {

/// One value of a drive. Number 0: no parameter, something of the drive as a whole.
struct ParameterKey {
  std::uint16_t number = 0;  ///< the manual's
  std::uint8_t set = 0;      ///< 1..4; 0: it does not depend on the parameter set
  std::uint8_t index = 0;    ///< the manual's array index, from 1 on; 0: no array

  bool operator<(const ParameterKey& other) const noexcept {
    return std::tie(number, set, index) < std::tie(other.number, other.set, other.index);
  }
  bool operator==(const ParameterKey& other) const noexcept {
    return std::tie(number, set, index) == std::tie(other.number, other.set, other.index);
  }
};

class CommissioningFacts {
 public:
  void store(const ParameterKey& key, std::int32_t raw) { values_[key] = raw; }
  /// It was asked for, and the drive did not tell it.
  void storeUnreadable(const ParameterKey& key) { values_[key] = std::nullopt; }

  /// As transferred; nothing where it was not asked for, or the drive did not tell it.
  std::optional<std::int32_t> raw(const ParameterKey& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::nullopt : found->second;
  }
  bool isUnreadable(const ParameterKey& key) const {
    const auto found = values_.find(key);
    return found != values_.end() && !found->second;
  }

 private:
  std::map<ParameterKey, std::optional<std::int32_t>> values_;
};

}  // namespace nord_driver::commissioning
