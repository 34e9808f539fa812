#include "profile/cycle_parameters.h"

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

// SK 2xxE, 53xE, 54xE, 700E and 750E (BU 2700 6.4.4, BU 0020 7.3.5).
constexpr std::uint8_t kPositioning = bit(Series::kSk2xxe) | kSk5 | kSk54 | kSk7;

// Of SK 700E and 750E no manual at hand names P607 and P608 (BU 2700 6.4.4).
constexpr std::uint8_t kRatioOfCount = bit(Series::kSk2xxe) | kSk5 | kSk54;

constexpr ParameterShape kPlain = ParameterShape::kPlain;
constexpr ParameterShape kPerSet = ParameterShape::kPerSet;
constexpr ParameterShape kArray = ParameterShape::kArray;
constexpr ParameterShape kArrayPerSet = ParameterShape::kArrayPerSet;

// Sources: those of the same entries in config/parameters.
constexpr CycleParameter kParameters[] = {
    // clang-format off
    // number, series, name, resolution, signed, shape, elements
    {102, kAll, "Acceleration time", 0.01, false, kPerSet, 1},
    {103, kAll, "Deceleration time", 0.01, false, kPerSet, 1},
    {104, kAll, "Minimum frequency", 0.1, false, kPerSet, 1},
    {105, kAll, "Maximum frequency", 0.1, false, kPerSet, 1},  // 100 % of frequencies, BU 2700 6.4.4
    {120, kSk12 | kSk54, "Option monitoring", 1.0, false, kArray, 4},
    {151, kCu4, "Timeout for external bus", 0.001, true, kPlain, 1},  // of the bus module in front of these series
    {480, kSk300 | kSk7, "Function of bus I/O in bits", 1.0, false, kArray, 8},
    {480, kSk5 | kSk54 | kSk12, "Function of bus I/O in bits", 1.0, false, kArray, 12},
    {481, kSk300 | kSk7, "Function of bus I/O out bits", 1.0, false, kArray, 8},
    {481, kSk5 | kSk54 | kSk12, "Function of bus I/O out bits", 1.0, false, kArray, 10},
    {507, kSk5 | kSk54 | kSk300 | kSk7, "PPO type", 1.0, false, kPlain, 1},
    {509, kSk5 | kSk54, "Source control word", 1.0, false, kPlain, 1},
    {509, kSk12, "Control word source", 1.0, false, kPlain, 1},
    {509, kSk300 | kSk7, "Interface", 1.0, false, kPlain, 1},
    {510, kSk5 | kSk54 | kSk12, "Setpoint source", 1.0, false, kArray, 2},
    {513, kAll, "Telegram timeout", 0.1, true, kPlain, 1},
    {543, kSk5, "Bus actual value 1", 1.0, false, kPerSet, 1},
    {543, kSk54, "Bus actual value", 1.0, false, kArrayPerSet, 5},
    {543, kSk12, "Actual bus value", 1.0, false, kArrayPerSet, 3},
    {543, kSk300 | kSk7, "Bus actual value 1", 1.0, false, kPerSet, 1},
    {544, kSk5 | kSk300 | kSk7, "Bus actual value 2", 1.0, false, kPerSet, 1},
    {545, kSk5 | kSk300 | kSk7, "Bus actual value 3", 1.0, false, kPerSet, 1},
    {546, kSk5, "Function of bus setpoint 1", 1.0, false, kPerSet, 1},
    {546, kSk54, "Function of bus setpoint", 1.0, false, kArrayPerSet, 5},
    {546, kSk12, "Function bus setpoint", 1.0, false, kArrayPerSet, 3},
    {546, kSk300 | kSk7, "Bus setpoint 1", 1.0, false, kPerSet, 1},
    {547, kSk5, "Function of bus setpoint 2", 1.0, false, kPerSet, 1},
    {547, kSk300 | kSk7, "Bus setpoint 2", 1.0, false, kPerSet, 1},
    {548, kSk5, "Function of bus setpoint 3", 1.0, false, kPerSet, 1},
    {548, kSk300 | kSk7, "Bus setpoint 3", 1.0, false, kPerSet, 1},
    {560, kAll, "Save in EEPROM", 1.0, false, kPlain, 1},
    {600, kPositioning, "Position control", 1.0, false, kPerSet, 1},
    {607, kRatioOfCount, "Speed ratio", 1.0, false, kPerSet, 1},
    {608, kRatioOfCount, "Reduction", 1.0, false, kPerSet, 1},
    {610, kPositioning, "Setpoint mode", 1.0, false, kPlain, 1},
    {707, kAll, "Software version", 1.0, false, kArray, 2},
    // clang-format on
};

}  // namespace

const CycleParameter* findCycleParameter(std::uint16_t number, Series series) noexcept {
  for (const CycleParameter& parameter : kParameters) {
    if (parameter.number == number && (parameter.series & bit(series)) != 0) return &parameter;
  }
  return nullptr;
}

double toValue(const CycleParameter& parameter, std::int32_t raw) noexcept {
  const auto low = static_cast<std::uint16_t>(static_cast<std::uint32_t>(raw) & 0xFFFFu);
  const double number = parameter.is_signed ? static_cast<std::int16_t>(low) : low;
  return number * parameter.resolution;
}

ParameterRequest readRequest(const CycleParameter& parameter, std::uint8_t set, std::uint8_t index) noexcept {
  ParameterRequest request;
  request.number = parameter.number;
  request.shape = parameter.shape;
  request.parameter_set = set;
  request.index = isArray(parameter.shape) ? index : std::uint8_t{1};
  return request;
}

}  // namespace nord_driver::profile
