// Settings of one kind of bus, held where the kind does not matter.
#pragma once

#include <any>
#include <type_traits>
#include <typeinfo>
#include <utility>

namespace nord_driver::sim {

/// Holds one struct of settings: `settings.as<CanBusConfig>().bit_rate = 500000`.
class BusSettings {
 public:
  BusSettings() = default;
  template <typename T, typename = std::enable_if_t<!std::is_same_v<std::decay_t<T>, BusSettings>>>
  BusSettings(T settings) : settings_(std::move(settings)) {}  // NOLINT(google-explicit-constructor): assigned from

  /// Nothing was set, or settings of another kind: those of this kind as they are by default.
  template <typename T>
  T& as() {
    T* settings = std::any_cast<T>(&settings_);
    return settings != nullptr ? *settings : settings_.emplace<T>();
  }
  template <typename T>
  const T& as() const noexcept {
    static const T kDefault{};
    const T* settings = std::any_cast<T>(&settings_);
    return settings != nullptr ? *settings : kDefault;
  }
  template <typename T>
  bool is() const noexcept {
    return std::any_cast<T>(&settings_) != nullptr;
  }
  /// void: nothing was set.
  const std::type_info& type() const noexcept { return settings_.type(); }

 private:
  std::any settings_;
};

}  // namespace nord_driver::sim
