// One drive of the ring: the words it is given, and whether it answers.
#pragma once

#include <optional>

#include "interbus/image_map.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/transport/cyclic_exchange.h"
#include "profile/drivecom.h"
#include "profile/parameter_queue.h"
#include "transport/interbus/input_watch.h"
#include "transport/interbus/interbus_config.h"

namespace nord_driver {

class InterbusDriveState {
 public:
  explicit InterbusDriveState(const InterbusDrive& config);

  interbus::ProcessWords toWords(const profile::ProcessOutput& output) const noexcept;
  /// `words`: of the newest inputs, used where `watch` says that they are fresh.
  void takeInput(const interbus::ProcessWords& words, const InputWatch& watch, DriveExchange& input) noexcept;

  /// The gateway's newest inputs are good, and the status word is not zero.
  bool answers() const noexcept { return answers_; }
  /// A parameter access that was taken, and its result: what the drive layer reads of P105 scales its speeds.
  void handleSubmitted(const profile::ParameterRequest& request) noexcept;
  void handleResult(const profile::ParameterResult& result) noexcept;

  /// Why it does not; empty when it does.
  const char* note(const InputWatch& watch) const noexcept;

 private:
  profile::ProcessInput fromWords(const interbus::ProcessWords& words) const noexcept;

  std::optional<profile::DrivecomScaling> drivecom_;  // where that is its profile
  std::optional<Hertz> typed_max_frequency_;
  bool answers_ = false;
  FixedVector<std::uint32_t, profile::ParameterQueue::kCapacity> max_frequency_reads_;  // ids
};

}  // namespace nord_driver
