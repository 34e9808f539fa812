// A drive that positions, disabled and answered for: what its tests of "at standstill only" share.
#pragma once

#include <gtest/gtest.h>

#include "drive/drive.h"

namespace nord_driver::drive {

/// SK 53xE, as in test_position_drive.cpp: frequency, low word, high word.
class AxisAtRest : public ::testing::Test {
 protected:
  static constexpr Duration kCycle = seconds(0.01);
  static constexpr Word kReady = 0x0B31;

  static DriveConfig config() {
    DriveConfig result;
    result.joint.gear_ratio = 1.0;
    result.max_frequency[0] = Hertz{50.0};
    result.position = PositionConfig{};
    return result;
  }
  AxisAtRest() { setWords(); }
  void setWords() {
    drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
  }
  void cycle(Word status_word = kReady, std::int16_t frequency = 0) {
    send();
    profile::ProcessInput input;
    input.status_word = status_word;
    input.actual_values = {frequency, static_cast<std::int16_t>(count_ & 0xFFFF),
                           static_cast<std::int16_t>(count_ >> 16)};
    drive_.handleInput(input, true, now_);
  }
  /// A telegram that is not answered.
  void silence() {
    send();
    drive_.handleInput({}, false, now_);
  }
  void send() {
    sent_ = drive_.pollOutput(now_).control_word;
    sent_axis_ = report().position;
    now_ += kCycle;
  }
  void start() {
    for (int i = 0; i < 6; ++i) cycle();
    ASSERT_TRUE(report().position.position);
  }
  const DriveReport& report() const { return drive_.report(); }

  Drive drive_{config()};
  Word sent_ = 0;
  PositionReport sent_axis_;     // its bits go out beside the word sent
  std::int32_t count_ = 12'345;  // steps of 0.001 revolutions
  Instant now_{std::chrono::hours{1}};
};

}  // namespace nord_driver::drive
