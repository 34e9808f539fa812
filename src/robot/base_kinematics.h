// From the motion of a base to its wheels and back: what every kind of base answers.
#pragma once

#include <cstddef>
#include <memory>

#include "robot/base_geometry.h"
#include "robot/twist.h"
#include "robot/wheel_speeds.h"

namespace nord_driver::robot {

enum class BaseKind {
  kDifferential,  ///< two sides; with several wheels a side: skid steer
  kMecanum,       ///< four wheels with rollers at 45 degrees
  kSteered,       ///< driven wheels, each steered by a drive of its own (SteeredKinematics)
};

/// As the configuration writes it: "mecanum".
const char* nameOf(BaseKind kind) noexcept;

/// The kinematics of one base. Wheels are counted the left ones first, front to rear, then the right ones likewise;
/// a wheel's speed is positive when it rolls the base forward. To add a kind: derive, and name it in BaseKind and
/// `makeKinematics`.
class BaseKinematics {
 public:
  virtual ~BaseKinematics() = default;

  virtual std::size_t wheelCount() const noexcept = 0;
  /// False: this base can only drive along its x axis and turn.
  virtual bool movesSideways() const noexcept = 0;
  /// The wheel speeds (rad/s) that give this motion, as far as `possible` goes.
  virtual WheelSpeeds wheels(const Twist2d& twist) const noexcept = 0;
  /// The motion that these wheel speeds (rad/s) give; where the wheels contradict each other, the one that fits them
  /// best. Zero for another number of wheels than `wheelCount`.
  virtual Twist2d twist(const WheelSpeeds& wheels) const noexcept = 0;

  /// Goes on with other sizes; allocates nothing when they are possible. False, and nothing changes, when one is not.
  virtual bool setGeometry(const BaseGeometry& geometry) noexcept = 0;

  /// The part of a motion that this base can do.
  Twist2d possible(const Twist2d& twist) const noexcept {
    return {twist.linear_x, twist.angular_z, movesSideways() ? twist.linear_y : 0.0};
  }
};

/// Of the kinds with a left and a right side; a steered base has its SteeredAxles. Throws std::invalid_argument with a
/// sentence naming what is wrong: the kind, a field of the geometry, or the number of wheels.
std::unique_ptr<BaseKinematics> makeKinematics(BaseKind kind, const BaseGeometry& geometry, std::size_t left_wheels,
                                               std::size_t right_wheels);

}  // namespace nord_driver::robot
