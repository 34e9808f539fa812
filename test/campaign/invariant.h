// What holds after every cycle, whatever happens. One small class each, with the sentence it stands for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/moment.h"

namespace nord_driver::test {

class Invariant {
 public:
  virtual ~Invariant() = default;

  virtual const char* name() const = 0;
  /// As the manual or the description of the interface has it.
  virtual const char* sentence() const = 0;
  /// What is wrong; nothing when it holds. Called once per cycle, in order.
  virtual std::optional<std::string> look(const Moment& moment) = 0;
  /// Another driver has taken the place of the one before: what that one has told says nothing of it.
  virtual void driverBegan() {}
};

/// One of each, fresh.
std::vector<std::unique_ptr<Invariant>> allInvariants();

}  // namespace nord_driver::test
