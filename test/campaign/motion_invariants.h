// The invariants of motion, judged on the true speeds.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "campaign/invariant.h"
#include "campaign/speed_bound.h"

namespace nord_driver::test {

/// How fast a drive that is told speeds may be: what is wanted of it, along the driver's own ramp, and its own down.
class CommandedSpeed {
 public:
  /// After each cycle, `dt` s after the one before. `wanted`: Hz, at least 0; `speed`: Hz, how fast it is.
  void look(const Moment& moment, const GroupWish& group, DriveIndex drive, double wanted, double speed, double dt);

  double value() const noexcept { return bound_.value(); }            ///< Hz
  double allowedNow() const noexcept { return bound_.allowedNow(); }  ///< Hz

 private:
  double told_ = 0.0;  // Hz, at most, by the driver's own ramp
  SpeedBound bound_;
  bool by_terminals_ = false;
};

/// The field of an inverter is never faster than what was wanted within the time a stop needs to reach it, less the
/// ramp since.
class TurnsOnlyAsCommanded final : public Invariant {
 public:
  const char* name() const override { return "TurnsOnlyAsCommanded"; }
  const char* sentence() const override {
    return "command older than cmd_vel_timeout, enable false, quick_stop, fault, drive silent, bus lost: ramp, OFF1 or "
           "the "
           "drive-side time-outs, within their bounds (What stops what)";
  }
  std::optional<std::string> look(const Moment& moment) override;

  /// The longest a drive was still seen turning after nothing allowed it any more, and how long it might have been, s.
  struct Stop {
    double took = 0.0;
    double bound = 0.0;
  };
  const Stop& worstStop() const noexcept { return worst_; }

 private:
  struct Track {
    CommandedSpeed bound;
    std::optional<Instant> ended;  // when nothing allowed it any more
    double stop_took = 0.0;
    double stop_bound = 0.0;
  };

  std::vector<Track> tracks_;
  std::optional<Instant> last_;
  Stop worst_;
};

/// The same of each direction: nobody turns the way that was not wanted within that time.
class TurnsTheCommandedWay final : public Invariant {
 public:
  const char* name() const override { return "TurnsTheCommandedWay"; }
  const char* sentence() const override {
    return "P104 above 0: no wheel turns against the commanded motion (doc/safety.md)";
  }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  std::vector<std::array<CommandedSpeed, 2>> bounds_;  // of each drive: forward, backward
  std::optional<Instant> last_;
};

/// An inverter becomes "operation enabled" by the bus only after somebody has asked for it.
class NothingEnabledUnasked final : public Invariant {
 public:
  const char* name() const override { return "NothingEnabledUnasked"; }
  const char* sentence() const override {
    return "after each: disabled, latched, named; only ~enable (or auto_enable) moves again (What stops what)";
  }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  std::vector<bool> enabled_;
  std::vector<bool> unasked_;   // it became so while nobody asked for it
  std::vector<Instant> asked_;  // when each drive was asked for last
};

/// A drive that answers at the address of another one is never enabled with it.
class NobodyUnknownEnabled final : public Invariant {
 public:
  const char* name() const override { return "NobodyUnknownEnabled"; }
  const char* sentence() const override {
    return "two nodes answer with this id: named, not started, not enabled (doc/canopen.md)";
  }
  std::optional<std::string> look(const Moment& moment) override;
};

/// While a member of a base does not turn by the bus, the others have no setpoint but 0, within the bound.
class NeverOneWheelAlone final : public Invariant {
 public:
  const char* name() const override { return "NeverOneWheelAlone"; }
  const char* sentence() const override {
    return "fault, unasked exit, local control, drive silent: that drive idle; the others setpoint 0 on the drive's "
           "own "
           "ramp, then OFF1 (What stops what)";
  }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  std::vector<std::optional<Instant>> since_;  // of each group
};

}  // namespace nord_driver::test
