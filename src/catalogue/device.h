// Who has parameters and fault numbers: an inverter of a series, or a bus module in front of inverters.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "nord_driver/profile/series.h"

namespace nord_driver::catalogue {

enum class Module : std::uint8_t { kProfibus, kCanopen, kDevicenet, kInterbus };

constexpr std::array<Module, 4> kAllModules{Module::kProfibus, Module::kCanopen, Module::kDevicenet, Module::kInterbus};

using Device = std::variant<profile::Series, Module>;

/// The module a transport's drives may sit behind, by its name without prefix ("profibus_dp"); none: it knows none.
std::optional<Module> moduleOf(const std::string& transport);

/// "sk5xxe" or "module_profibus", as the files of the catalogue write it.
std::string toString(const Device& device);

/// The device of such a word; none when the word is unknown.
std::optional<Device> deviceFrom(const std::string& name);

/// Every series, then every module.
std::vector<Device> allDevices();

}  // namespace nord_driver::catalogue
