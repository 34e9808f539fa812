// The part of a transport that reads and writes parameters of the inverters beside the process data.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/transport/cyclic_exchange.h"

namespace nord_driver {

/// Called by the thread of the bus cycle, between two calls of exchange(). Nothing throws or allocates. The defaults
/// are those of a bus without parameter access: every request is answered with "no channel".
class ParameterChannel {
 public:
  virtual ~ParameterChannel() = default;

  /// Queues an access, which runs during the following cycles. False: the queue of this drive is full. A request that
  /// was taken gets exactly one result, with its id, whatever happens to the drive; the transport limits the time.
  virtual bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept;
  /// The next finished access, whichever drive it was of; nothing when there is none.
  virtual std::optional<profile::ParameterResult> pollResult() noexcept;

  /// What the parameter channel of this drive can do; from configure() on, and always the same. Default: what PKW can.
  virtual profile::ParameterCapabilities parameterCapabilities(DriveIndex /*drive*/) const noexcept { return {}; }

  /// Asked before configure() by a program that only reads and writes parameters and then ends (nord_param). True: the
  /// transport serves it. Then the exchange starts no time-out in the bus modules that would trip the inverters when
  /// the program has ended, and listens for other masters before its first telegram. Never for a driver that enables:
  /// no time-out would stop its drives. Default: does not serve.
  virtual bool serveParametersOnly() noexcept { return false; }

 private:
  FixedVector<std::uint32_t, 32> unserved_;  // ids that the default submit() has taken
};

}  // namespace nord_driver
