// A minimal inverter for tests of groups: states and ramps one step per cycle, in words typed from BU 2700 6.4.3
// and 6.6.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "nord_driver/profile/process_data.h"

namespace nord_driver::drive {

class FakeInverter {
 public:
  bool silent = false;
  bool fault = false;
  bool cause = false;  ///< of the fault, still there: no acknowledging
  bool local = false;
  bool held = false;           ///< never leaves "switch-on disabled": a safe stop, or no mains
  bool stuck = false;          ///< never leaves "ready to switch on" upwards
  bool endless = false;        ///< never comes down from an OFF1 ramp
  std::int16_t ramp = 0x0400;  ///< per cycle
  std::int16_t minimum = 0;    ///< P104: what it turns at with a setpoint below it, to the right with setpoint 0
  bool terminals = false;      ///< its digital inputs enable it, whatever the bus says
  int set_delay = 0;           ///< cycles until it follows another parameter set
  std::int16_t second = 0;     ///< actual value 2, of a position its low word
  Word more = 0;               ///< bits of its status word besides, say bit 10
  Word taken = 0;              ///< bits of the control word its terminals take away: 0002h is OFF2 there, 0004h OFF3
  bool reached = true;         ///< status bit 8
  std::int16_t third = 0;      ///< actual value 3, of a position its high word

  /// Takes the telegram; the input is what the inverter says after it.
  profile::ProcessInput exchange(const profile::ProcessOutput& output) {
    if ((output.control_word & 0x0400) != 0 && !local) {
      followSet(static_cast<Word>(output.control_word & 0xC000));
      if (!terminals) obey(static_cast<Word>(output.control_word & ~taken), output.setpoints[0]);
    }
    if (terminals) {
      low_ = 0x37;
      rampTo(0x1000, ramp);
    }
    const bool acknowledge = (output.control_word & 0x0080) != 0;
    if (acknowledge && !acknowledge_ && !cause && fault) {
      fault = false;
      low_ = 0x70;
    }
    acknowledge_ = acknowledge;
    if (fault) {
      low_ = 0x38;
      frequency_ = 0;
    }
    profile::ProcessInput input;
    input.status_word = static_cast<Word>((local ? 0x0800 : 0x0A00) | (reached ? 0x0100 : 0) | low_ | set_ | more);
    input.status_word = static_cast<Word>(input.status_word & ~(taken << 3u));  // to bits 4 and 5
    input.actual_values = {frequency_, second, third};
    return input;
  }
  /// Mains off and on: a fault whose cause is gone is gone.
  void switchOffAndOn() {
    fault = cause;
    low_ = 0x70;
    set_ = 0;
    waited_ = 0;
    frequency_ = 0;
  }
  std::int16_t frequency() const { return frequency_; }
  /// 1 to 4, in force.
  unsigned parameterSet() const { return (set_ >> 14) + 1u; }

 private:
  void rampTo(int target, int step) {
    const int distance = std::clamp(target - frequency_, -step, step);
    frequency_ = static_cast<std::int16_t>(frequency_ + distance);
  }
  void followSet(Word wanted) {
    waited_ = wanted == set_ ? 0 : waited_ + 1;
    if (waited_ <= set_delay) return;
    set_ = wanted;
    waited_ = 0;
  }
  void obey(Word word, std::int16_t setpoint) {
    const bool running = low_ == 0x37 || low_ == 0x17;
    if ((word & 0x02) == 0) {
      low_ = 0x70;
      frequency_ = 0;
    } else if ((word & 0x04) == 0) {
      if (running) rampTo(0, 4 * ramp);
      low_ = running && frequency_ != 0 ? 0x17 : 0x70;
    } else if ((word & 0x01) == 0) {
      if (running && !endless) rampTo(0, ramp);
      if ((!running || frequency_ == 0) && !(held && low_ == 0x70)) low_ = 0x31;
    } else if ((word & 0x7F) == 0x7F) {
      if (low_ == 0x33) {
        low_ = 0x37;
      } else if (low_ == 0x31 && !stuck) {
        low_ = 0x33;
      } else if (low_ == 0x37) {
        const int least = setpoint < 0 ? -minimum : minimum;
        rampTo(std::abs(int{setpoint}) < minimum ? least : setpoint, ramp);
      }
    }
  }

  Word low_ = 0x70;
  Word set_ = 0;  // bits 14 and 15
  int waited_ = 0;
  bool acknowledge_ = false;
  std::int16_t frequency_ = 0;
};

}  // namespace nord_driver::drive
