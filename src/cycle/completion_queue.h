// Answers to requests, waiting to be handed on.
#pragma once

#include <cstddef>
#include <optional>

#include "cycle/request.h"
#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::cycle {

/// What a request is answered with.
inline Completion answerTo(const Request& request, bool success, const Sentence& message) noexcept {
  Completion completion;
  completion.id = request.id;
  completion.success = success;
  completion.message = message;
  return completion;
}

/// First in, first out; an answer nobody waits for (id 0) is dropped. `Capacity` must hold what can come between two
/// times it is emptied.
template <std::size_t Capacity>
class CompletionQueue {
 public:
  void add(const Completion& completion) noexcept {
    if (completion.id != 0) waiting_.push_back(completion);
  }
  void answer(const Request& request, bool success, const Sentence& message) noexcept {
    add(answerTo(request, success, message));
  }
  std::optional<Completion> poll() noexcept { return waiting_.takeFront(); }

 private:
  FixedVector<Completion, Capacity> waiting_;
};

}  // namespace nord_driver::cycle
