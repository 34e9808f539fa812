// What the cycle has to say to people, made without allocating.
#pragma once

#include "cycle/request.h"
#include "cycle/terminal_watch.h"
#include "drive/drive_report.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::cycle {

/// Before P700[-03] in a sentence of a stop or a refusal: it is read later than the stop, may change and ends, while the
/// stop is the same one.
constexpr char kOwnReason[] = "; the inverter's own reason, P700[-03], is ";

/// "drive left: the drive does not answer".
Sentence refusalMessage(const char* drive, drive::Refusal refusal, const drive::DriveReport& report) noexcept;
/// "drive left stopped: a fault (status word 0238, fault)"; empty for StopCause::kNone.
Sentence stopMessage(const char* drive, drive::StopCause cause, const drive::DriveReport& report) noexcept;
/// "drive left is operation enabled (status word 0B37)".
Sentence stateMessage(const char* drive, const drive::DriveReport& report) noexcept;
/// "not confirmed in time: " and stateMessage().
Sentence unconfirmedMessage(const char* drive, const drive::DriveReport& report) noexcept;
/// "drive left is under local control ..."; empty for TerminalFinding::kNone.
Sentence terminalMessage(const char* drive, TerminalFinding finding, const drive::DriveReport& report) noexcept;
/// Why the access to parameter `number` failed, or what was done besides; empty when there is nothing to say.
/// `no_bus_control`: it was a write, and the bus has no control (status bit 9 = 0), which may be why it was refused.
Sentence parameterMessage(const char* drive, std::uint16_t number, const profile::ParameterResult& result,
                          bool no_bus_control = false) noexcept;

}  // namespace nord_driver::cycle
