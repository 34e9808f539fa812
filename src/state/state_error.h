// Why something kept across runs cannot be read or kept.
#pragma once

#include <stdexcept>

namespace nord_driver::state {

/// One sentence that names the file.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace nord_driver::state
