// What the velocity commands say to whoever wants to enable drives: is one moving, and has anybody had the time to
// speak?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cycle/cycle_ports.h"
#include "cycle/word_setup.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// At one moment.
struct CommandState {
  /// Names the newest command that is not zero and not stale; empty when there is none. Nothing is enabled under it.
  Sentence moving;
  Duration heard{};    ///< how long commands have been listened to, since start or since a publisher was connected
  Duration to_hear{};  ///< how much longer, before having heard none counts as a command of zero
  bool quiet = true;   ///< listened long enough, and in all of that time no command but zero came
};

/// A commander that is talking when this node starts is heard 0.1 to 0.25 s later (ROS connects it first): until
/// `cmd_vel_timeout`, at least kLeast, has passed, "none received yet" says nothing.
class CommandWatch {
 public:
  static constexpr Duration kLeast = std::chrono::milliseconds{500};

  /// `of_base`: which drives have no commands of their own.
  CommandWatch(CyclePorts& ports, Duration cmd_vel_timeout, bool has_base, std::vector<std::string> names,
               std::vector<bool> of_base);

  /// A further setpoint of this drive that can turn its motor is a command as well. `index`: as CyclePorts has it.
  void watch(DriveIndex drive, std::size_t index, const SetpointSetup& setpoint);
  /// Each cycle; the first call begins the listening.
  CommandState look(Instant now) noexcept;
  /// The newest cmd_vel is not zero, and not stale.
  bool baseMoves(Instant now) const noexcept { return has_base_ && moves(ports_.newestBaseCommand(), now); }
  /// As CommandState::moving, of these drives alone; `base`: and of the base.
  Sentence movingOf(const std::vector<DriveIndex>& drives, bool base, Instant now) noexcept;

 private:
  struct Watched {
    DriveIndex drive = 0;
    std::size_t index = 0;
    SetpointSetup setup;
  };

  bool moves(const TwistCommand& base, Instant now) const noexcept;
  bool movedWithin(Duration span, Instant now) noexcept;
  Sentence movingBase(Instant now) noexcept;
  Sentence movingDrive(DriveIndex drive, Instant now) noexcept;
  Sentence movingSetpoint(const Watched& watched, Instant now) noexcept;

  CyclePorts& ports_;
  Duration cmd_vel_timeout_;
  Duration listening_time_;
  bool has_base_;
  std::vector<std::string> names_;
  std::vector<bool> of_base_;
  std::vector<DriveIndex> all_;
  std::vector<Watched> setpoints_;
  std::optional<Instant> since_;
};

}  // namespace nord_driver::cycle
