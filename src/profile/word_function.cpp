#include "profile/word_function.h"

#include "profile/cycle_parameters.h"
#include "profile/parameter_shape.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint8_t bit(Series series) noexcept {
  return static_cast<std::uint8_t>(1u << static_cast<unsigned>(series));
}

constexpr std::uint8_t kSk12 = bit(Series::kSk1x0e) | bit(Series::kSk2xxe);
constexpr std::uint8_t kSk300 = bit(Series::kSk300e);
constexpr std::uint8_t kSk7 = bit(Series::kSk700e) | bit(Series::kSk750e);
constexpr std::uint8_t kOld = kSk300 | kSk7;
constexpr std::uint8_t kSk54 = bit(Series::kSk54xe);
constexpr std::uint8_t kSk5 = bit(Series::kSk5xxe) | kSk54;

using U = WordUse;
using N = Nominal;

// P546 of SK 300E, 700E and 750E (BU 0020 6.1.2, BU 0070 5.1).
constexpr WordFunction kFirstSetpoint[] = {
    {0, kOld, "Off", U::kOff, N::kNone},
    {1, kOld, "Setpoint frequency (16 bit)", U::kFrequency, N::kMaximumFrequency},
    {2, kSk7, "16 bit setpoint position", U::kPosition16, N::kThousandthTurn},
    {3, kSk7, "32 bit setpoint position", U::kPosition32, N::kThousandthTurn},
    {4, kSk7, "POSICON control terminals", U::kPosiconBits, N::kBits},
    {5, kSk7, "Setpoint position (16 bit) increment", U::kIncrement16, N::kRaw},
    {6, kSk7, "Setpoint position (32 bit) increment", U::kIncrement32, N::kRaw},
    {7, kOld, "Bus I/O in bits 0-7", U::kBusBits, N::kBits},
};

// P547 and P548 of all; P546 of SK 1x0E, 2xxE (BU 0220 5.1.3, BU 0280 5.1.3, BU 2700 5.3) and 5xxE (BU 0020 6.2.2).
constexpr WordFunction kSetpoints[] = {
    {0, kSk12 | kSk5 | kOld, "Off", U::kOff, N::kNone},
    {1, kSk12, "Setpoint frequency (16 bit)", U::kFrequency, N::kMaximumFrequency},
    {1, kSk5 | kOld, "Setpoint frequency", U::kFrequency, N::kMaximumFrequency},
    {2, kSk12, "Frequency addition", U::kFrequencyAddition, N::kOwnFrequency},
    {2, kSk5 | kOld, "Torque current limit", U::kTorqueLimit, N::kTorqueLimit},
    {3, kSk12, "Frequency subtraction", U::kFrequencySubtraction, N::kOwnFrequency},
    {3, kSk5 | kOld, "Actual frequency PID", U::kOther, N::kMaximumFrequency},
    {4, kSk12, "Minimum frequency", U::kMinimumFrequency, N::kOwnFrequency},
    {4, kSk5 | kOld, "Frequency addition", U::kFrequencyAddition, N::kMaximumFrequency},
    {5, kSk12, "Maximum frequency", U::kMaximumFrequency, N::kOwnFrequency},
    {5, kSk5 | kOld, "Frequency subtraction", U::kFrequencySubtraction, N::kMaximumFrequency},
    {6, kSk12, "PI process controller actual value", U::kOther, N::kNone},
    {6, kSk5 | kSk7, "Current limit", U::kCurrentLimit, N::kRatedCurrent},
    {7, kSk12, "PI process controller setpoint", U::kOther, N::kNone},
    {7, kSk5 | kSk7, "Maximum frequency", U::kMaximumFrequency, N::kMaximumFrequency},
    {8, kSk12, "Actual frequency PI", U::kOther, N::kMaximumFrequency},
    {8, kSk5 | kOld, "Actual PID frequency limited", U::kOther, N::kMaximumFrequency},
    {9, kSk12, "Actual frequency PI limited", U::kOther, N::kMaximumFrequency},
    {9, kSk5 | kOld, "Actual PID frequency monitored", U::kOther, N::kMaximumFrequency},
    {10, kSk12, "Actual frequency PI monitored", U::kOther, N::kMaximumFrequency},
    {10, kSk5, "Torque servo mode", U::kOther, N::kNone},
    {10, kOld, "Torque", U::kOther, N::kNone},
    {11, kSk12, "Limiting torque current", U::kTorqueLimit, N::kTorqueLimit},
    {11, kSk5 | kSk7, "Torque precontrol", U::kTorquePrecontrol, N::kPrecontrol},
    {12, kSk12, "Torque current switch-off limit", U::kTorqueSwitchOff, N::kTorqueLimit},
    {12, kSk7, "POSICON control terminals", U::kPosiconBits, N::kBits},
    {13, kSk12, "Limiting current", U::kCurrentLimit, N::kRatedCurrent},
    {13, kSk5 | kSk7, "Multiplication", U::kOther, N::kNone},
    {14, kSk12, "Current switch-off limit", U::kCurrentSwitchOff, N::kRatedCurrent},
    {14, kSk5 | kOld, "Process controller actual value", U::kOther, N::kNone},
    {15, kSk12, "Ramp time", U::kOther, N::kNone},
    {15, kSk5 | kOld, "Process controller setpoint", U::kOther, N::kNone},
    {16, kSk12, "Lead torque (P214) multiplication", U::kOther, N::kNone},
    {16, kSk5 | kOld, "Process controller lead", U::kOther, N::kNone},
    // BU 0280 (2009): 17 servo mode torque, 19 bus I/O in bits. Bits taken for a torque would move the motor.
    {17, kSk12, "Multiplication", U::kDisputed, N::kNone},
    {17, kSk5 | kOld, "Bus I/O in bits 0...7", U::kBusBits, N::kBits},
    {18, kSk12, "Curve travel calculator", U::kOther, N::kNone},
    {18, kSk5 | kSk7, "Curve travel calculator", U::kOther, N::kNone},
    {19, kSk12, "Servo mode torque", U::kDisputed, N::kNone},
    {19, kSk5 | kOld, "Set relays", U::kOther, N::kBits},
    {20, kSk12, "Bus I/O in bits 0...7", U::kBusBits, N::kBits},
    {20, kSk5 | kOld, "Set analog output", U::kOther, N::kNone},
    {21, kSk5, "Setpoint position, low word (21)", U::kPositionLow, N::kThousandthTurn},
    {22, kSk5, "Setpoint position, high word (22)", U::kPositionHigh, N::kThousandthTurn},
    {23, kSk12, "Setpoint position, low word", U::kPositionLow, N::kThousandthTurn},
    {23, kSk5, "Setpoint position, low word (23)", U::kPositionLow, N::kThousandthTurn},
    {24, kSk12, "Setpoint position, high word", U::kPositionHigh, N::kThousandthTurn},
    {24, kSk5, "Setpoint position, high word (24)", U::kPositionHigh, N::kThousandthTurn},
    {31, kSk12, "Digital output IOE", U::kOther, N::kBits},
    {32, kSk12, "Analog output IOE", U::kOther, N::kNone},
    {46, kSk5, "Setpoint torque process controller", U::kOther, N::kNone},
    {48, kSk54, "Motor temperature", U::kOther, N::kNone},
    {53, kSk54, "d-correction F process", U::kOther, N::kNone},
    {54, kSk54, "d-correction torque", U::kOther, N::kNone},
    {55, kSk54, "d-correction F and torque", U::kOther, N::kNone},
};

