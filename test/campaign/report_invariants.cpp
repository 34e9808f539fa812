#include "campaign/report_invariants.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nord_driver::test {

namespace {

constexpr double kSpare = 1.05;  // a ratio measured may be a little beyond 100 %
constexpr double kTiny = 1e-9;
constexpr unsigned kSoon = 100;  // cycles

double turned(double from, double to) {
  return std::fabs(std::remainder(to - from, 2.0 * M_PI));
}

bool isEnabling(const Moment& moment, std::uint32_t id) {
  return std::any_of(moment.calls->begin(), moment.calls->end(), [&](const Call& call) {
    return call.request.id == id && call.request.kind == cycle::RequestKind::kEnable;
  });
}

}  // namespace

std::optional<std::string> OdometryContinuous::look(const Moment& moment) {
  if (!moment.driver_ran || !moment.judged) return std::nullopt;
  const cycle::CycleSnapshot& snapshot = *moment.snapshot;
  Before now{snapshot.time, snapshot.base.pose, {}};
  for (const cycle::DriveSnapshot& drive : snapshot.drives) now.joints.push_back(drive.joint_position);
  std::optional<std::string> wrong;
  std::ostringstream out;
  if (!before_) {
    if (std::hypot(now.pose.x, now.pose.y) > kTiny || std::fabs(now.pose.heading) > kTiny)
      wrong = "it begins not at pose 0";
  } else {
    const double dt = toSeconds(now.time - before_->time);
    const double way = kSpare * moment.full_wheel_speed * dt + kTiny;
    const double step = std::hypot(now.pose.x - before_->pose.x, now.pose.y - before_->pose.y);
    const double turn = turned(before_->pose.heading, now.pose.heading);
    const bool to_zero = moment.odometry_reset && std::hypot(now.pose.x, now.pose.y) <= way;
    if (!to_zero && (step > way * kWheelRadius || turn > 2.0 * way * kWheelRadius / kSeparation)) {
      out << "the pose jumps by " << step << " m and " << turn << " rad in " << dt << " s";
      wrong = out.str();
    }
    for (std::size_t i = 0; i < now.joints.size() && !wrong; ++i) {
      const bool is_axis = i < moment.axes.size() && moment.axes[i].is_axis;
      if (is_axis || std::fabs(now.joints[i] - before_->joints[i]) <= way) continue;
      out << "joint " << i << " jumps by " << now.joints[i] - before_->joints[i] << " rad in " << dt << " s";
      wrong = out.str();
    }
  }
  before_ = std::move(now);
  return wrong;
}

std::optional<std::string> EveryLossNamed::look(const Moment& moment) {
  if (!moment.driver_ran || !moment.judged) return std::nullopt;
  const cycle::CycleSnapshot& snapshot = *moment.snapshot;
  wordless_.resize(snapshot.drives.size());
  for (std::size_t i = 0; i < snapshot.drives.size(); ++i) {
    const cycle::DriveSnapshot& drive = snapshot.drives[i];
    const bool wordless = !drive.online && drive.text.empty() && snapshot.bus_text.empty();
    wordless_[i] = wordless ? wordless_[i] + 1 : 0;
    if (wordless_[i] > kSoon) return "drive " + std::to_string(i) + " does not answer, and nobody says why";
    if (drive.online && drive.stopped && drive.text.empty()) {
      return "drive " + std::to_string(i) + " is stopped without a word";
    }
  }
  if (moment.groups.empty() || !moment.groups.front().is_base) return std::nullopt;
  const bool left = base_enabled_ && !snapshot.base.enabled;
  const bool unasked = left && moment.groups.front().asked;
  base_enabled_ = snapshot.base.enabled;
  // "All drives of the node or none (a drive that refuses takes the others back)": the answer names who refuses.
  const bool taken_back = std::any_of(moment.answers.begin(), moment.answers.end(), [&](const auto& answer) {
    return !answer.success && !answer.message.empty() && isEnabling(moment, answer.id);
  });
  if (!unasked || taken_back || (snapshot.base.stopped && snapshot.base.stop_cause != drive::StopCause::kNone))
    return std::nullopt;
  return "the base is not enabled any more, nobody has asked for that, and no cause is named";
}

}  // namespace nord_driver::test
