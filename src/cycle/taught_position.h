// After a drive was told to take its position into its array: did it?
#pragma once

#include <functional>

#include "cycle/position_setup.h"
#include "cycle/request.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::cycle {

/// `taught`: the completion of kTeach. Where it succeeded, the element of P613 is read by `read`, and `taught` says what
/// stands there; with another value than the position told it has failed. Without position/array_bit nobody knows the
/// element, and one that cannot be read proves nothing: both are said, and are no failure.
Completion withTaughtElement(Completion taught, const PositionSetup& setup,
                             const std::function<Completion(const profile::ParameterRequest&)>& read);

}  // namespace nord_driver::cycle
