// What is written to a node that is let go without a reset, so that it does not miss us afterwards.
#pragma once

#include <cstddef>
#include <cstdint>

#include "canopen/node_config.h"
#include "canopen/sdo_request.h"
#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::canopen {

/// A node that has once been asked by guarding, or has heard a heartbeat, watches its master in pre-operational and
/// stopped as well (CiA 301 7.2.8.3.2): the end of either is a loss to it. A guard time of 0 and a consumer time of 0
/// end that (7.5.2.11, 7.5.2.19). One access after the other.
class ReleaseScript {
 public:
  explicit ReleaseScript(const ErrorControl& control) noexcept;

  void begin() noexcept;
  bool done() const noexcept { return step_ >= writes_.size(); }
  /// The access that comes next. Not when done.
  SdoRequest request() const noexcept;
  /// `answer`: to `request()`. A refusal is no end: one of two that is carried out is enough. A node that does not
  /// answer twice is not asked any more.
  void handle(const SdoAnswer& answer) noexcept;

 private:
  FixedVector<SetupWrite, 2> writes_;
  std::size_t step_ = 0;
  bool repeated_ = false;
};

}  // namespace nord_driver::canopen
