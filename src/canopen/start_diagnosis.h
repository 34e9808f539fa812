// Why a node did not become operational, as far as it can be asked.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/nmt.h"
#include "canopen/node_config.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::canopen {

struct StartDiagnosis {
  bool heard = false;                          ///< after NMT start
  bool register_asked = false;                 ///< 1001h; 1003h:1 is next
  std::optional<std::uint8_t> error_register;  ///< 1001h
  std::optional<std::uint16_t> last_error;     ///< 1003h:1
};

/// A clause after the node's name. `state`: as heard last.
Sentence startRefusal(const StartDiagnosis& diagnosis, NmtState state, ErrorControlMode mode) noexcept;

}  // namespace nord_driver::canopen
