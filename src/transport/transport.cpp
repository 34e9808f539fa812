#include "nord_driver/transport/transport.h"

#include <chrono>
#include <thread>

namespace nord_driver {

Instant CyclicExchange::now() const noexcept {
  return std::chrono::steady_clock::now();
}

void CyclicExchange::sleepUntil(Instant when) noexcept {
  std::this_thread::sleep_until(when);
}

bool ParameterChannel::submit(DriveIndex /*drive*/, const profile::ParameterRequest& request) noexcept {
  return unserved_.push_back(request.id);
}

std::optional<profile::ParameterResult> ParameterChannel::pollResult() noexcept {
  const auto id = unserved_.takeFront();
  if (!id) return std::nullopt;
  profile::ParameterResult result;
  result.id = *id;
  result.outcome = profile::ParameterOutcome::kNoChannel;
  return result;
}

}  // namespace nord_driver
