#include "transport/interbus/interbus_drive.h"

#include "profile/status_word.h"

namespace nord_driver {

namespace {

constexpr std::uint16_t kMaxFrequency = 105;
constexpr double kMaxFrequencyResolution = 0.1;  // Hz

}  // namespace

InterbusDriveState::InterbusDriveState(const InterbusDrive& config) : typed_max_frequency_(config.typed_max_frequency) {
  if (config.drive_profile != InterbusProfile::kDrivecom) return;
  drivecom_.emplace(config.scaling.pole_pairs);
  drivecom_->setMaxFrequency(config.typed_max_frequency);
}

interbus::ProcessWords InterbusDriveState::toWords(const profile::ProcessOutput& output) const noexcept {
  interbus::ProcessWords words;
  if (drivecom_) {
    const profile::DrivecomOutput to = drivecom_->toDrivecom(output);
    words.head = to.control_word;
    words.values[0] = toWord(to.speed_setpoint);
    return words;
  }
  words.head = output.control_word;
  for (std::size_t i = 0; i < words.values.size(); ++i) words.values[i] = toWord(output.setpoints[i]);
  return words;
}

profile::ProcessInput InterbusDriveState::fromWords(const interbus::ProcessWords& words) const noexcept {
  if (drivecom_) return drivecom_->fromDrivecom({words.head, toSigned(words.values[0])});
  profile::ProcessInput input;
  input.status_word = words.head;
  for (std::size_t i = 0; i < words.values.size(); ++i) input.actual_values[i] = toSigned(words.values[i]);
  return input;
}

// A module with 24 V of its own keeps the ring going for an inverter that is off, with zeros. But zeros come from a
// ring that stands, too, where the gateway has no register that says so: nobody knows that such an inverter hears
// nothing, so `inverter_missing` is never said.
void InterbusDriveState::takeInput(const interbus::ProcessWords& words, const InputWatch& watch,
                                   DriveExchange& input) noexcept {
  input = {};
  input.module_answers = watch.isGood();
  input.interruption = watch.interruption();
  if (!watch.isGood()) answers_ = false;
  if (!watch.isFresh()) return;
  input.input = fromWords(words);
  answers_ = profile::StatusWord{input.input.status_word}.isUseful();
  input.inverter_answers = answers_;
  if (!answers_) input.input = {};
}

void InterbusDriveState::handleSubmitted(const profile::ParameterRequest& request) noexcept {
  const bool of_set_1 = request.shape == profile::ParameterShape::kPlain || request.parameter_set == 1;
  if (!drivecom_ || !request.scales || request.number != kMaxFrequency || !of_set_1) return;
  max_frequency_reads_.push_back(request.id);
  // The drive layer, too, begins anew with what was typed in.
  drivecom_->setMaxFrequency(typed_max_frequency_);
}

// Revolutions per minute are told as shares of P105 by what the drive layer itself has read of it.
void InterbusDriveState::handleResult(const profile::ParameterResult& result) noexcept {
  for (std::size_t i = 0; i < max_frequency_reads_.size(); ++i) {
    if (max_frequency_reads_[i] != result.id) continue;
    if (result.outcome == profile::ParameterOutcome::kDone && result.raw > 0) {
      drivecom_->setMaxFrequency(Hertz{kMaxFrequencyResolution * result.raw});
    }
    max_frequency_reads_[i] = max_frequency_reads_[max_frequency_reads_.size() - 1];
    max_frequency_reads_.resize(max_frequency_reads_.size() - 1);
    return;
  }
}

const char* InterbusDriveState::note(const InputWatch& watch) const noexcept {
  switch (watch.worth()) {
    case InputWorth::kNone:
      return "no inputs have come from the gateway yet";
    case InputWorth::kOld:
      return "the gateway does not answer, or too late: its inputs are older than drive_timeout";
    case InputWorth::kRingStands:
      return "the ring behind the gateway does not run (bus/running)";
    case InputWorth::kGood:
      break;
  }
  return answers_ ? ""
                  : "its status word is 0: is its mains supply on, is its place in the image right (input_offset), "
                    "does the ring run?";
}

}  // namespace nord_driver
