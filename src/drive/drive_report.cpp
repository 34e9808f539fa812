#include "drive/drive_report.h"

namespace nord_driver::drive {

const char* toString(StopCause cause) noexcept {
  switch (cause) {
    case StopCause::kNone:
      return "nothing";
    case StopCause::kFault:
      return "a fault of the inverter";
    case StopCause::kUnaskedExit:
      return "the inverter left \"operation enabled\" without being asked";
    case StopCause::kOff2:
      return "OFF2 at the inverter's terminals: its output was switched off and the motor coasts (status bit 4 = 0)";
    case StopCause::kOff3:
      return "OFF3 at the inverter's terminals: quick stop or emergency stop (status bit 5 = 0)";
    case StopCause::kLocalControl:
      return "local control: the inverter's terminals have taken over (status bit 9 = 0)";
    case StopCause::kSilent:
      return "the inverter fell silent";
    case StopCause::kInterrupted:
      return "its connection to the bus was reset, or left operation, without being asked";
    case StopCause::kContested:
      return "another master commands it, too";
    case StopCause::kParameterSet:
      return "another parameter set came into force without being asked for";
    case StopCause::kQuickStop:
      return "a quick stop was asked for";
    case StopCause::kShutdownTimeout:
      return "the ramp down (OFF1) did not end in time, so a quick stop followed";
    case StopCause::kCoast:
      return "switching the output off (OFF2) was asked for";
    case StopCause::kCommandTimeout:
      return "no new velocity command came within cmd_vel_timeout";
    case StopCause::kPositionJump:
      return "its position changed faster than the motor can turn: the count of the drive has a new zero";
    case StopCause::kHomingTimeout:
      return "the reference run did not end within position/homing_timeout";
    case StopCause::kStrayed:
      return "it left the way to the element of its array it was told (none: where it stood) by more than "
             "position/stray";
    case StopCause::kUnsuitable:
      return "a parameter that could not be read before says that it must not be driven (~enable names it)";
    case StopCause::kNotResumed:
      return "the inverter did not come from rest (OFF1, for P104 > 0) to \"operation enabled\" in time";
  }
  return "";
}

const char* toString(Refusal refusal) noexcept {
  switch (refusal) {
    case Refusal::kNone:
      return "nothing";
    case Refusal::kOffline:
      return "the inverter does not answer";
    case Refusal::kFault:
      return "the inverter reports a fault";
    case Refusal::kFaultLatched:
      return "a fault was seen and has not been acknowledged";
    case Refusal::kLocalControl:
      return "the inverter is under local control (status bit 9 = 0)";
    case Refusal::kStopping:
      return "the drive is still being stopped; ask again when it has come to rest";
    case Refusal::kBusy:
      return "the drive is busy with another request";
    case Refusal::kWrongState:
      return "from this state the inverter cannot be enabled";
    case Refusal::kParameterSet:
      return "the parameter set in force is not the one that is commanded";
    case Refusal::kMaxFrequencyUnknown:
      return "the maximum frequency (P105) of the parameter set in force is not known";
    case Refusal::kParametersAwaited:
      return "its parameters P104, P105, P509, P510, P543, P546 and P600 are still being read, or one that decides "
             "motion is being written";
    case Refusal::kMinimumFrequency:
      return "P104 of the parameter set in force is above 0: enabled, the motor turns at setpoint 0";
    case Refusal::kUnexpectedFunction:
      return "P543 or P546 of the parameter set in force makes actual value 1 or setpoint 1 something else than the "
             "frequency, or P600 does not fit the mode";
    case Refusal::kUnexpectedSource:
      return "its control word or setpoint does not come from where the configuration says (P509, P510)";
    case Refusal::kEnableTimeout:
      return "the inverter did not reach \"operation enabled\" in time";
    case Refusal::kStopped:
      return "a stop came before the inverter was enabled";
    case Refusal::kRequestStopped:
      return "a stop came before it was done";
    case Refusal::kCauseStands:
      return "the cause of the fault still stands";
    case Refusal::kNotDisabled:
      return "the parameter set is switched at standstill only, and the drive is enabled or being stopped";
    case Refusal::kTurning:
      return "the parameter set is switched at standstill only, and the motor turns";
    case Refusal::kNoSuchSet:
      return "there are parameter sets 1 to 4 only";
    case Refusal::kOnlySet1:
      return "its drive profile has parameter set 1 only: no other one can be selected over this bus";
    case Refusal::kPositionUnknown:
      return "its position is not known yet";
    case Refusal::kPositionBeyondRange:
      return "it stands where its setpoint words cannot hold it (16 bits: -32.768 to 32.767 revolutions)";
    case Refusal::kNotEnabled:
      return "the drive is not enabled, and a reference run moves it: enable it first";
    case Refusal::kHomingTurning:
      return "a reference run begins at standstill, and the motor turns";
    case Refusal::kHomingTimeout:
      return "the reference run did not end within position/homing_timeout, and the drive was stopped";
    case Refusal::kHomingStopped:
      return "the drive was stopped before the reference run had ended";
    case Refusal::kTeachNotDisabled:
      return "a position is taught, or reset, at standstill only, and the drive is enabled or being stopped: disable "
             "it first";
    case Refusal::kTeachTurning:
      return "a position is taught, or reset, at standstill only, and the motor turns";
    case Refusal::kTeachStopped:
      return "something else was asked of the drive before its position was taught: whether its array has it is not "
             "known";
    case Refusal::kTeachTimeout:
      return "teaching the position did not end in time: whether the array of the drive has it is not known";
    case Refusal::kResetStopped:
      return "something else was asked of the drive before its position was reset: look where it says it is";
    case Refusal::kResetTimeout:
      return "the bit went to the drive, and its position did not become position/reset_to in time";
    case Refusal::kSetNotConfirmed:
      return "the inverter did not confirm the new parameter set in time";
  }
  return "";
}

}  // namespace nord_driver::drive
