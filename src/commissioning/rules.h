// The rules of the commissioning check: what is wrong with a drive's parameters, one small function each.
#pragma once

#include <vector>

#include "commissioning/drive_under_check.h"

namespace nord_driver::commissioning {

using Drives = std::vector<DriveUnderCheck>;
using Findings = std::vector<Finding>;

/// Judges the drive `index` of `drives`. What could not be read is not judged; see unreadable().
using RuleCheck = void (*)(const Drives& drives, std::size_t index, Findings& to);

struct Rule {
  const char* name;        ///< of Finding::rule
  const char* parameters;  ///< "P509"
  const char* expected;    ///< what is right
  const char* why;         ///< why it matters
  const char* remedy;      ///< what `--fix` writes; "-": nothing, a person decides
  const char* source;      ///< manual, chapter, page
  RuleCheck check;
};

/// Every rule, in the order findings are told. doc/commissioning.md has the same rows.
const std::vector<Rule>& rules();

/// The rows of doc/commissioning.md, as Markdown.
std::vector<std::string> rulesAsRows();

// control_source.cpp
void busHasControl(const Drives& drives, std::size_t index, Findings& to);
void busGivesSetpoint(const Drives& drives, std::size_t index, Findings& to);
// position_bits.cpp
void positionBitsFit(const Drives& drives, std::size_t index, Findings& to);
// process_values.cpp
void firstSetpointIsFrequency(const Drives& drives, std::size_t index, Findings& to);
void firstActualValueIsFrequency(const Drives& drives, std::size_t index, Findings& to);
void furtherSetpointsAreFree(const Drives& drives, std::size_t index, Findings& to);
void askedWordsAreCarried(const Drives& drives, std::size_t index, Findings& to);
void drivePositions(const Drives& drives, std::size_t index, Findings& to);
void countHasNoOtherGear(const Drives& drives, std::size_t index, Findings& to);
void currentIsMapped(const Drives& drives, std::size_t index, Findings& to);
// protection.cpp
void busErrorsAreHeeded(const Drives& drives, std::size_t index, Findings& to);
void timeoutIsLongEnough(const Drives& drives, std::size_t index, Findings& to);
void moduleIsWatched(const Drives& drives, std::size_t index, Findings& to);
// speeds.cpp
void maximumReachesTopSpeed(const Drives& drives, std::size_t index, Findings& to);
void maximumIsAsTyped(const Drives& drives, std::size_t index, Findings& to);
// unasked_motion.cpp
void minimumIsZero(const Drives& drives, std::size_t index, Findings& to);
void busBitsStartNothing(const Drives& drives, std::size_t index, Findings& to);
// whole_drive.cpp
void setInForceIsFirst(const Drives& drives, std::size_t index, Findings& to);
void drivesOfBaseAreAlike(const Drives& drives, std::size_t index, Findings& to);
void writesAreSaved(const Drives& drives, std::size_t index, Findings& to);
void decidingOnesAreReadable(const Drives& drives, std::size_t index, Findings& to);

}  // namespace nord_driver::commissioning
