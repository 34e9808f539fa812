#include "commissioning/rules.h"

namespace nord_driver::commissioning {

const std::vector<Rule>& rules() {
  static const std::vector<Rule> kRules{
      {"bus_has_control", "P509",
       "selects this bus: SK 1x0E/2xxE 3; SK 5xxE/54xE 4 PROFIBUS, 5 InterBus, 6 CANopen, 7 "
       "DeviceNet, 6 behind SK CU4/TU4; SK 300E/7x0E 10 PROFIBUS, 14 InterBus",
       "without it the drive obeys its terminals, and does not become ready; with 9 or 13 (SK 300E/7x0E) it would, "
       "and is not enabled",
       "this bus", "BU 0020, 6.2.2, p. 63; 6.1.2, p. 56; BU 0070, 5.1; BU 2700, 7.2", busHasControl},
      {"bus_gives_setpoint", "P510 [-01]", "0 (as P509), or this bus",
       "the setpoint would come from somewhere else: the drive is not enabled", "0",
       "BU 2700, 7.2; BU 0020, 6.1.2, p. 56", busGivesSetpoint},
      {"first_setpoint", "P546 [-01], all sets", "1, the frequency", "a command would be no speed", "1",
       "BU 0020, 6.2.2, p. 65; 6.1.2, p. 58; BU 0220, 5.1.3", firstSetpointIsFrequency},
      {"first_actual_value", "P543 [-01], all sets", "1, the frequency",
       "the odometry would take something else for a speed", "1", "BU 0020, 6.2.2, p. 64; 6.1.2, p. 57; BU 0280, 5.1.3",
       firstActualValueIsFrequency},
      {"asked_words", "P544, P545, P547, P548 or P543, P546 [-02], [-03]",
       "the functions that setpoints, signals and torque_at_limit of the configuration need",
       "the driver does not enable the drive without them", "the function",
       "BU 0020, 6.2.2, p. 64 and 66; 6.1.2, p. 57", askedWordsAreCarried},
      {"further_setpoints", "P547, P548 or P546 [-02], [-03], where they are carried",
       "0, off, or what the configuration commands",
       "the driver sends 0 there, which limits torque, current or frequency to 0 in some functions", "0",
       "BU 0020, 6.2.2, p. 66; 6.1.2, p. 58; BU 0220, 5.1.3", furtherSetpointsAreFree},
      {"position_control", "P600, all sets; with mode: position P600 and P610",
       "P600 0; with mode: position not 0, and P610 as position/setpoint_mode, where configured",
       "the driver does not enable the drive: it would follow no velocity, or not go to positions, or not to ours",
       "0; the value of P610", "BU 0020, 7.3.5, p. 77; no manual at hand describes P600", drivePositions},
      {"position_bits", "P480, P481, with mode: position",
       "of each bit that position/home, reset, teach_in, array_bit or referenced names, the function configured beside "
       "it",
       "a reference run, a reset, teaching, an element is refused, and homed not told", "that function",
       "BU 0020, 6.2.1, p. 61; no manual at hand has the list of P420", positionBitsFit},
      {"position_gear", "P607, P608, with mode: position",
       "alike, or their ratio, either way round, position/gear_ratio by gear_ratio",
       "every position would be wrong by that factor; which of the two multiplies, no manual at hand says", "-",
       "BU 2700, 6.4.4", countHasNoOtherGear},
      {"current", "P544, P545 or P543 [-02], [-03], with rated_current", "one of them 3, the current",
       "the status tells no current without it", "3 in one that nothing needs", "BU 0020, 6.2.2, p. 64; 6.1.2, p. 57",
       currentIsMapped},
      {"bus_errors_heeded", "P513, P151 of the module", "not negative; above 0 where the bus itself stops nothing",
       "the motor runs on when this computer dies", "0, or 0.5 s where 0 is too little", "BU 2700, 7.1.1 and 8.1",
       busErrorsAreHeeded},
      {"timeout_long_enough", "P513, P151 of the module",
       "two bus cycles, the longest cycle there may be, and two pauses between telegrams where not each cycle has one; "
       "with read_only not above 0",
       "E10.x without a reason", "0.5 s, or longer where the bus needs it", "BU 0220, 4.2.3.2; BU 2700, 7.1.1",
       timeoutIsLongEnough},
      {"module_watched", "P120 [-01]; P513 in SK 511E to 535E", "not 0 behind SK CU4/TU4",
       "the inverter does not notice a module that fails", "1, Auto; 0.5 s", "BU 2700, 8.1", moduleIsWatched},
      {"top_speed", "P105 of the set in force",
       "what the limits of the base or of the joint ask; more than a tenth of it used",
       "the base is never that fast, or gear_ratio and pole_pairs are wrong", "-", "BU 2700, 6.4.4",
       maximumReachesTopSpeed},
      {"maximum_as_typed", "P105, all sets", "max_frequency, where it is configured",
       "somebody is mistaken about the drive", "-", "BU 2700, 6.4.4", maximumIsAsTyped},
      {"minimum_zero", "P104, all sets", "0", "enabled, the motor turns at it with setpoint 0", "0",
       "no manual at hand describes it; [safety.md](safety.md)", minimumIsZero},
      {"bus_bits", "P480 [-01] to [-12]", "neither 1, enable right, nor 2, enable left",
       "a bus I/O bit starts the motor past ~enable; SK 1x0E and 2xxE come so from the factory", "0",
       "BU 0280, 5.1.2, p. 48; BU 0020, 6.2.1, p. 61", busBitsStartNothing},
      {"set_in_force", "the parameter set", "1", "the driver stays in the set it finds", "-", "BU 2700, 6.4.1",
       setInForceIsFirst},
      {"base_alike", "the set; P102, P103, P105, P426, P300 of it", "alike in all drives of a base of one series",
       "the path bends where they differ", "-", "BU 0020, 7.3.5, p. 77", drivesOfBaseAreAlike},
      {"writes_saved", "P560", "1", "with 0 whatever anybody changes is lost at power off", "1", "BU 0020, 7.5, p. 83",
       writesAreSaved},
      {"readable", "P509, P104, P105, P543, P546, P513; P151 and P120 where they count", "can be read",
       "what could not be read was not checked", "-", "-", decidingOnesAreReadable},
  };
  return kRules;
}

std::vector<std::string> rulesAsRows() {
  std::vector<std::string> rows;
  for (const Rule& rule : rules()) {
    rows.push_back(std::string("| `") + rule.name + "` | " + rule.parameters + " | " + rule.expected + " | " +
                   rule.why + " | " + rule.remedy + " | " + rule.source + " |");
  }
  return rows;
}

}  // namespace nord_driver::commissioning
