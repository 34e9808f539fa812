#include "profile/fault_table.h"

#include <algorithm>

namespace nord_driver::profile {

namespace {

// Causes and remedies of groups of which only the names are known.
constexpr char kCheckManual[] = "see this number in the list of error messages in the inverter's manual";
constexpr char kVaries[] = "the meaning of this number differs between series and firmware: see the inverter's manual";
constexpr char kHot[] = "the inverter is too hot";
constexpr char kCool[] = "let it cool down; check cooling, surroundings and load";
constexpr char kMotorHot[] = "the motor is, or is calculated to be, too hot";
constexpr char kMotorCool[] = "let it cool down; check the load, the motor data and the sensor's wiring";
constexpr char kCurrent[] = "the current was beyond a limit";
constexpr char kCheckLoad[] = "check the load, the ramps, the motor and its cable";
constexpr char kHighVoltage[] = "the voltage was too high";
constexpr char kLowVoltage[] = "the mains voltage is too low, or was switched too often";
constexpr char kCheckMains[] = "check the mains voltage and its connections; with high voltage also the brake ramp";
constexpr char kPhase[] = "a phase is missing or uneven";
constexpr char kCheckPhases[] = "check the mains, its fuses and connections";
constexpr char kMemory[] = "the parameters in the inverter's memory cannot be used or kept";
constexpr char kCheckMemory[] =
    "compare the parameters with your own record; if the fault returns, see the inverter's manual";
constexpr char kInternal[] = "a communication inside the inverter or with its options has failed";
constexpr char kBusModule[] = "a fault inside the bus module; series with a technology unit report it";
constexpr char kCheckModule[] =
    "read the module's state in P746; check its supply and how it is plugged in; other series use this number "
    "otherwise: see the inverter's manual";
constexpr char kMonitoring[] = "a value the inverter watches was beyond its limit";
constexpr char kCheckLimits[] =
    "check the load and the limits that are set; the meaning of this number differs between series: see the inverter's "
    "manual";
constexpr char kSpeed[] = "the speed that was measured does not fit the one that was wanted";
constexpr char kCheckEncoder[] = "check the encoder, its wiring and parameters, and the load";
constexpr char kMotorPhase[] = "the current in a motor phase is not as expected";
constexpr char kCheckMotor[] = "check the motor, its cable, a mechanical brake, and the motor data";
constexpr char kSafety[] = "a safety function has responded or is faulty";
constexpr char kCheckSafety[] =
    "find out what triggered it before anything is acknowledged; the meaning of this number differs between series: "
    "see the inverter's manual";
constexpr char kIdent[] = "the motor could not be identified";
constexpr char kSystem[] = "the inverter itself is faulty, or its firmware is";
constexpr char kSwitchOffOn[] = "switch it off and on again; if the fault returns, ask the manufacturer";
constexpr char kCheckLine[] = "check the bus cables, the bus protocol program and the bus master";
constexpr char kSystemBus[] = "check the system bus: its connections and its 24 V supply";

// The printed number times ten. 10 .. 990: the inverter's own, in P700 and P701; a number some series lack is listed
// all the same. From 1000 on: those of the bus module, in its P170 (BU 2700 8.3, BU 0220 6.2.2, BU 0280 6.2.2).
constexpr FaultInfo kFaults[] = {
    // clang-format off
    {10, "inverter overtemperature", kHot, kCool},
    {11, "internal overtemperature of the inverter", kHot, kCool},
    {20, "motor overtemperature (PTC)", kMotorHot, kMotorCool},
    {21, "motor overtemperature (I2t)", kMotorHot, kMotorCool},
    {22, "overtemperature by digital input", "the sensor at a digital input reports overtemperature", kMotorCool},
    {30, "overcurrent (I2t limit)", kCurrent, kCheckLoad},
    {31, "chopper overcurrent", kCurrent, "check the brake resistor, the brake ramp and the load"},
    {32, "IGBT overcurrent (125 %)", kCurrent, kCheckLoad},
    {33, "IGBT overcurrent, fast (150 %)", kCurrent, kCheckLoad},
    {34, "chopper limit", kCurrent, kVaries},
    {37, "input power limit", kCurrent, kVaries},
    {40, "module overcurrent", kCurrent, kCheckLoad},
    {41, "measured overcurrent", kCurrent, kCheckLoad},
    {50, "overvoltage of the DC link", kHighVoltage, kCheckMains},
    {51, "mains overvoltage", kHighVoltage, kCheckMains},
    {60, "charging error", kLowVoltage, kCheckMains},
    {61, "mains undervoltage", kLowVoltage, kCheckMains},
    {70, "mains phase error", kPhase, kCheckPhases},
    {71, "DC link phase error", kPhase, kCheckPhases},
    {80, "parameter loss", kMemory, kCheckMemory},
    {81, "wrong inverter identification", kMemory, kCheckMemory},
    {82, "memory error (8.2)", kMemory, kVaries},
    {84, "EEPROM error (8.4)", kMemory, kCheckMemory},
    {87, "EEPROM error (8.7)", kMemory, kCheckMemory},
    {90, "communication error 9.0", kInternal, kVaries},
    {91, "communication error 9.1", kInternal, kVaries},
    {92, "communication error 9.2", kInternal, kVaries},
    {93, "communication error 9.3", kInternal, kVaries},
    {94, "communication error 9.4", kInternal, kVaries},
    {95, "communication error 9.5", kInternal, kVaries},
    {96, "communication error 9.6", kInternal, kVaries},
    {97, "communication error 9.7", kInternal, kVaries},
    {98, "communication error 9.8", kInternal, kVaries},
    {99, "communication error 9.9", kInternal, kVaries},

    // The bus: BU 0020 8.1, BU 0220 6.2.1, BU 2700 8.3.
    {100, "bus timeout", "no telegram within P513, the contact to the bus module was lost, or the internal CAN bus failed (node guarding, bus off)",
     "check P513, the bus cables, the 24 V supply of the system bus, the bus protocol program and the bus master"},
    {101, "system error of the bus module (10.1)", kBusModule, kCheckModule},
    {102, "PROFIBUS telegram failure", "the PROFIBUS watchdog in the bus module ran out: the bus master was stopped or died, or the bus was interrupted",
     "check the bus cables, the bus protocol program and the bus master (is the PLC in STOP or ERROR?)"},
    {103, "timeout by P151 or P513", "no valid control word within P151 or P513: telegrams failed, or bit 10 of the control word stayed 0; behind technology units also a system error of the module",
     "check the time in P151 or P513, the bus cables, and that the master sends control words with bit 10 = 1"},
    {104, "initialisation error of the bus module", "the bus module cannot be reached, or its PROFIBUS chip does not answer",
     "check P746, the module's supply, how it is plugged in, and its connections"},
    {105, "system error of the bus module (10.5)", kBusModule, kCheckModule},
    {106, "system error of the bus module (10.6)", "behind technology units a fault inside the bus module; in other series the Ethernet cable", kCheckModule},
    {107, "system error of the bus module (10.7)", kBusModule, kCheckModule},
    {108, "communication error of the bus module", "the connection between bus module and inverter was interrupted, or the module is faulty",
     "check the connection between bus module and inverter, and the system bus with its 24 V supply"},
    {109, "bus module missing", "a module that P120 demands does not answer on the system bus", "check the connection to the module, its supply, and P120"},

    {110, "error of the customer unit or the terminals (analogue to digital converter)", "the inverter cannot read its terminals", kCheckManual},
    {120, "watchdog", kMonitoring, kCheckLimits},
    {121, "motor limit", kMonitoring, kCheckLimits},
    {122, "generator limit", kMonitoring, kCheckLimits},
    {123, "torque limit", kMonitoring, kCheckLimits},
    {124, "current limit", kMonitoring, kCheckLimits},
    {125, "load monitor", kMonitoring, kCheckLimits},
    {128, "analogue input below its minimum", kMonitoring, kCheckLimits},
    {129, "analogue input above its maximum", kMonitoring, kCheckLimits},
    {130, "encoder error", kSpeed, kCheckEncoder},
    {131, "slip error", kSpeed, kCheckEncoder},
    {132, "disconnection control", kSpeed, kCheckEncoder},
    {133, "slip error (13.3)", kSpeed, kCheckEncoder},
    {138, "limit switch (13.8)", "a limit switch has responded", kVaries},
    {139, "limit switch (13.9)", "a limit switch has responded", kVaries},
    {160, "motor phase error", kMotorPhase, kCheckMotor},
    {161, "magnetising current", kMotorPhase, kCheckMotor},
    {162, "motor phase error (16.2)", kMotorPhase, kVaries},
    {170, "changed assembly", "a module or option was exchanged or is not the expected one", kVaries},
    {180, "safety function (18.0)", kSafety, kCheckSafety},
    {185, "safety function (18.5)", kSafety, kCheckSafety},
    {186, "safety function (18.6)", kSafety, kCheckSafety},
    {190, "motor identification error", kIdent, kVaries},
    {191, "motor identification error (19.1)", kIdent, kVaries},
    {192, "rotor position error", kIdent, kVaries},
    {200, "system error 20.0 (older series)", kSystem, kSwitchOffOn},
    {201, "system error 20.1 (older series)", kSystem, kSwitchOffOn},
    {202, "system error 20.2 (older series)", kSystem, kSwitchOffOn},
    {203, "system error 20.3 (older series)", kSystem, kSwitchOffOn},
    {204, "system error 20.4 (older series)", kSystem, kSwitchOffOn},
    {205, "system error 20.5 (older series)", kSystem, kSwitchOffOn},
    {206, "system error 20.6 (older series)", kSystem, kSwitchOffOn},
    {207, "system error 20.7 (older series)", kSystem, kSwitchOffOn},
    {208, "system error 20.8 (older series)", kSystem, kSwitchOffOn},
    {213, "system error 21.3 (older series)", kSystem, kSwitchOffOn},
    {214, "system error 21.4 (older series)", kSystem, kSwitchOffOn},
    {900, "system error 90.0", kSystem, kSwitchOffOn},
    {910, "error of a firmware update (91.0)", "a firmware update failed or is not complete", kVaries},
    {911, "error of a firmware update (91.1)", "a firmware update failed or is not complete", kVaries},
    {912, "error of a firmware update (91.2)", "a firmware update failed or is not complete", kVaries},
    {913, "error of a firmware update (91.3)", "a firmware update failed or is not complete", kVaries},
    {990, "system error 99.0", kSystem, kSwitchOffOn},

    // The bus module's own.
    {1000, "EEPROM error of the bus module", "electromagnetic disturbance, or the bus module is defective", "if it returns, exchange the bus module"},
    {1010, "system bus without 24 V", "no 24 V on the system bus, or wrong connections", kSystemBus},
    {1020, "system bus timeout", "no valid data within P151, the bus was interrupted, or the inverter was switched off", "check P151, the bus cables and whether the inverter is on"},
    {1030, "system bus off", "no 24 V on the system bus, or wrong connections", kSystemBus},
    {5000, "PROFIBUS chip error", "the bus module cannot reach its PROFIBUS chip", "switch the bus module off and on again; if it returns, exchange it"},
    {5010, "wrong PROFIBUS address", "the address that is set is outside 3 .. 125", "set an address of 3 .. 125"},
    {5020, "PROFIBUS timeout", "PROFIBUS telegrams failed", kCheckLine},
    {5210, "DeviceNet bus off", "the DeviceNet bus failed", kCheckLine},
    {5211, "DeviceNet address already allocated", "two participants have the same address", "use each address once, 1 .. 63, as the master has it"},
    {5212, "illegal DeviceNet baud rate", "the DIP switches are set to a baud rate that does not exist", "set the DIP switches of the bus module"},
    {5220, "DeviceNet timeout", "DeviceNet telegrams failed", kCheckLine},
    // clang-format on
};

}  // namespace

FaultTable faultTable() noexcept {
  return {kFaults, sizeof(kFaults) / sizeof(kFaults[0])};
}

const FaultInfo* findFault(std::uint16_t raw) noexcept {
  const FaultTable table = faultTable();
  const FaultInfo* row = std::lower_bound(
      table.begin(), table.end(), raw, [](const FaultInfo& info, std::uint16_t number) { return info.raw < number; });
  return row != table.end() && row->raw == raw ? row : nullptr;
}

}  // namespace nord_driver::profile
