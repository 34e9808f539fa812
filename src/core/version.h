// The version every program of this package names with --version.
#pragma once

namespace nord_driver {

constexpr char kVersion[] = "0.1.0";

}  // namespace nord_driver
