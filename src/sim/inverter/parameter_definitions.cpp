#include "sim/inverter/parameter_definitions.h"

#include <algorithm>
#include <cmath>

#include "sim/inverter/position_words.h"

namespace nord_driver::sim {

namespace {

constexpr bool kPerSet = true;
constexpr bool kReadOnly = true;
constexpr std::int32_t kFarthest = 50'000'000;
constexpr double kFirmwareWithFaultArray = 1.9;  // BU 0020 8

// Ranges and factory settings where BU 0020 6.2, BU 0220 5.1 or BU 0280 5.1 print them. The chapters with P102-P113,
// P420, P426 and P506 are in the inverters' own manuals: their ranges here are the simulator's, only the resolution is
// NORD's.
const std::vector<ParameterDefinition>& sk5xxe() {
  static const std::vector<ParameterDefinition> kDefinitions{
      // number, name, divisor, min, max, factory, per set, elements, read only
      {102, "Acceleration time", 100, 0, 32000, 200, kPerSet, 0, false},
      {103, "Deceleration time", 100, 0, 32000, 200, kPerSet, 0, false},
      {104, "Minimum frequency", 10, 0, 4000, 0, kPerSet, 0, false},
      {105, "Maximum frequency", 10, 1, 4000, 500, kPerSet, 0, false},
      {112, "Torque current limit", 1, 25, 400, 100, kPerSet, 0, false},
      {113, "Jog frequency", 10, -4000, 4000, 0, kPerSet, 0, false},
      {120, "Option monitoring", 1, 0, 2, 1, false, 4, false},
      {420, "Digital input 1", 1, 0, 77, 0, false, 0, false},
      {421, "Digital input 2", 1, 0, 77, 0, false, 0, false},
      {422, "Digital input 3", 1, 0, 77, 0, false, 0, false},
      {423, "Digital input 4", 1, 0, 77, 0, false, 0, false},
      {424, "Digital input 5", 1, 0, 77, 0, false, 0, false},
      {425, "Digital input 6", 1, 0, 77, 0, false, 0, false},
      {426, "Quick stop time", 100, 0, 32000, 10, kPerSet, 0, false},
      {480, "Function of bus I/O in bits", 1, 0, 74, 0, false, 12, false},
      {481, "Function of bus I/O out bits", 1, 0, 39, 0, false, 10, false},
      {506, "Automatic acknowledgement", 1, 0, 7, 0, false, 0, false},
      {507, "PPO type", 1, 1, 4, 1, false, 0, false},
      {508, "Profibus address", 1, 1, 126, 1, false, 0, false},
      {509, "Control word source", 1, 0, 10, 0, false, 0, false},
      {510, "Setpoint source", 1, 0, 10, 0, false, 2, false},
      {513, "Telegram time-out", 10, -1, 1000, 0, false, 0, false},
      {514, "CAN baud rate", 1, 0, 7, 5, false, 0, false},
      {515, "CAN address", 1, 0, 255, 32, false, 3, false},
      {543, "Bus actual value 1", 1, 0, 24, 1, kPerSet, 0, false},
      {544, "Bus actual value 2", 1, 0, 24, 0, kPerSet, 0, false},
      {545, "Bus actual value 3", 1, 0, 24, 0, kPerSet, 0, false},
      {546, "Bus setpoint 1", 1, 0, 55, 1, kPerSet, 0, false},
      {547, "Bus setpoint 2", 1, 0, 55, 0, kPerSet, 0, false},
      {548, "Bus setpoint 3", 1, 0, 55, 0, kPerSet, 0, false},
      {551, "Drive profile", 1, 0, 1, 0, false, 0, false},
      {560, "Save in EEPROM", 1, 0, 1, 1, false, 0, false},
      // Of the position control; sources of the numbers: posicon_settings.h. 32 bits where the range is that of a
      // position (BU 0020 7.3.5), the number of elements of P613 is the simulator's: what six bits can choose.
      {600, "Position control", 1, 0, 2, 0, kPerSet, 0, false},
      {601, "Actual position", 1000, -kFarthest, kFarthest, 0, false, 0, kReadOnly, true},
      {602, "Actual setpoint position", 1000, -kFarthest, kFarthest, 0, false, 0, kReadOnly, true},
      {603, "Actual position difference", 1000, -kFarthest, kFarthest, 0, false, 0, kReadOnly, true},
      {607, "Speed ratio", 1, 1, 32000, 1, false, 0, false},
      {608, "Reduction", 1, 1, 32000, 1, false, 0, false},
      {610, "Setpoint mode", 1, 0, 1, 0, false, 0, false},
      {612, "Position window", 1000, 0, 32000, 0, false, 0, false},
      {613, "Position", 1000, -kFarthest, kFarthest, 0, false, 63, false, true},
      {615, "Maximum position", 1000, -kFarthest, kFarthest, 0, false, 0, false, true},
      {616, "Minimum position", 1000, -kFarthest, kFarthest, 0, false, 0, false, true},
      {630, "Position slip error", 1000, 0, 32000, 0, false, 0, false},
      {700, "Current fault", 10, 0, 9999, 0, false, 3, kReadOnly},
      {701, "Last faults", 10, 0, 9999, 0, false, 5, kReadOnly},
      {707, "Software version", 10, 0, 9999, 20, false, 2, kReadOnly},
      {740, "Process data bus in", 1, 0, 0xFFFF, 0, false, 13, kReadOnly},
      {741, "Process data bus out", 1, 0, 0xFFFF, 0, false, 13, kReadOnly},
      {742, "Database version", 1, 0, 9999, 1, false, 0, kReadOnly},
      {743, "Inverter power", 100, 0, 32000, 150, false, 0, kReadOnly},
      {744, "Configuration", 1, 0, 0xFFFF, 0, false, 0, kReadOnly},
      {745, "Module version", 10, 0, 9999, 10, false, 0, kReadOnly},
      {746, "Module status", 1, 0, 0xFFFF, 0x0600, false, 0, kReadOnly},
      {747, "Voltage range", 1, 0, 0xFFFF, 0x23, false, 0, kReadOnly},
      {748, "CANopen status", 1, 0, 0xFFFF, 0, false, 3, kReadOnly},
      {749, "DIP switches", 1, 0, 0x1FF, 0, false, 0, kReadOnly},
  };
  return kDefinitions;
}

class Definitions {
 public:
  explicit Definitions(std::vector<ParameterDefinition> start) : all_(std::move(start)) {}

