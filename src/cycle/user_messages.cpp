#include "cycle/user_messages.h"

namespace nord_driver::cycle {

using drive::Refusal;
using drive::StopCause;

namespace {

const char* nextCall(Refusal refusal) noexcept {
  if (refusal == Refusal::kFaultLatched) return "; call ~acknowledge_faults";
  if (refusal == Refusal::kFault) return "; when its cause is gone, call ~acknowledge_faults";
  if (refusal == Refusal::kLocalControl)
    return ": does P509 select this bus, or is an input with \"remote control\" low?";
  return "";
}

// "set P547 of drive left to 2 (Torque current limit) in parameter set 1: ..."
Sentence missingWordMessage(const char* drive, const drive::UnexpectedFunction& function, unsigned set) noexcept {
  constexpr unsigned kNotRead = 0xFFFF;
  FixedText<24> element, found;
  if (function.is_array) element.format("[-%02u]", unsigned{function.index});
  found.format(function.found == kNotRead ? "could not be read" : "is %u", unsigned{function.found});
  Sentence text;
  text.format("set P%u%s of drive %s to %u (%s) in parameter set %u: %s; P%u%s %s", unsigned{function.number},
              element.c_str(), drive, unsigned{function.expected}, function.wanted, set,
              function.surplus ? "what another word carries would mean something else beside it"
                               : "the configuration uses it, and no word carries it",
              unsigned{function.number}, element.c_str(), found.c_str());
  return text;
}

// P600, and P610 of a drive that positions.
Sentence positionModeMessage(const char* drive, const drive::UnexpectedFunction& function, unsigned set) noexcept {
  constexpr unsigned kNotRead = 0xFFFF;
  FixedText<24> found;
  found.format(function.found == kNotRead ? "could not be read" : "is %u", unsigned{function.found});
  Sentence text;
  if (function.surplus) {
    text.format(
        "drive %s: P600 of parameter set %u %s: with position control on it follows no velocity, and mode is velocity; "
        "set P600 to 0",
        drive, set, found.c_str());
  } else if (function.number == 600) {
    text.format(
        "drive %s: P600 %s: with 0 it does not position, and mode is position; set P600 to what its manual (BU 0510, "
        "BU 0710) says for position control",
        drive, found.c_str());
  } else {
    text.format(
        "drive %s: P%u %s: its target comes from elsewhere; set P%u to %u, or position/setpoint_mode to what "
        "its manual says",
        drive, unsigned{function.number}, found.c_str(), unsigned{function.number}, unsigned{function.expected});
  }
  return text;
}

// Enabled, it would turn at what its terminals say.
Sentence elsewhereMessage(const char* drive, const drive::UnexpectedSource& source) noexcept {
  Sentence text;
  const bool control_word = source.number == 509;
  text.format(
      "drive %s: P%u%s is %d: its setpoint does not come from this bus, and enabled it would turn whatever this driver "
      "says; set it to %s",
      drive, unsigned{source.number}, source.is_array ? "[-01]" : "", static_cast<int>(source.found),
      control_word ? "10 or 14, control word and setpoint of this bus" : "0 (as P509)");
  return text;
}

// It would go as another inverter says, or as this bus says though another one is to lead it.
Sentence sourceMessage(const char* drive, const drive::UnexpectedSource& source) noexcept {
  if (source.elsewhere) return elsewhereMessage(drive, source);
  Sentence text;
  const char* const element = source.is_array ? "[-01]" : "";
  if (source.should_follow) {
    text.format(
        "drive %s is to follow another inverter (drives/%s/follows), and P%u%s is %d, no broadcast: it would go "
        "by this bus; set it, or P509, to the broadcast",
        drive, drive, unsigned{source.number}, element, static_cast<int>(source.found));
    return text;
  }
  text.format(
      "drive %s follows another inverter: P%u%s is %d, broadcast, so that its %s not come from this driver; set "
      "it to this bus, or name that drive: drives/%s/follows",
      drive, unsigned{source.number}, element, static_cast<int>(source.found),
      source.number == 509 ? "control word does" : "setpoint does", drive);
  return text;
}

// What keeps an inverter from becoming ready that was told to, as far as its status word tells (BU 2700 6.4.2).
const char* heldBy(Word status_word) noexcept {
  const profile::StatusWord status{status_word};
  if (!status.voltageEnabled()) return ", bit 4 = 0: OFF2 or safe stop (STO) at its terminals, or no mains";
  if (!status.quickStopInactive()) return ", bit 5 = 0: OFF3 (quick stop, emergency stop) at its terminals";
  return "";
}

const char* stateAtStop(const drive::DriveReport& report) noexcept {
  return profile::toString(profile::StatusWord{report.stop_status_word}.state());
}

}  // namespace

Sentence refusalMessage(const char* drive, Refusal refusal, const drive::DriveReport& report) noexcept {
  Sentence text;
  if (refusal == Refusal::kMinimumFrequency && report.minimum_frequency.value > 0.0) {
    text.format(
        "drive %s: P104 of parameter set %u is %.1f Hz: enabled, the motor would turn at that with setpoint 0; set "
        "P104 to "
        "0, or allow_minimum_frequency: true",
        drive, unsigned{report.commanded_set}, report.minimum_frequency.value);
    return text;
  }
  if (refusal == Refusal::kUnexpectedFunction && report.unexpected_function) {
    const drive::UnexpectedFunction& function = *report.unexpected_function;
    if (function.number >= 600) return positionModeMessage(drive, function, report.commanded_set);
    if (function.wanted != nullptr) return missingWordMessage(drive, function, report.commanded_set);
    text.format("drive %s: P%u%s of parameter set %u is %u, so that %s 1 is not the frequency; set it to %u", drive,
                unsigned{function.number}, function.is_array ? " [-01]" : "", unsigned{report.commanded_set},
                unsigned{function.found}, function.number == 543 ? "actual value" : "setpoint",
                unsigned{function.expected});
    return text;
  }
  if (refusal == Refusal::kUnexpectedSource && report.unexpected_source) {
    return sourceMessage(drive, *report.unexpected_source);
  }
  const bool of_its_stop =
      refusal == Refusal::kHomingStopped || (refusal == Refusal::kStopped && report.refusal == refusal);
  if (of_its_stop && report.stop_cause != StopCause::kNone) {
    text.format("drive %s: %s: %s (status word %04X, %s)", drive, drive::toString(refusal),
                drive::toString(report.stop_cause), report.stop_status_word, stateAtStop(report));
    return text;
  }
  const char* const held = refusal == Refusal::kEnableTimeout ? heldBy(report.status_word) : "";
  if (report.online && report.switch_on_reason) {
    const unsigned reason = *report.switch_on_reason;
    text.format("drive %s: %s%s (status word %04X, %s%s%s%u.%u)", drive, drive::toString(refusal), nextCall(refusal),
                report.status_word, profile::toString(report.state), held, kOwnReason, reason / 10, reason % 10);
  } else if (report.online) {
    text.format("drive %s: %s%s (status word %04X, %s%s)", drive, drive::toString(refusal), nextCall(refusal),
                report.status_word, profile::toString(report.state), held);
  } else {
    text.format("drive %s: %s", drive, drive::toString(refusal));
  }
  return text;
}

Sentence stopMessage(const char* drive, StopCause cause, const drive::DriveReport& report) noexcept {
  Sentence text;
  if (cause == StopCause::kNone) return text;
  const char* const state = stateAtStop(report);
  if (report.online && report.switch_on_reason) {
    const unsigned reason = *report.switch_on_reason;
    text.format("drive %s stopped: %s (status word %04X, %s%s%u.%u)", drive, drive::toString(cause),
                report.stop_status_word, state, kOwnReason, reason / 10, reason % 10);
  } else {
    text.format("drive %s stopped: %s (status word %04X, %s)", drive, drive::toString(cause), report.stop_status_word,
                state);
  }
  return text;
}

Sentence stateMessage(const char* drive, const drive::DriveReport& report) noexcept {
  Sentence text;
  if (report.online) {
    text.format("drive %s is %s, status word %04X", drive, profile::toString(report.state), report.status_word);
  } else {
    text.format("drive %s does not answer", drive);
  }
  return text;
}

Sentence unconfirmedMessage(const char* drive, const drive::DriveReport& report) noexcept {
  Sentence text;
  text.format("not confirmed in time: %s", stateMessage(drive, report).c_str());
  return text;
}

Sentence terminalMessage(const char* drive, TerminalFinding finding, const drive::DriveReport& report) noexcept {
  Sentence text;
  switch (finding) {
    case TerminalFinding::kNone:
      break;
    case TerminalFinding::kHeld:
      text.format("drive %s is held in \"%s\" (status word %04X%s)", drive, profile::toString(report.state),
                  report.status_word, heldBy(report.status_word));
      break;
    case TerminalFinding::kLocalControl:
      text.format(
          "drive %s is under local control (status bit 9 = 0, status word %04X): its terminals may turn it whatever is "
          "sent",
          drive, report.status_word);
      break;
    case TerminalFinding::kTurned:
      text.format(
          "drive %s turns although nothing here has enabled it (status word %04X, %s, %.1f Hz): by its terminals, or "
          "by bus I/O bits (P480)",
          drive, report.status_word, profile::toString(report.state), report.frequency.value);
      break;
  }
  return text;
}

Sentence parameterMessage(const char* drive, std::uint16_t number, const profile::ParameterResult& result,
                          bool no_bus_control) noexcept {
  const char* const note = result.note;
  const char* const joint = note[0] != '\0' ? "; " : "";
  const char* const words = result.text.empty() ? profile::toString(result.reason) : result.text.c_str();
  const char* const colon = words[0] != '\0' ? ": " : "";
  Sentence text;
  switch (result.outcome) {
    case profile::ParameterOutcome::kDone:
      text.format("%s", note);
      break;
    case profile::ParameterOutcome::kRefused:
      if (result.reason == profile::ParameterReason::kDriver) {
        text.format("P%03u of drive %s: %s", number, drive, note);
      } else {
        const char* const source =
            no_bus_control ? "; the bus has no control (status bit 9 = 0): does P509 select it? Parameters are "
                             "written over a bus only while it does (BU 0020 6.2.2)"
                           : "";
        text.format("drive %s refuses P%03u%s%s%s%s%s", drive, result.refused_number, colon, words, source, joint,
                    note);
      }
      break;
    case profile::ParameterOutcome::kTimeout:
      text.format("drive %s gave no answer for P%03u%s%s%s%s", drive, number, colon, words, joint, note);
      break;
    case profile::ParameterOutcome::kOffline:
      text.format("drive %s does not answer%s%s%s%s", drive, colon, words, joint, note);
      break;
    case profile::ParameterOutcome::kNoChannel:
      text.format("no parameter channel reaches P%03u of drive %s%s%s", number, drive, colon, words);
      break;
    case profile::ParameterOutcome::kBusy:
      text.format("drive %s has too many parameter requests waiting already", drive);
      break;
  }
  return text;
}

}  // namespace nord_driver::cycle
