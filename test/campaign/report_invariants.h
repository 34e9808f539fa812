// The invariants of what the driver tells: odometry, and who is lost or stopped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "campaign/invariant.h"
#include "robot/odometry.h"

namespace nord_driver::test {

/// No step of the pose or of a joint is longer than the fastest wheel goes in the time between.
class OdometryContinuous final : public Invariant {
 public:
  const char* name() const override { return "OdometryContinuous"; }
  const char* sentence() const override {
    return "a new node starts at pose 0; a bus or drive that comes back continues the pose, without a jump";
  }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override { before_.reset(); }

 private:
  struct Before {
    Instant time{};
    robot::Pose2d pose;
    std::vector<double> joints;
  };
  std::optional<Before> before_;
};

/// Who was stopped, or does not answer for long, is so with a sentence (of who has just fallen silent /diagnostics says "no
/// answer" itself); a base that is disabled without having been asked names its cause.
class EveryLossNamed final : public Invariant {
 public:
  const char* name() const override { return "EveryLossNamed"; }
  const char* sentence() const override {
    return "after each: disabled, latched, named in /diagnostics (What stops what)";
  }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override {
    wordless_.clear();
    base_enabled_ = false;
  }

 private:
  std::vector<unsigned> wordless_;  // cycles, of each drive
  bool base_enabled_ = false;
};

}  // namespace nord_driver::test
