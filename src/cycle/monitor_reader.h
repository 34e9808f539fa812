// Reads the parameters somebody wants to look at, again and again, one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cycle/monitored_value.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::cycle {

/// All in turn, once a second at most. What the drive refuses is left out until it has been away: it may be exchanged;
/// what only the moment forbids is asked for again in the next turn. After a time-out nothing is asked for a second:
/// a channel that is silent is not worth blocking. It allocates nothing once it is made.
class MonitorReader {
 public:
  static constexpr Duration kTurn = std::chrono::seconds{1};

  /// A set 0 is the one in force.
  explicit MonitorReader(std::vector<profile::ParameterRequest> parameters);

  /// The drive went away: nothing is known of it.
  void handleOffline() noexcept;
  /// The next parameter to ask for, when none is under way; its id is for the caller to choose. `parameter_set`: in
  /// force, 1..4; 0: not known, and what depends on it waits.
  std::optional<profile::ParameterRequest> pollRequest(std::uint8_t parameter_set, Instant now) noexcept;
  /// The result of the request handed out last. `drive`: its name, for sentences.
  void handleResult(const profile::ParameterResult& result, const char* drive) noexcept;

  /// In the order of the parameters.
  const std::vector<MonitoredValue>& values() const noexcept { return values_; }

 private:
  std::vector<profile::ParameterRequest> parameters_;
  std::vector<MonitoredValue> values_;
  std::vector<std::uint8_t> left_out_;  // bool
  std::size_t next_ = 0;
  bool in_turn_ = false;
  bool waiting_ = false;
  bool timed_out_ = false;  // the last question
  Instant next_turn_{};
  Instant not_before_{};
};

}  // namespace nord_driver::cycle
