#include "canopen/release_script.h"

#include "canopen/error_control_objects.h"

namespace nord_driver::canopen {

ReleaseScript::ReleaseScript(const ErrorControl& control) noexcept {
  if (control.mode == ErrorControlMode::kGuarding) {
    writes_.push_back({kGuardTimeIndex, 0, 0, 2});
    writes_.push_back({kLifeTimeFactorIndex, 0, 0, 1});
  } else if (control.master_timeout) {
    writes_.push_back({kHeartbeatConsumerIndex, 1, 0, 4});
  }
}

void ReleaseScript::begin() noexcept {
  step_ = 0;
  repeated_ = false;
}

void ReleaseScript::handle(const SdoAnswer& answer) noexcept {
  if (answer.end == SdoEnd::kDone || answer.end == SdoEnd::kAbortedByServer) {
    ++step_;
    repeated_ = false;
  } else if (repeated_) {
    step_ = writes_.size();
  } else {
    repeated_ = true;
  }
}

SdoRequest ReleaseScript::request() const noexcept {
  const SetupWrite& write = writes_[step_];
  return sdoWrite(0, write.index, write.sub_index, write.value, write.size);
}

}  // namespace nord_driver::canopen
