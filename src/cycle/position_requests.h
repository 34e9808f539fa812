// Carries out what users ask of drives that position, beside their targets: the reference run, teach-in, and reset position.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cycle/axis.h"
#include "cycle/completion_queue.h"
#include "cycle/request.h"
#include "drive/drive.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Each cycle: `handleRequest` for what has come, after the exchange `update`, then `pollCompletion`. A run goes on to its
/// end or its time-out (PositionConfig::homing_timeout) whether its asker still waits or not.
class PositionRequests {
 public:
  /// Both must outlive the object and not move.
  PositionRequests(std::vector<drive::Drive>& drives, const std::vector<Axis>& axes, std::vector<std::string> names);

  /// kHome, kTeach and kResetPosition.
  void handleRequest(const Request& request, Instant now) noexcept;
  void update(Instant now) noexcept;
  std::optional<Completion> pollCompletion() noexcept { return completions_.poll(); }

 private:
  struct Job {
    Request request;
    Instant deadline{};
    std::uint32_t token = 0;
  };

  Sentence refusalOf(const Request& request) const noexcept;
  /// Why the bit that asks for it cannot be sent.
  Sentence bitRefusal(const Request& request) const noexcept;
  /// Of the drive, the report of what is asked for.
  const drive::RequestReport& reportOf(const Request& request) const noexcept;
  /// True when the job has ended.
  bool follow(const Job& job, Instant now) noexcept;

  std::vector<drive::Drive>& drives_;
  const std::vector<Axis>& axes_;
  std::vector<std::string> names_;
  FixedVector<Job, 16> jobs_;
  std::uint32_t last_token_ = 0;
  CompletionQueue<48> completions_;
};

}  // namespace nord_driver::cycle