// P543 to P545 (BU 0020 6.1.2, 6.2.2; BU 0280 5.1.3; BU 2700 5.3).
constexpr WordFunction kActualValues[] = {
    {0, kSk12 | kSk5 | kOld, "Off", U::kOff, N::kNone},
    {1, kSk12 | kSk5 | kOld, "Actual frequency", U::kFrequency, N::kMaximumFrequency},
    {2, kSk12 | kSk5 | kOld, "Actual speed", U::kSpeed, N::kNominalSize},
    {3, kSk12 | kSk5 | kOld, "Current", U::kCurrent, N::kNominalSize},
    {4, kSk12 | kSk5 | kOld, "Torque current", U::kTorqueCurrent, N::kTorqueLimit},
    {5, kSk12, "State of digital inputs and outputs", U::kDigitalIo, N::kBits},
    {5, kSk5 | kOld, "Digital I/O status", U::kDigitalIo, N::kBits},
    {6, kSk7, "Actual position", U::kPosition16, N::kThousandthTurn},
    {7, kSk7, "Setpoint position", U::kOther, N::kThousandthTurn},
    {8, kSk12 | kSk5 | kOld, "Setpoint frequency", U::kOther, N::kMaximumFrequency},
    {9, kSk12 | kSk5 | kOld, "Error number", U::kOther, N::kRaw},
    // BU 2700 5.3 and 6.4.4: SK 2xxE, and SK 530E and above; BU 0020 6.2.2 points to BU 0510 for them.
    {10, kSk12 | kSk5, "Actual position, low word", U::kPositionLow, N::kThousandthTurn},
    {10, kSk7, "Actual position increment", U::kIncrement16, N::kRaw},
    {11, kSk7, "Setpoint position increment", U::kOther, N::kRaw},
    {12, kSk12, "Bus out bits 0...7", U::kBusBits, N::kBits},
    {12, kSk5 | kOld, "Bus I/O out bits 0...7", U::kBusBits, N::kBits},
    {15, kSk12 | kSk5, "Actual position, high word", U::kPositionHigh, N::kThousandthTurn},
    {17, kSk12 | kSk5, "Value analog input 1", U::kAnalogInput1, N::kNominalSize},
    {18, kSk12 | kSk5, "Value analog input 2", U::kAnalogInput2, N::kNominalSize},
    {19, kSk12 | kSk5, "Setpoint frequency master value", U::kOther, N::kMaximumFrequency},
    {20, kSk12, "Setpoint frequency after master value ramp", U::kOther, N::kMaximumFrequency},
    {20, kSk5, "Setpoint frequency master value after ramp", U::kOther, N::kMaximumFrequency},
    {21, kSk12, "Actual frequency without master value slip", U::kOther, N::kMaximumFrequency},
    {21, kSk5, "Actual frequency without slip master value", U::kOther, N::kMaximumFrequency},
    {22, kSk12, "Speed from encoder", U::kOther, N::kNone},
    {22, kSk5, "Speed encoder", U::kOther, N::kNone},
    {23, kSk5, "Actual frequency with slip", U::kOther, N::kMaximumFrequency},
    {24, kSk5, "Master value actual frequency with slip", U::kOther, N::kMaximumFrequency},
};

