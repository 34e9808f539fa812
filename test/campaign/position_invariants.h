// The invariants of drives that go to positions: how they move by the simulator's truth, and what the driver tells of them.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "campaign/invariant.h"
#include "campaign/speed_bound.h"

namespace nord_driver::test {

/// The shaft of an axis is driven only on its way to a target or in a reference run that was asked for while it was
/// enabled; where it has arrived, and where it was enabled, it stays.
class AxisMovesOnlyAsAsked final : public Invariant {
 public:
  const char* name() const override { return "AxisMovesOnlyAsAsked"; }
  const char* sentence() const override {
    return "enabling moves nothing; whatever stops the drive takes its target away; after the next enable it is held "
           "where it then is (Positions, a target)";
  }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  struct Track {
    SpeedBound bound;
    bool goal = false;
    bool driven = false;  // by the words of the bus
    double caught = 0.0;  // Hz, how fast it was when it was driven again
    Instant calm{};       // then it is held
  };

  std::vector<Track> tracks_;
  std::optional<Instant> last_;
};

/// On its way to a target, and held, an axis is never farther beyond its limits than something else has brought it.
class AxisWithinItsLimits final : public Invariant {
 public:
  const char* name() const override { return "AxisWithinItsLimits"; }
  const char* sentence() const override {
    return "a target beyond the joint's limits is refused, and the one before stays; the sum of increments has to lie "
           "within the same limits (Positions, a target)";
  }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  struct Track {
    double brought = 0.0;  // rad beyond, by a coasting load, terminals, a ramp or a reference run
    Instant led_since{};
    bool led = false;  // by targets
  };

  std::vector<Track> tracks_;
};

/// Of an axis that stays enabled the target is the one before, the newest that may be, or this and its increments.
class AxisTargetsCount final : public Invariant {
 public:
  const char* name() const override { return "AxisTargetsCount"; }
  const char* sentence() const override {
    return "a target counts while the drive is enabled; one beyond is refused, and the one before stays; of increments "
           "none is lost, two within one cycle are added; a target takes those before it away (Positions, a target)";
  }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override { expected_.clear(); }

 private:
  std::vector<std::optional<double>> expected_;  // rad; of those enabled
};

/// What is told of an axis is where it is; it does not jump, but where its count got a new zero in a reference run.
class AxisPositionTrue final : public Invariant {
 public:
  const char* name() const override { return "AxisPositionTrue"; }
  const char* sentence() const override {
    return "joint_states: the drive's own position, absolute; a position that the motor's speed cannot have led to is "
           "held back; position_reached: enabled, status bit 8, and nearer to the target than the tolerance "
           "(Positions)";
  }
  std::optional<std::string> look(const Moment& moment) override;
  void driverBegan() override {
    for (Track& track : tracks_) track.told.reset();
  }

 private:
  struct Track {
    std::deque<std::pair<Instant, double>> truth;  // rad, within the time a word needs
    std::optional<double> zero;                    // revolutions
    bool new_zero = false;                         // not told yet
    bool run_asked = false;
    std::optional<double> told;      // rad, the joint as told last
    Instant fresh{};                 // when it was where it was told to be, last
    std::optional<Instant> another;  // when another one stood at its address, last
  };

  std::optional<std::string> judge(const Moment& moment, std::size_t i, Track& track);

  std::vector<Track> tracks_;
};

}  // namespace nord_driver::test