  void removePosicon() {
    all_.erase(std::remove_if(all_.begin(), all_.end(),
                              [](const ParameterDefinition& d) { return d.number >= 600 && d.number <= 630; }),
               all_.end());
  }
  void remove(int number) {
    all_.erase(
        std::remove_if(all_.begin(), all_.end(), [&](const ParameterDefinition& d) { return d.number == number; }),
        all_.end());
  }
  void setRange(int number, std::int32_t minimum, std::int32_t maximum) {
    find(number).minimum = minimum;
    find(number).maximum = maximum;
  }
  void setElements(int number, std::uint8_t elements) { find(number).elements = elements; }
  void setFirstElements(int number, const std::array<std::int32_t, 4>& values, std::uint8_t count) {
    find(number).first_elements = values;
    find(number).differing = count;
  }
  ParameterDefinition& find(int number) {
    return *std::find_if(all_.begin(), all_.end(), [&](const ParameterDefinition& d) { return d.number == number; });
  }
  std::vector<ParameterDefinition> take() { return std::move(all_); }

 private:
  std::vector<ParameterDefinition> all_;
};

// SK 540E and above: setpoints and actual values are arrays of five (BU 0020 6.2.2, 6.2.3).
void makeSk54xe(Definitions& definitions) {
  for (const int number : {544, 545, 547, 548}) definitions.remove(number);
  for (const int number : {543, 546}) {
    definitions.setRange(number, 0, 57);
    definitions.setElements(number, 5);
  }
  definitions.setElements(740, 23);
  definitions.setElements(741, 23);
}

// SK 300E, 700E, 750E: BU 0020 6.1. P546 is a table of its own there, and P509 has PROFIBUS under 8, 9 and 10.
void makeOlderSeries(Definitions& definitions, Series series) {
  const bool sk300e = series == Series::kSk300e;
  definitions.setRange(509, 0, 21);
  definitions.setRange(513, -1, 10'000);
  for (const int number : {543, 544, 545}) definitions.setRange(number, 0, 12);
  definitions.setRange(480, 0, 62);
  definitions.setElements(480, 8);
  definitions.setRange(546, 0, 7);
  definitions.setRange(547, 0, 20);
  definitions.setRange(548, 0, 20);
  definitions.setRange(481, 0, 38);
  definitions.setElements(481, 8);
  for (const int number : {120, 514, 515, 748, 749}) definitions.remove(number);
  if (sk300e) definitions.remove(510);
  definitions.setElements(740, sk300e ? 5 : 6);
  definitions.setElements(741, sk300e ? 5 : 6);
  if (sk300e) return;
  definitions.setRange(510, 0, 8);
  definitions.setElements(745, 3);
  definitions.setElements(746, 3);
}

// SK 1x0E and 2xxE: inputs, setpoints and actual values are arrays, address and PPO type are the module's
// (BU 0220 5.1).
void makeDecentral(Definitions& definitions) {
  for (const int number : {421, 422, 423, 424, 425, 507, 508, 544, 545, 547, 548, 744, 745, 746}) {
    definitions.remove(number);
  }
  definitions.setElements(420, 4);
  definitions.setRange(480, 0, 72);
  definitions.setFirstElements(480, {1, 2, 5, 12}, 4);  // enable right and left ... (BU 0280 5.1.2)
  definitions.setRange(509, 0, 4);
  definitions.setRange(510, 0, 4);
  definitions.setElements(543, 3);
  definitions.setRange(546, 0, 32);
  definitions.setElements(546, 3);
  definitions.setElements(741, 10);
  definitions.setElements(748, 0);
}

}  // namespace

std::vector<ParameterDefinition> parameterDefinitions(const Device& device) {
  Definitions definitions{sk5xxe()};
  if (device.series == Series::kSk54xe) makeSk54xe(definitions);
  if (device.isOlderSeries()) makeOlderSeries(definitions, device.series);
  if (device.isDecentral()) makeDecentral(definitions);
  if (!hasPosicon(device.series)) definitions.removePosicon();
  if (device.firmware < kFirmwareWithFaultArray) definitions.setElements(700, 0);
  definitions.find(707).factory = static_cast<std::int32_t>(std::lround(device.firmware * 10.0));
  return definitions.take();
}

}  // namespace nord_driver::sim
