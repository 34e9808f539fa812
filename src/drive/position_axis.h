// The part of a drive that positions: where its joint is, where it is to go, and the words of both.
//
// Its rules, in one place:
//  - While the drive does not carry out 047F, the target it is sent is its own position: enabling, whoever does it,
//    moves nothing.
//  - With the first 047F the target stands still: the axis is held where it was, and stopped when it does not stay.
//  - During a reference run it is the position again, for the count gets a new zero on the way.
//  - A target counts while the drive is enabled, and is forgotten with it.
//  - A drive that goes to the elements of its array is told none, bits 0, wherever others are sent their position, and
//    watched (PathGuard). Where its words carry a target all the same, that is the same one.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/units.h"
#include "drive/homing_run.h"
#include "drive/path_guard.h"
#include "drive/position_reader.h"
#include "drive/position_report.h"
#include "drive/reset_run.h"
#include "drive/teach_run.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"
#include "profile/position_scale.h"
#include "profile/position_words.h"

namespace nord_driver::drive {

struct PositionConfig {
  profile::PositionScale scale;
  std::optional<double> lower;  ///< rad or m: of the joint
  std::optional<double> upper;
  double tolerance = 0.0;          ///< rad or m: nearer than this the target is reached
  std::optional<RadPerSec> speed;  ///< of the joint's shaft, what setpoint 1 asks for while it travels; none: P105
  double unit_per_radian = 1.0;    ///< of the joint's shaft: 1, or m of a prismatic joint
  Duration homing_timeout = seconds(60.0);
  double revolutions_per_motor_turn = 1.0;  ///< counted, > 0
  double reset_to = 0.0;                    ///< revolutions: what "reset position" makes of the count
  /// It is told an element of its array (P613), and goes where that is; otherwise the target stands in its words.
  bool by_element = false;
  /// rad or m: farther than this beside its way it is stopped. Where the target stands in its words, before the first one:
  /// it is told its own position, and goes away from it where setpoint and actual value count different steps.
  double stray = std::numeric_limits<double>::infinity();
};

class PositionAxis {
 public:
  explicit PositionAxis(const PositionConfig& config) : config_(config) {}

  /// What the words of parameter set 1..4 carry.
  void setWords(std::uint8_t set, const profile::PositionWords& words) noexcept;
  const profile::PositionWords& words(std::uint8_t set) const noexcept;

  /// With every useful telegram. `set`: in force. `max_speed`: turns/s of the motor, the most it can do.
  void handleInput(const profile::ProcessInput& input, std::uint8_t set, double max_speed, Instant now) noexcept;
  void handleGap() noexcept;

  /// The position is known, and can be a target of `set`.
  bool canHold(std::uint8_t set) const noexcept;
  bool isKnown() const noexcept { return reader_.isKnown(); }
  /// And no newer one contradicts it.
  bool isCertain() const noexcept { return reader_.isKnown() && !reader_.isHeldBack(); }
  /// Of the motor, from the count and signed as it counts.
  double motorTurnsPerSecond() const noexcept;
  /// A value beyond what the speed allows has just been believed: the count has a new zero.
  bool hasJumped() const noexcept { return reader_.hasJumped(); }

  /// Before put(). `moves`: 047F goes out, and a target is gone to; otherwise, and with the first one, the target is the
  /// position.
  void follow(bool moves) noexcept;
  void startHoming(Instant now) noexcept;
  void endHoming() noexcept;
  bool isHoming() const noexcept { return homing_.isRunning(); }
  /// While it runs, after handleInput().
  HomingRun::Outcome handleHoming(bool reached, bool still, Instant now) noexcept;
  /// The bits that make the drive take its position into its array; tell() has them.
  TeachRun& teaching() noexcept { return teaching_; }
  /// The bit that sets its count anew; tell() has it. What a reference run has found does not count from there on.
  void startReset(Instant now, Duration hold, Duration timeout) noexcept;
  ResetRun& resetting() noexcept { return resetting_; }
  /// While it runs, with every telegram the drive answered: true when the count is what it is to be.
  bool handleReset(Instant now) noexcept;
  /// It is taught, or its count is set anew: the drive is not enabled meanwhile.
  bool isSettingUp() const noexcept { return teaching_.isRunning() || resetting_.isRunning(); }
  /// A bit of the drive says whether its reference is known; none: there is no such bit.
  void setReferenced(std::optional<bool> referenced) noexcept { referenced_ = referenced; }

  /// rad or m. Refused, the one before stays.
  TargetRefusal setTarget(double joint) noexcept;
  /// What it is to go to, or held at: rad or m.
  double target() const noexcept { return wanted_; }
  /// The element of its array, and where that is. `speed`: rad/s or m/s it has now.
  TargetRefusal setElement(std::uint8_t element, double joint, double speed) noexcept;
  /// While it is to stay, and with by_element while it is to go, too: it does not.
  bool strays() const noexcept;
  void refuse(TargetRefusal refusal, double joint) noexcept;

  /// The target into its words.
  void put(profile::ProcessOutput& output, std::uint8_t set) noexcept;
  /// After handleInput() or put(). `reached`: status bit 8; `enabled`: 047F is carried out.
  void tell(bool online, bool enabled, bool reached) noexcept;

  const PositionReport& report() const noexcept { return report_; }
  const PositionConfig& config() const noexcept { return config_; }

 private:
  void hold() noexcept;
  /// What it counts is what "reset position" makes of it.
  bool isReset() const noexcept;
  bool isAtLimit(double joint) const noexcept;
  /// As sent.
  double toldTarget() const noexcept;
  TargetRefusal refusalOf(double joint) const noexcept;
  /// The steps of a target in the words of the set in force; those of P613 where no word carries one.
  std::optional<std::int32_t> stepsOf(double joint) const noexcept;
  const profile::PositionField& field() const noexcept { return words(set_).actual; }

  PositionConfig config_;
  std::array<profile::PositionWords, 4> words_{};
  PositionReader reader_;
  PositionReport report_;
  HomingRun homing_;
  TeachRun teaching_;
  ResetRun resetting_;
  std::optional<bool> referenced_;
  bool homed_ = false;       // by a run asked for here, since the drive is back; in the count it has now
  std::uint8_t set_ = 1;     // in force
  std::int64_t target_ = 0;  // steps of the setpoint's field
  bool has_target_ = false;
  double wanted_ = 0.0;       // the target, before it was rounded to steps
  std::uint8_t element_ = 0;  // the bits that choose it
  PathGuard path_;
  bool frozen_ = false;  // the target stands still
  bool asked_ = false;   // for a target, since it was held last
};

}  // namespace nord_driver::drive
