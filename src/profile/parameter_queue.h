// The parameter requests of one channel that carries one at a time, whichever bus it is of, and their results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/request_queue.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::profile {

/// The first request is the running one, and stays so until the channel ends it by `done`, `refuse` or `fail`: then it
/// is the next one's turn.
class ParameterQueue {
 public:
  /// The most requests waiting, running, or finished and not fetched.
  static constexpr std::size_t kCapacity = 8;

  /// False: full. What no inverter can have is refused without its turn: a number above 999, a set beyond 1..4, an
  /// element 0.
  bool submit(const ParameterRequest& request) noexcept;
  bool empty() const noexcept { return requests_.empty(); }
  /// How many wait or run.
  std::size_t size() const noexcept { return requests_.size(); }
  /// The running one; not to be called when empty.
  const ParameterRequest& front() const noexcept { return requests_.front(); }

  // Each ends the running one; not to be called when empty.
  /// `raw`: the value read, or written.
  void done(std::int32_t raw) noexcept;
  void refuse(ParameterReason reason, const Sentence& text) noexcept;
  /// With an outcome that is neither kDone nor kRefused.
  void fail(ParameterOutcome outcome, const Sentence& text = {}) noexcept;
  /// Ends all that wait or run.
  void failAll(ParameterOutcome outcome, const Sentence& text = {}) noexcept;

  std::optional<ParameterResult> pollResult() noexcept { return requests_.pollResult(); }

 private:
  RequestQueue<ParameterRequest, ParameterResult, kCapacity> requests_;
};

}  // namespace nord_driver::profile
