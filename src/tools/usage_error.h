// What a program says, and ends with 2, when it was called in a way that makes no sense.
#pragma once

#include <stdexcept>
#include <string>

namespace nord_driver::tools {

/// The command line makes no sense: one sentence.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace nord_driver::tools
