#include "profile/parameter_catalogue.h"

#include <cmath>

#include "profile/parameter_shape.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint8_t bit(Series series) noexcept {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(series));
}

constexpr std::uint8_t kAll = 0x7F;
constexpr std::uint8_t kSk5 = bit(Series::kSk5xxe);
constexpr std::uint8_t kSk54 = bit(Series::kSk54xe);
constexpr std::uint8_t kSk300 = bit(Series::kSk300e);
constexpr std::uint8_t kSk7 = bit(Series::kSk700e) | bit(Series::kSk750e);
constexpr std::uint8_t kSk12 =
    bit(Series::kSk1x0e) | bit(Series::kSk2xxe);  // decentralised: one bus module, one manual

constexpr std::uint8_t kCu4 = kSk12 | kSk5 | kSk54;  // these sit behind SK CU4/TU4-PBR (BU 2700 3.1)

constexpr std::int32_t kMaxUnsigned = 65535;
constexpr ParameterShape kPlain = ParameterShape::kPlain;
constexpr ParameterShape kPerSet = ParameterShape::kPerSet;
constexpr ParameterShape kArray = ParameterShape::kArray;
constexpr ParameterShape kArrayPerSet = ParameterShape::kArrayPerSet;

// Sources: BU 0020 6.1, 6.2 (SK 300E/7x0E, SK 5xxE), BU 0220 5.1 and BU 0280 5.1 (SK 2xxE), BU 2700 6.6.3 (P102). P511,
// P512, P514 on SK 5xxE and P702..P706 are described in none of them.
constexpr ParameterInfo kCatalogue[] = {
    // clang-format off
    // number, series, name, unit, resolution, signed, shape, elements, minimum, maximum
    {102, kAll, "Acceleration time", "s", 0.01, false, kPerSet, 1, 0, kMaxUnsigned},  // 1000 = 10.00 s; the examples' "2 s" errs
    {103, kAll, "Deceleration time", "", 1.0, false, kPerSet, 1, 0, kMaxUnsigned},
    {104, kAll, "Minimum frequency", "Hz", 0.1, false, kPerSet, 1, 0, kMaxUnsigned},
    {105, kAll, "Maximum frequency", "Hz", 0.1, false, kPerSet, 1, 0, kMaxUnsigned},  // 100 % of frequencies, BU 2700 6.4.4
    // Set-dependent or not is not said; an order with a set falls back by itself when it is not.
    {112, kAll, "Torque current limit", "", 1.0, false, kPerSet, 1, 0, kMaxUnsigned},
    {120, kSk12 | kSk54, "Option monitoring", "", 1.0, false, kArray, 4, 0, 2},
    // Of the bus module SK CU4/TU4, which stands in front of these series (BU 2700 7.1, BU 0220 5.2); P151 = -1: it heeds
    // nothing. P152, factory setting, is not here: nothing that goes through the catalogue may reset a module.
    {150, kCu4, "Set relay", "", 1.0, false, kPlain, 1, 0, 4},
    {151, kCu4, "Timeout for external bus", "s", 0.001, true, kPlain, 1, -1, 32767},
    {153, kCu4, "Min. system bus cycle", "s", 0.001, false, kArray, 2, 0, 250},
    {154, kCu4, "TB-IO access", "", 1.0, false, kArray, 2, 0, 5},
    {160, kCu4, "Profibus address", "", 1.0, false, kPlain, 1, 3, 125},
    {170, kCu4, "Actual error of the bus module", "", 1.0, false, kArray, 2, 0, 9999},
    {171, kCu4, "Software version of the bus module", "", 1.0, false, kArray, 3, 0, kMaxUnsigned},
    {172, kCu4, "Configuration level", "", 1.0, false, kPlain, 1, 0, 2},
    {173, kCu4, "Module status", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {174, kCu4, "Digital input status", "", 1.0, false, kPlain, 1, 0, 255},
    {175, kCu4, "Relay status", "", 1.0, false, kPlain, 1, 0, 3},
    {176, kCu4, "Process data Bus In", "", 1.0, true, kArray, 17, -32768, 32767},
    {177, kCu4, "Process data Bus Out", "", 1.0, true, kArray, 17, -32768, 32767},
    {180, kCu4, "Actual Profibus address", "", 1.0, false, kPlain, 1, 0, 126},
    {181, kCu4, "Profibus baud rate", "", 1.0, false, kPlain, 1, 0, 15},
    {182, kCu4, "PPO type of the slots", "", 1.0, false, kArray, 5, 0, 255},
    {426, kAll, "Quick stop time", "", 1.0, false, kPerSet, 1, 0, kMaxUnsigned},
    // What bus I/O bits do, as digital inputs would: BU 0020 6.1.1, 6.2.1, BU 0280 5.1.2.
    {480, kSk300 | kSk7, "Function of bus I/O in bits", "", 1.0, false, kArray, 8, 0, 62},
    {480, kSk5 | kSk54, "Function of bus I/O in bits", "", 1.0, false, kArray, 12, 0, 74},
    {480, kSk12, "Function of bus I/O in bits", "", 1.0, false, kArray, 12, 0, 72},
    {506, kAll, "Automatic fault acknowledgement", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {507, kSk5 | kSk54 | kSk300 | kSk7, "PPO type", "", 1.0, false, kPlain, 1, 1, 4},
    {508, kSk5 | kSk54 | kSk300 | kSk7, "PROFIBUS address", "", 1.0, false, kPlain, 1, 1, 126},
    {509, kSk5 | kSk54, "Source control word", "", 1.0, false, kPlain, 1, 0, 10},
    {509, kSk300 | kSk7, "Interface", "", 1.0, false, kPlain, 1, 0, 21},
    {509, kSk12, "Source control word", "", 1.0, false, kPlain, 1, 0, 4},
    {510, kSk5 | kSk54 | kSk12, "Source setpoints", "", 1.0, false, kArray, 2, 0, kMaxUnsigned},
    {510, kSk7, "Bus interface auxiliary setpoint", "", 1.0, false, kArray, 2, 0, 8},
    {513, kSk5 | kSk54 | kSk12, "Telegram timeout", "s", 0.1, true, kPlain, 1, -1, 1000},  // -0.1: never, BU 0020 6.1.2
    {513, kSk300 | kSk7, "Telegram timeout", "s", 0.1, true, kPlain, 1, -1, 10000},
    {514, kSk12, "CAN baud rate", "", 1.0, false, kPlain, 1, 0, 7},
    {515, kSk12, "CAN address", "", 1.0, false, kArray, 3, 0, 255},
    {543, kSk5, "Bus actual value 1", "", 1.0, false, kPerSet, 1, 0, 24},
    {543, kSk54, "Bus actual value", "", 1.0, false, kArrayPerSet, 5, 0, 57},
    {543, kSk12, "Bus actual value", "", 1.0, false, kArrayPerSet, 3, 0, 22},
    {543, kSk300 | kSk7, "Bus actual value 1", "", 1.0, false, kPerSet, 1, 0, 12},
    {544, kSk5, "Bus actual value 2", "", 1.0, false, kPerSet, 1, 0, 24},
    {544, kSk300 | kSk7, "Bus actual value 2", "", 1.0, false, kPerSet, 1, 0, 12},
    {545, kSk5, "Bus actual value 3", "", 1.0, false, kPerSet, 1, 0, 24},
    {545, kSk300 | kSk7, "Bus actual value 3", "", 1.0, false, kPerSet, 1, 0, 12},
    {546, kSk5, "Function of bus setpoint 1", "", 1.0, false, kPerSet, 1, 0, 55},
    {546, kSk54, "Function of bus setpoint", "", 1.0, false, kArrayPerSet, 5, 0, 57},
    {546, kSk12, "Function of bus setpoint", "", 1.0, false, kArrayPerSet, 3, 0, 32},
    {546, kSk300 | kSk7, "Bus setpoint 1", "", 1.0, false, kPerSet, 1, 0, 7},  // a table of its own
    {547, kSk5, "Function of bus setpoint 2", "", 1.0, false, kPerSet, 1, 0, 55},
    {547, kSk300 | kSk7, "Bus setpoint 2", "", 1.0, false, kPerSet, 1, 0, 20},
    {548, kSk5, "Function of bus setpoint 3", "", 1.0, false, kPerSet, 1, 0, 55},
    {548, kSk300 | kSk7, "Bus setpoint 3", "", 1.0, false, kPerSet, 1, 0, 20},
    {560, kAll, "Save in EEPROM", "", 1.0, false, kPlain, 1, 0, 1},
    // An array from firmware V1.9 on (BU 0020 8): [-01] fault, [-02] warning, [-03] reason of switch-on disabled.
    {700, kAll, "Current fault", "", 0.1, false, kArray, 3, 0, kMaxUnsigned},
    {701, kAll, "Last faults", "", 0.1, false, kArray, 5, 0, kMaxUnsigned},
    {707, kAll, "Software version", "", 1.0, false, kArray, 2, 0, kMaxUnsigned},
    {740, kSk5 | kSk12, "Process data bus in", "", 1.0, false, kArray, 13, 0, kMaxUnsigned},
    {740, kSk54, "Process data bus in", "", 1.0, false, kArray, 23, 0, kMaxUnsigned},
    {740, kSk300, "Process data bus in", "", 1.0, false, kArray, 5, 0, kMaxUnsigned},
    {740, kSk7, "Process data bus in", "", 1.0, false, kArray, 6, 0, kMaxUnsigned},
    {741, kSk5, "Process data bus out", "", 1.0, false, kArray, 13, 0, kMaxUnsigned},
    {741, kSk12, "Process data bus out", "", 1.0, false, kArray, 10, 0, kMaxUnsigned},
    {741, kSk54, "Process data bus out", "", 1.0, false, kArray, 23, 0, kMaxUnsigned},
    {741, kSk300, "Process data bus out", "", 1.0, false, kArray, 5, 0, kMaxUnsigned},
    {741, kSk7, "Process data bus out", "", 1.0, false, kArray, 6, 0, kMaxUnsigned},
    {742, kAll, "Database version", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {743, kAll, "Inverter power", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {744, kAll, "Configuration", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {745, kSk5 | kSk54 | kSk300, "Module version", "", 0.1, false, kPlain, 1, 0, kMaxUnsigned},
    {745, kSk7, "Module version", "", 1.0, false, kArray, 3, 0, kMaxUnsigned},  // printed in hex
    {746, kSk5 | kSk54 | kSk300, "Module status", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {746, kSk7, "Module status", "", 1.0, false, kArray, 3, 0, kMaxUnsigned},
    {747, kAll, "Voltage range", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {748, kSk12, "System bus status", "", 1.0, false, kPlain, 1, 0, kMaxUnsigned},
    {748, kSk5 | kSk54, "CANopen status", "", 1.0, false, kArray, 3, 0, kMaxUnsigned},
    {749, kSk12, "DIP switches", "", 1.0, false, kPlain, 1, 0, 0x1FF},
    // clang-format on
};

}  // namespace

const ParameterInfo* findParameter(std::uint16_t number, Series series) noexcept {
  for (const ParameterInfo& info : kCatalogue) {
    if (info.number == number && (info.series & bit(series)) != 0) return &info;
  }
  return nullptr;
}

double toValue(const ParameterInfo& info, std::int32_t raw) noexcept {
  const auto low = static_cast<std::uint16_t>(static_cast<std::uint32_t>(raw) & 0xFFFFu);
  const double number = info.is_signed ? static_cast<std::int16_t>(low) : low;
  return number * info.resolution;
}

std::optional<std::int32_t> toRaw(const ParameterInfo& info, double value) noexcept {
  const double raw = std::round(value / info.resolution);
  if (!std::isfinite(raw) || raw < info.minimum || raw > info.maximum) return std::nullopt;
  return static_cast<std::int32_t>(raw);
}

ParameterRequest readRequest(const ParameterInfo& info, std::uint8_t set, std::uint8_t index) noexcept {
  ParameterRequest request;
  request.number = info.number;
  request.shape = info.shape;
  request.parameter_set = set;
  request.index = isArray(info.shape) ? index : std::uint8_t{1};
  return request;
}

}  // namespace nord_driver::profile
