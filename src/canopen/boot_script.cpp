#include "canopen/boot_script.h"

#include <array>

#include "canopen/error_control_objects.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint16_t kDeviceTypeIndex = 0x1000;
constexpr std::uint16_t kIdentityIndex = 0x1018;

constexpr std::size_t kIdentitySteps = 4;
constexpr std::size_t kNamingSteps = 2;  // vendor and product tell what the device is: read in any case
constexpr std::array<const char*, kIdentitySteps> kIdentityNames{"vendor id", "product code", "revision number",
                                                                 "serial number"};

std::uint32_t milliseconds(Duration span) noexcept {
  return static_cast<std::uint32_t>(span / std::chrono::milliseconds{1});
}

const char* errorControlName(std::uint16_t index) noexcept {
  switch (index) {
    case kGuardTimeIndex:
      return "guard time";
    case kLifeTimeFactorIndex:
      return "life time factor";
    case kHeartbeatConsumerIndex:
      return "heartbeat to be watched by the node";
    default:
      return "heartbeat time";
  }
}

}  // namespace

BootScript::BootScript(const NodeConfig& config, std::uint8_t own_id) noexcept : config_(config) {
  const ErrorControl& control = config.error_control;
  if (control.mode == ErrorControlMode::kHeartbeat) {
    error_control_.push_back({kHeartbeatProducerIndex, 0, milliseconds(control.heartbeat_time), 2});
  } else if (control.mode == ErrorControlMode::kGuarding) {
    // A node that sends its heartbeat does not answer to guarding (CiA 301 7.2.8.3.2): first this.
    error_control_.push_back({kHeartbeatProducerIndex, 0, 0, 2});
    error_control_.push_back({kGuardTimeIndex, 0, milliseconds(control.guard_time), 2});
    error_control_.push_back({kLifeTimeFactorIndex, 0, control.life_time_factor, 1});
  }
  if (control.master_timeout && control.mode != ErrorControlMode::kGuarding) {
    const std::uint32_t watched = (std::uint32_t{own_id} << 16) | milliseconds(*control.master_timeout);
    error_control_.push_back({kHeartbeatConsumerIndex, 1, watched, 4});
  }
}

void BootScript::begin() noexcept {
  stage_ = Stage::kDeviceType;
  step_ = 0;
  reason_.clear();
}

SdoRequest BootScript::request() const noexcept {
  switch (stage_) {
    case Stage::kDeviceType:
      return sdoRead(0, kDeviceTypeIndex, 0);
    case Stage::kIdentity:
      return sdoRead(0, kIdentityIndex, static_cast<std::uint8_t>(step_ + 1));
    case Stage::kReceivePdo:
    case Stage::kTransmitPdo:
      return pdo_.request();
    default:
      return write_.request();
  }
}

Progress BootScript::handle(const SdoAnswer& answer, NodeStatus& status) noexcept {
  switch (stage_) {
    case Stage::kDeviceType:
      return handleDeviceType(answer, status);
    case Stage::kIdentity:
      return handleIdentity(answer, status);
    case Stage::kReceivePdo:
    case Stage::kTransmitPdo:
      return handlePart(pdo_, answer);
    case Stage::kSetup:
    case Stage::kErrorControl:
      return handlePart(write_, answer);
    case Stage::kDone:
      break;
  }
  return Progress::kDone;
}

Progress BootScript::handleDeviceType(const SdoAnswer& answer, NodeStatus& status) noexcept {
  const std::optional<std::uint32_t> found = numberOf(answer, 4);
  if (found) status.device_type = *found;
  if (config_.device_type) {
    if (!found) {
      reason_ = refusalText("device type", request(), answer);
      return Progress::kFailed;
    }
    if (*found != *config_.device_type) return differs("device type (1000h)", *found, *config_.device_type);
  }
  return next();
}

Progress BootScript::handleIdentity(const SdoAnswer& answer, NodeStatus& status) noexcept {
  const std::optional<std::uint32_t> found = numberOf(answer, 4);
  const std::optional<std::uint32_t>& wanted = wantedIdentity();
  if (!found && !wanted) return next();
  if (!found) {
    reason_ = refusalText(kIdentityNames[step_], request(), answer);
    return Progress::kFailed;
  }
  const std::array<std::uint32_t*, kIdentitySteps> noted{&status.vendor_id, &status.product_code,
                                                         &status.revision_number, &status.serial_number};
  *noted[step_] = *found;
  if (wanted && *found != *wanted) {
    FixedText<40> name;
    name.format("%s (1018h:%u)", kIdentityNames[step_], static_cast<unsigned>(step_ + 1));
    return differs(name.c_str(), *found, *wanted);
  }
  return next();
}

const std::optional<std::uint32_t>& BootScript::wantedIdentity() const noexcept {
  switch (step_) {
    case 0:
      return config_.vendor_id;
    case 1:
      return config_.product_code;
    case 2:
      return config_.revision_number;
    default:
      return config_.serial_number;
  }
}

Progress BootScript::differs(const char* what, std::uint32_t found, std::uint32_t wanted) noexcept {
  reason_.format("is another device: %s is %08Xh, configured is %08Xh", what, static_cast<unsigned>(found),
                 static_cast<unsigned>(wanted));
  return Progress::kFailed;
}

template <typename Part>
Progress BootScript::handlePart(Part& part, const SdoAnswer& answer) noexcept {
  const Progress progress = part.handle(answer);
  if (progress == Progress::kFailed) reason_ = part.reason();
  return progress == Progress::kDone ? next() : progress;
}

Progress BootScript::next() noexcept {
  if (stage_ == Stage::kDeviceType) {
    stage_ = Stage::kIdentity;
    step_ = 0;
  } else {
    ++step_;
  }
  while (stage_ != Stage::kDone && !beginStep()) {
    stage_ = static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1);
    step_ = 0;
  }
  return stage_ == Stage::kDone ? Progress::kDone : Progress::kGoOn;
}

/// False when the stage has no more steps.
bool BootScript::beginStep() noexcept {
  switch (stage_) {
    case Stage::kIdentity:
      while (step_ >= kNamingSteps && step_ < kIdentitySteps && !wantedIdentity()) ++step_;
      return step_ < kIdentitySteps;
    case Stage::kSetup:
      if (step_ >= config_.setup.size()) return false;
      write_.begin("set-up", config_.setup[step_]);
      return true;
    case Stage::kReceivePdo:
      if (step_ >= config_.receive_pdos.size()) return false;
      pdo_.begin(PdoDirection::kReceive, config_.receive_pdos[step_]);
      return true;
    case Stage::kTransmitPdo:
      if (step_ >= config_.transmit_pdos.size()) return false;
      pdo_.begin(PdoDirection::kTransmit, config_.transmit_pdos[step_]);
      return true;
    case Stage::kErrorControl:
      if (step_ >= error_control_.size()) return false;
      write_.begin(errorControlName(error_control_[step_].index), error_control_[step_], true);
      return true;
    default:
      return false;
  }
}

}  // namespace nord_driver::canopen
