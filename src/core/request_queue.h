// Requests that are carried out one after the other, and their results until somebody fetches them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver {

/// First in, first out. `Request` and `Result` have an `id`: that of the request comes back in its result. Never
/// allocates.
template <typename Request, typename Result, std::size_t Capacity>
class RequestQueue {
 public:
  /// False, and nothing kept, when `Capacity` requests wait, run, or are finished and not fetched.
  bool submit(const Request& request) noexcept { return !full() && waiting_.push_back(request); }
  /// Answers a request that need not wait for its turn; false when full.
  bool answer(const Request& request, Result result) noexcept {
    result.id = request.id;
    return !full() && results_.push_back(result);
  }
  /// No request waits or runs.
  bool empty() const noexcept { return waiting_.empty(); }
  /// How many wait or run.
  std::size_t size() const noexcept { return waiting_.size(); }
  /// The running one; not to be called when empty.
  const Request& front() const noexcept { return waiting_[0]; }
  /// The one at this place, 0 is the running one; nullptr: nobody is there.
  const Request* at(std::size_t place) const noexcept { return place < waiting_.size() ? &waiting_[place] : nullptr; }
  /// The one with this id, running or waiting; nullptr: there is none.
  Request* find(std::uint32_t id) noexcept {
    for (Request& request : waiting_) {
      if (request.id == id) return &request;
    }
    return nullptr;
  }
  /// Ends the running one: the next one's turn. Not to be called when empty.
  void finish(Result result) noexcept {
    result.id = waiting_[0].id;
    results_.push_back(result);
    waiting_.eraseFront(1);
  }
  /// The oldest result, once.
  std::optional<Result> pollResult() noexcept { return results_.takeFront(); }

 private:
  bool full() const noexcept { return waiting_.size() + results_.size() >= Capacity; }

  FixedVector<Request, Capacity> waiting_;  // the first is the running one
  FixedVector<Result, Capacity> results_;
};

}  // namespace nord_driver
