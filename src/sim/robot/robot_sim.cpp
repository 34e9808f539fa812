#include "sim/robot/robot_sim.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr Duration kLongestUnheard = std::chrono::minutes(1);

}  // namespace

RobotSim::RobotSim(const SimConfig& config) : config_(config) {
  for (const DriveConfig& drive : config_.drives) drives_.push_back(std::make_unique<DriveUnit>(drive));
  if (!config_.body) return;
  const BodyConfig& body = *config_.body;
  if (body.kind == BodyKind::kSteered) {
    body_ = std::make_unique<SteeredBody>(SteeredWheel{body.front.x, body.front.y, body.wheel_radius},
                                          SteeredWheel{body.rear.x, body.rear.y, body.wheel_radius});
  } else if (body.kind == BodyKind::kMecanum) {
    body_ = std::make_unique<MecanumBody>(body.wheel_radius, body.wheel_separation, body.wheel_base);
  } else {
    body_ = std::make_unique<DiffDriveBody>(body.wheel_radius, body.wheel_separation);
  }
}

void RobotSim::advance(Instant now) noexcept {
  if (!now_) {
    now_ = now;
    step(Duration::zero());
  }
  while (*now_ < now) {
    const Duration span = std::min(kStep, now - *now_);
    step(span);
    *now_ += span;
  }
}

void RobotSim::runOnUnheard(Duration span) noexcept {
  for (Duration left = std::min(span, kLongestUnheard); left > Duration::zero(); left -= kStep) {
    const Duration part = std::min(kStep, left);
    for (const std::unique_ptr<DriveUnit>& drive : drives_) drive->inverter().forgive(part);
    step(part);
  }
}

void RobotSim::step(Duration span) noexcept {
  for (const std::unique_ptr<DriveUnit>& drive : drives_) drive->advance(span);
  if (body_ == nullptr) return;
  const Steering steered = steering();
  body_->moveTo(wheels(&DriveUnit::wheelAngle), steered);
  body_->setSpeeds(wheels(&DriveUnit::wheelSpeed), steered);
}

Steering RobotSim::steering() const noexcept {
  const BodyConfig& body = *config_.body;
  if (body.kind != BodyKind::kSteered) return {};
  return {drives_[body.front.steering]->wheelAngle(), drives_[body.rear.steering]->wheelAngle()};
}

// Of a side that turns as one the mean counts.
Wheels RobotSim::wheels(double (DriveUnit::*of)() const noexcept) const noexcept {
  const auto wheel = [&](std::size_t drive) { return (*drives_[drive].*of)(); };
  const auto mean = [&](const std::vector<std::size_t>& side) {
    double sum = 0.0;
    for (const std::size_t drive : side) sum += wheel(drive);
    return sum / static_cast<double>(side.size());
  };
  const BodyConfig& body = *config_.body;
  if (body.kind == BodyKind::kSteered) return {wheel(body.front.wheel), wheel(body.rear.wheel), 0.0, 0.0};
  if (body.kind == BodyKind::kMecanum) {
    return {wheel(body.left[0]), wheel(body.left[1]), wheel(body.right[0]), wheel(body.right[1])};
  }
  const double left = mean(body.left);
  const double right = mean(body.right);
  return {left, left, right, right};
}

DriveUnit* RobotSim::find(const std::string& name) noexcept {
  for (const std::unique_ptr<DriveUnit>& drive : drives_) {
    if (drive->name() == name) return drive.get();
  }
  return nullptr;
}

}  // namespace nord_driver::sim
