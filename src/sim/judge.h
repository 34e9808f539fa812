// Whether the referee of a bus sees what its stations receive.
#pragma once

#include <cstdint>

namespace nord_driver::sim {

/// kYes: it is the master's, and unspoilt.
enum class Judge : std::uint8_t { kNo, kYes };

}  // namespace nord_driver::sim
