// The further setpoints and the outputs of one drive, on their way from users to the words that carry them.
//
// A word is used by the function the drive has told of it (P546 to P548 of the parameter set commanded), never by its
// place alone. What can turn the motor is sent only while the drive follows its own velocity command, and only to a word
// whose function is known now. A limit goes on in the word that was known last: 0 in its place would take the torque
// away from a drive that is being stopped. A bit goes high only when P480 is known to give it no function, or where
// somebody has accepted by may_move that it has one; such a bit every stop takes away (WithdrawnBits).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/units.h"
#include "cycle/device_data.h"
#include "cycle/withdrawn_bits.h"
#include "cycle/word_commands.h"
#include "cycle/word_needs.h"
#include "cycle/word_setup.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::cycle {

class DriveWords {
 public:
  DriveWords(const WordSetup& setup, profile::Series series, std::size_t carried);

  /// What is true of the drive in this cycle.
  struct State {
    std::uint8_t set = 0;                ///< commanded, 1..4; 0: none yet
    std::optional<Hertz> max_frequency;  ///< P105 of that set
    bool follows = false;                ///< enabled, and its velocity command is followed
    bool in_doubt = false;               ///< what its words mean is being changed or read again
    WithdrawnBits::State stop;           ///< what takes signals away that may move it
  };

  /// Its connection ended, whether or not it answers again in this cycle.
  void handleInterruption() noexcept { withdrawn_.handleStop(); }
  /// Into what goes to the drive next. A control word with bit 10 = 0 stays alone: the drive evaluates nothing of it.
  void put(profile::ProcessOutput& output, const State& state, const DeviceData& device, const WordCommands& commands,
           Instant now) noexcept;

  /// What was found out of an output that stays off, in words; each finding once.
  std::optional<Sentence> pollFinding(const char* drive, const DeviceData& device, bool in_doubt) noexcept;

  bool empty() const noexcept { return setup_.empty(); }

 private:
  std::int16_t wordOf(const SetpointSetup& setpoint, const WordCommand& command, const State& state,
                      Instant now) const noexcept;
  void putOutputs(profile::ProcessOutput& output, const State& state, const DeviceData& device,
                  const WordCommands& commands, Instant now) const noexcept;
  bool isOn(const SignalSetup& signal, const BitCommand& command, Instant now) const noexcept;
  void learn(const DeviceData& device) noexcept;

  WordSetup setup_;
  profile::Series series_;
  std::size_t carried_;
  std::vector<SignalSetup> outputs_;
  WithdrawnBits withdrawn_;
  std::vector<std::uint16_t> told_;       // of each output, the function that was told as a reason
  std::array<WordFunctions, 4> known_{};  // what each parameter set told last of its setpoints
};

}  // namespace nord_driver::cycle
