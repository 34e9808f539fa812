// A drive under test, one bus cycle at a time: every test is a conversation of control words and status words.
#pragma once

#include <gtest/gtest.h>

#include "drive/drive.h"

namespace nord_driver::drive {

class DriveTest : public ::testing::Test {
 protected:
  static constexpr Duration kCycle = seconds(0.01);

  static DriveConfig config() {
    DriveConfig result;
    result.joint.gear_ratio = 20.0;
    result.joint.pole_pairs = 2;  // 50 Hz are 7.854 rad/s at the joint
    result.max_frequency[0] = Hertz{50.0};
    result.max_frequency[2] = Hertz{100.0};
    result.drive_timeout = seconds(0.05);
    result.enable_timeout = seconds(0.5);
    result.setup_timeout = seconds(0.5);
    result.shutdown_timeout = seconds(1.0);
    result.acknowledge_time = seconds(0.03);
    return result;
  }

  /// One cycle with an answer: returns the control word that was sent.
  Word cycle(Word status_word, std::int16_t actual_value = 0) {
    const profile::ProcessOutput output = drive_.pollOutput(now_);
    now_ += kCycle;
    profile::ProcessInput input;
    input.status_word = status_word;
    input.actual_values[0] = actual_value;
    drive_.handleInput(input, true, now_);
    setpoint_ = output.setpoints[0];
    return output.control_word;
  }
  /// One cycle without an answer.
  Word silence() {
    const profile::ProcessOutput output = drive_.pollOutput(now_);
    now_ += kCycle;
    drive_.handleInput({}, false, now_);
    setpoint_ = output.setpoints[0];
    return output.control_word;
  }
  void fallSilent() {
    for (int i = 0; i < 10 && drive_.report().online; ++i) silence();
    ASSERT_FALSE(drive_.report().online);
  }
  /// Learns set 1 and is idle at "ready to switch on".
  void start() {
    cycle(0x0B31);
    cycle(0x0B31);
  }
  /// Set 1, enabled and at rest.
  void enable() {
    start();
    drive_.requestEnable(now_);
    cycle(0x0B31);
    cycle(0x0B37);
    ASSERT_EQ(Phase::kEnabled, drive_.report().phase);
  }
  /// Enabled and at half of P105.
  void run() {
    enable();
    drive_.setVelocity({3.926990816987241});
    cycle(0x0B37, 0x1000);
    ASSERT_EQ(0x047F, cycle(0x0B37, 0x2000));
    ASSERT_EQ(0x2000, setpoint_);
  }
  const DriveReport& report() const { return drive_.report(); }

  Drive drive_{config()};
  Instant now_{std::chrono::hours{1}};
  std::int16_t setpoint_ = 0;
};

}  // namespace nord_driver::drive
