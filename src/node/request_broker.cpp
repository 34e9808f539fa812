#include "node/request_broker.h"

#include <algorithm>

namespace nord_driver::node {

namespace {

constexpr char kEnding[] = "the node is ending";

}  // namespace

RequestBroker::RequestBroker(cycle::CyclePorts& ports) : ports_(ports), dispatcher_([this] { dispatch(); }) {}

// Without the lock: others may call meanwhile.
void RequestBroker::tell(const std::function<void()>& taken, std::unique_lock<std::mutex>& lock) {
  if (!taken) return;
  lock.unlock();
  taken();
  lock.lock();
}

RequestBroker::~RequestBroker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  dispatcher_.join();
}

void RequestBroker::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ended_ = true;
  arrived_.notify_all();
}

void RequestBroker::refuseWrites() {
  const std::lock_guard<std::mutex> lock(mutex_);
  writes_refused_ = true;
}

std::size_t RequestBroker::writesUnderWay() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<std::size_t>(std::count_if(waiting_.begin(), waiting_.end(), [](const auto& waiting) {
    return waiting.second.write && !waiting.second.completion;
  }));
}

void RequestBroker::dispatch() {
  for (;;) {
    const auto completion = ports_.waitCompletion(std::chrono::milliseconds{100});
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stop_) return;
    if (!completion) continue;
    const auto at = waiting_.find(completion->id);
    if (at == waiting_.end()) continue;  // its caller has given up
    at->second.completion = *completion;
    arrived_.notify_all();
  }
}

cycle::Completion RequestBroker::call(cycle::Request request, const std::function<void()>& taken) {
  std::unique_lock<std::mutex> lock(mutex_);
  request.asked = std::chrono::steady_clock::now();
  request.id = next_id_;
  if (++next_id_ == 0) next_id_ = 1;  // 0: nobody waits for an answer
  cycle::Completion answer;
  const bool write = request.kind == cycle::RequestKind::kWriteParameter;
  const auto at = waiting_.emplace(request.id, Waiting{write, std::nullopt}).first;
  if (ended_ || (write && writes_refused_)) {
    answer.message = kEnding;
  } else if (!ports_.submit(request)) {
    answer.message = "too many requests are waiting already";
  } else {
    tell(taken, lock);
    const Duration patience = request.patience + std::chrono::seconds{1};
    arrived_.wait_for(lock, patience, [&] { return at->second.completion.has_value() || ended_; });
    if (at->second.completion) {
      answer = *at->second.completion;
    } else {
      answer.id = request.id;
      answer.unanswered = true;
      answer.message = ended_ ? kEnding : "the bus cycle did not answer";
      answer.parameter.eeprom_written = write;  // or will be
    }
  }
  waiting_.erase(at);
  return answer;
}

}  // namespace nord_driver::node
