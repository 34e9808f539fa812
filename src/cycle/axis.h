// One drive with everything the bus cycle keeps beside it.
#pragma once

#include "cycle/cycle_config.h"
#include "cycle/drive_parameters.h"
#include "cycle/drive_words.h"
#include "cycle/fault_record.h"
#include "cycle/joint_motion.h"
#include "cycle/position_bits.h"
#include "cycle/position_targets.h"
#include "cycle/speed_watch.h"
#include "cycle/terminal_watch.h"
#include "nord_driver/transport/transport.h"
#include "robot/joint_position.h"

namespace nord_driver::cycle {

struct Axis {
  Axis(DriveIndex drive, const DriveSetup& setup, const ParameterChannelUse& channel)
      : parameters(drive, setup.name, setup.series, setup.typed_max_frequency, channel),
        words(channel.users_only ? WordSetup{} : setup.words, setup.series, channel.needs.words),
        bits(channel.users_only ? std::nullopt : setup.position, setup.series, channel.needs.words),
        motion(setup.limits) {}

  DriveParameters parameters;
  DriveWords words;
  PositionBits bits;        ///< of one that positions
  JointMotion motion;       ///< of a drive that belongs to no base
  PositionTargets targets;  ///< of one that positions
  Instant element_until{};  ///< an element of its array that was asked for is awaited until then
  robot::JointPosition joint;
  SpeedWatch speed;
  TerminalWatch terminals;
  FaultRecorder recorder;
  bool known = false;  ///< has answered at least once
};

}  // namespace nord_driver::cycle
