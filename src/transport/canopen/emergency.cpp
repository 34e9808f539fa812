#include "transport/canopen/emergency.h"

#include <algorithm>

namespace nord_driver::profile {

namespace {

// Codes and numbers: BU 0060 p. 93 (CANopen), completed where its list breaks off by BU 0570 p. 37 (the EtherCAT
// option, which reports the same faults; it gives 3.2 and 3.3 as 2311h and 2312h). Codes without numbers: object 603Fh
// of BU 0070 6.4.2.
constexpr EmergencyInfo kRows[] = {
    // clang-format off
    {0x0000, "", "no error: the faults before it are acknowledged"},
    {0x1000, "", "a fault without a code of its own"},
    {0x2200, "E4.0, E4.1", "overcurrent in the inverter"},
    {0x2211, "E3.2", "overcurrent of the IGBT (125 %)"},
    {0x2212, "E3.3", "overcurrent of the IGBT, fast (150 %)"},
    {0x2310, "E3.0", "overcurrent at the output (I2t limit)"},
    {0x2311, "E3.2", "overcurrent of the IGBT (125 %)"},
    {0x2312, "E3.3", "overcurrent of the IGBT, fast (150 %)"},
    {0x3110, "E5.1", "mains overvoltage"},
    {0x3120, "E6.1", "mains undervoltage"},
    {0x3130, "E7.0", "mains phase error"},
    {0x3210, "E5.0", "overvoltage of the DC link"},
    {0x3230, "E6.0", "charging error"},
    {0x4210, "E1.0, E1.1", "inverter overtemperature"},
    {0x4310, "E2.0, E2.1, E2.2", "motor overtemperature"},
    {0x5000, "E10.8", "communication between bus module and inverter"},
    {0x5110, "E11.0", "customer unit or terminals, their supply"},
    {0x5300, "E17.0", "customer unit or changed assembly"},
    {0x5510, "E20.0", "RAM"},
    {0x5520, "E20.8", "program memory"},
    {0x5530, "E8.1, E8.2", "EEPROM"},
    {0x6000, "E20.1 .. E20.7, E21.3", "the inverter's firmware"},
    {0x6310, "E8.0", "parameter loss"},
    {0x7112, "E3.1", "chopper overcurrent"},
    {0x7120, "E16.0, E16.1", "motor phase"},
    {0x7300, "", "a sensor"},
    {0x7305, "E13.0", "encoder"},
    {0x7306, "", "second encoder"},
    {0x7310, "", "speed sensor"},
    {0x7320, "", "position sensor"},
    {0x8100, "E10.0 .. E10.7", "bus time-out or bus module"},
    {0x8300, "", "torque controller"},
    {0x8400, "", "speed controller"},
    {0x8612, "", "reference limit"},
    {0x9000, "", "an external fault"},
    // clang-format on
};

struct ClassRow {
  std::uint16_t mask;
  std::uint16_t value;
  const char* text;
};

// CiA 301 table 26, "emergency error code classes"; the narrower class first.
constexpr ClassRow kClasses[] = {
    {0xFF00, 0x8100, "communication"},
    {0xFF00, 0x8200, "protocol error: a PDO of the wrong length, for example"},
    {0xFF00, 0xF000, "an additional function"},
    {0xFF00, 0xFF00, "an error only its device knows"},
    {0xF000, 0x1000, "a fault without a code of its own"},
    {0xF000, 0x2000, "current"},
    {0xF000, 0x3000, "voltage"},
    {0xF000, 0x4000, "temperature"},
    {0xF000, 0x5000, "hardware of the device"},
    {0xF000, 0x6000, "software of the device"},
    {0xF000, 0x7000, "an additional module"},
    {0xF000, 0x8000, "monitoring"},
    {0xF000, 0x9000, "an external fault"},
};

}  // namespace

EmergencyTable emergencyTable() noexcept {
  return {kRows, sizeof(kRows) / sizeof(kRows[0])};
}

const EmergencyInfo* findEmergency(std::uint16_t code) noexcept {
  const EmergencyTable table = emergencyTable();
  const auto* row =
      std::lower_bound(table.begin(), table.end(), code,
                       [](const EmergencyInfo& info, std::uint16_t wanted) { return info.code < wanted; });
  return row != table.end() && row->code == code ? row : nullptr;
}

const char* emergencyText(std::uint16_t code) noexcept {
  if (const EmergencyInfo* row = findEmergency(code)) return row->text;
  for (const ClassRow& row : kClasses) {
    if ((code & row.mask) == row.value) return row.text;
  }
  return "a code neither CiA 301 nor a manual lists";
}

const char* emergencyFaults(std::uint16_t code) noexcept {
  const EmergencyInfo* row = findEmergency(code);
  return row == nullptr ? "" : row->faults;
}

}  // namespace nord_driver::profile