constexpr std::uint16_t kFirstOfBu2700 = 23;
constexpr const char* kNoName = "reserved or unknown";

bool isOld(Series series) noexcept {
  return (bit(series) & kOld) != 0;
}

template <std::size_t Size, typename Fits>
const WordFunction* find(const WordFunction (&table)[Size], Series series, Fits fits) noexcept {
  for (const WordFunction& row : table) {
    if ((row.series & bit(series)) != 0 && fits(row)) return &row;
  }
  return nullptr;
}

template <typename Fits>
const WordFunction* findSetpoint(Series series, std::size_t place, Fits fits) noexcept {
  return isOld(series) && place == 1 ? find(kFirstSetpoint, series, fits) : find(kSetpoints, series, fits);
}

std::optional<std::uint16_t> codeOf(const WordFunction* function) noexcept {
  return function == nullptr ? std::nullopt : std::optional<std::uint16_t>{function->code};
}

WordParameter parameter(std::uint16_t first, Series series, std::size_t place) noexcept {
  const CycleParameter* const info = findCycleParameter(first, series);
  const bool array = info != nullptr && isArray(info->shape);
  if (array) return {first, static_cast<std::uint8_t>(place), true};
  return {static_cast<std::uint16_t>(first + place - 1), 1, false};
}

}  // namespace

const WordFunction* findSetpointFunction(Series series, std::size_t place, std::uint16_t code) noexcept {
  return findSetpoint(series, place, [code](const WordFunction& row) { return row.code == code; });
}

const WordFunction* findActualValueFunction(Series series, std::uint16_t code) noexcept {
  return find(kActualValues, series, [code](const WordFunction& row) { return row.code == code; });
}

// Of the positions of SK 53xE 23 and 24: BU 2700 5.3 pairs them with the actual values 10 and 15, so that both count the
// same steps, whatever these are. 21 and 22 may be others.
std::optional<std::uint16_t> setpointCode(Series series, std::size_t place, WordUse use) noexcept {
  if (use == WordUse::kPositionLow || use == WordUse::kPositionHigh) {
    return codeOf(findSetpoint(
        series, place, [use](const WordFunction& row) { return row.use == use && row.code >= kFirstOfBu2700; }));
  }
  return codeOf(findSetpoint(series, place, [use](const WordFunction& row) { return row.use == use; }));
}

std::optional<std::uint16_t> actualValueCode(Series series, WordUse use) noexcept {
  return codeOf(find(kActualValues, series, [use](const WordFunction& row) { return row.use == use; }));
}

const char* toString(Nominal nominal) noexcept {
  switch (nominal) {
    case Nominal::kMaximumFrequency:
      return "P105, the maximum frequency";
    case Nominal::kOwnFrequency:
      return "P105 by BU 0220, another by BU 0200";
    case Nominal::kTorqueLimit:
      return "P112, the torque current limit";
    case Nominal::kRatedCurrent:
      return "the inverter's rated current";
    case Nominal::kPrecontrol:
      return "P214, the torque precontrol";
    case Nominal::kNominalSize:
      return "the respective nominal size";
    case Nominal::kNone:
    case Nominal::kBits:
    case Nominal::kRaw:
    case Nominal::kThousandthTurn:
      break;
  }
  return "";
}

const char* setpointName(Series series, std::size_t place, std::uint16_t code) noexcept {
  const WordFunction* const function = findSetpointFunction(series, place, code);
  return function == nullptr ? kNoName : function->name;
}

const char* actualValueName(Series series, std::uint16_t code) noexcept {
  const WordFunction* const function = findActualValueFunction(series, code);
  return function == nullptr ? kNoName : function->name;
}

WordParameter setpointParameter(Series series, std::size_t place) noexcept {
  return parameter(546, series, place);
}

WordParameter actualValueParameter(Series series, std::size_t place) noexcept {
  return parameter(543, series, place);
}

}  // namespace nord_driver::profile
