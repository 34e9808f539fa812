#include "cycle/position_setup.h"

#include <string>
#include <utility>
#include <vector>

#include "config/setting_checks.h"
#include "config/setting_choice.h"
#include "profile/process_data_order.h"

namespace nord_driver::cycle {

namespace {

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kMost = 1e6;               // rad, m, rad/s, m/s
constexpr double kDefaultTolerance = 0.01;  // revolutions of the count

constexpr Choice<DriveMode> kModes[] = {{"velocity", DriveMode::kVelocity}, {"position", DriveMode::kPosition}};
constexpr Choice<profile::FieldOrder> kOrders[] = {{"high_first", profile::FieldOrder::kHighFirst},
                                                   {"low_first", profile::FieldOrder::kLowFirst}};

/// m for a revolution of the joint's shaft; none: the joint turns.
std::optional<double> readLead(const Settings& drive, const std::optional<robot::JointRange>& joint) {
  if (!drive.has("lead")) {
    if (joint && joint->is_prismatic) {
      throw missingSetting(drive, "lead", "m per revolution of the joint's shaft: the joint is prismatic");
    }
    return std::nullopt;
  }
  const double lead = requiredNumber(drive, "lead", 1e-6, 1e3, "m");
  if (joint && !joint->is_prismatic) {
    throw wrongSetting(drive, "lead", shortNumber(lead),
                       "no such key: in robot_description this joint turns, its positions are rad");
  }
  return lead;
}

/// The narrower of what is typed and what the robot's description says.
void readLimits(const Settings& drive, const char* unit, const std::optional<robot::JointRange>& joint,
                drive::PositionConfig& axis) {
  if (joint) {
    axis.lower = joint->lower;
    axis.upper = joint->upper;
  }
  if (drive.has("position/lower")) {
    const double lower = requiredNumber(drive, "position/lower", -kMost, kMost, unit);
    if (!axis.lower || lower > *axis.lower) axis.lower = lower;
  }
  if (drive.has("position/upper")) {
    const double upper = requiredNumber(drive, "position/upper", -kMost, kMost, unit);
    if (!axis.upper || upper < *axis.upper) axis.upper = upper;
  }
  if (axis.lower && axis.upper && *axis.lower >= *axis.upper) {
    throw wrongSetting(drive, "position/upper", shortNumber(*axis.upper),
                       "more than the lower limit, " + shortNumber(*axis.lower));
  }
}

/// "bus_in_bit_3": 3 after "bus_in_bit_"; none where the word begins otherwise or the number is none of `first` to `last`.
std::optional<std::uint8_t> numberAfter(const std::string& word, const std::string& before, int first, int last) {
  if (word.rfind(before, 0) != 0) return std::nullopt;
  for (int number = first; number <= last; ++number) {
    if (word == before + std::to_string(number)) return static_cast<std::uint8_t>(number);
  }
  return std::nullopt;
}

// As the digital inputs of the inverters have them; their list (P420) is in none of the manuals at hand.
constexpr std::int64_t kReferenceRun = 22, kTeachIn = 24, kQuitTeachIn = 25, kArrayBit0 = 55;
constexpr unsigned kArrayBits = 6;  // BU 0020 7.3.5

struct BitKeys {
  const char* bit;
  const char* function;
  std::int64_t usual;  ///< function
};

std::optional<PositionBit> readBit(const Settings& drive, const BitKeys& keys, bool has_field) {
  const std::string expected = std::string("bus_in_bit_0 to 7, control_bit_8, control_bit_9") + ", posicon_bits";
  const std::string word = wordOr(drive, keys.bit, "", expected);
  const auto function = integerOr(drive, keys.function, keys.usual, 1, 255);
  if (word.empty()) return std::nullopt;
  PositionBit bit;
  bit.function = static_cast<std::uint16_t>(function);
  if (const auto bus = numberAfter(word, "bus_in_bit_", 0, 7)) {
    bit.carrier = PositionBit::Carrier::kBusBit;
    bit.number = *bus;
  } else if (const auto control = numberAfter(word, "control_bit_", 8, 9); control && !has_field) {
    bit.carrier = PositionBit::Carrier::kControlBit;
    bit.number = *control;
  } else if (word == "posicon_bits" && has_field) {
    bit.carrier = PositionBit::Carrier::kPosicon;
  } else {
    throw wrongSetting(
        drive, keys.bit, "\"" + word + "\"",
        has_field ? "bus_in_bit_0 to 7 or posicon_bits" : "bus_in_bit_0 to 7, control_bit_8 or control_bit_9");
  }
  return bit;
}

/// Bits of the carrier; of the control word and of bus I/O bits as they are numbered.
unsigned maskOf(const PositionBit& bit, unsigned value) {
  return value << bit.number;
}

void checkApart(const Settings& drive, const char* key, const PositionBit& bit, unsigned value,
                const std::vector<std::pair<PositionBit, const char*>>& others) {
  for (const auto& [other, name] : others) {
    if (other.carrier != bit.carrier || bit.carrier == PositionBit::Carrier::kPosicon) continue;
    if ((maskOf(bit, value) & maskOf(other, 1)) == 0) continue;
    throw wrongSetting(drive, key, "the bit of " + std::string(name), "another bit");
  }
}

std::optional<TeachSetup> readTeach(const Settings& drive, const std::optional<PositionBit>& home, bool has_field) {
  using Carrier = PositionBit::Carrier;
  const auto teach_in = readBit(drive, {"position/teach_in", "position/teach_in_function", kTeachIn}, has_field);
  auto quit = readBit(drive, {"position/quit_teach_in", "position/quit_teach_in_function", kQuitTeachIn}, has_field);
  auto array = readBit(drive, {"position/array_bit", "position/array_function", kArrayBit0}, has_field);
  const auto element = integerOr(drive, "position/element", 1, 1, (1 << kArrayBits) - 1);
  if (!teach_in) return std::nullopt;
  // Those bits have their places in the word (BU 0020 7.3.5).
  if (teach_in->carrier == Carrier::kPosicon) {
    if (!quit) quit = teach_in;
    if (!array) array = teach_in;
  }
  if (!quit) {
    throw missingSetting(drive, "position/quit_teach_in", "the bit that ends what position/teach_in has begun");
  }
  TeachSetup setup{*teach_in, *quit, array, static_cast<std::uint8_t>(element)};
  std::vector<std::pair<PositionBit, const char*>> taken;
  if (home) taken.emplace_back(*home, "position/home");
  checkApart(drive, "position/teach_in", setup.teach_in, 1, taken);
  taken.emplace_back(setup.teach_in, "position/teach_in");
  checkApart(drive, "position/quit_teach_in", setup.quit, 1, taken);
  taken.emplace_back(setup.quit, "position/quit_teach_in");
  if (!array) return setup;
  checkApart(drive, "position/array_bit", *array, setup.element, taken);
  const unsigned most = array->carrier == Carrier::kBusBit       ? 0xFFu
                        : array->carrier == Carrier::kControlBit ? 0x3FFu
                                                                 : ~0u;
  if (maskOf(*array, setup.element) > most) {
    throw wrongSetting(drive, "position/element", std::to_string(element),
                       "a number whose bits, the first of them position/array_bit, are all carried");
  }
  return setup;
}

std::optional<SignalSetup> readReferenced(const Settings& drive) {
  const std::string expected = "bus_out_bit_0 to 7, status_bit_10, status_bit_13";
  const std::string word = wordOr(drive, "position/referenced", "", expected);
  if (word.empty()) return std::nullopt;
  SignalSetup bit;
  bit.name = "referenced";
  if (const auto bus = numberAfter(word, "bus_out_bit_", 0, 7)) {
    bit.source = SignalSource::kBusOutBit;
    bit.number = *bus;
  } else if (const auto status = numberAfter(word, "status_bit_", 10, 13); status == 10 || status == 13) {
    bit.source = SignalSource::kStatusBit;
    bit.number = *status;
  } else {
    throw wrongSetting(drive, "position/referenced", "\"" + word + "\"", expected);
  }
  return bit;
}

}  // namespace

DriveMode readDriveMode(const Settings& drive) {
  return choiceOr(drive, "mode", DriveMode::kVelocity, kModes);
}

PositionSetup readPositionSetup(const Settings& drive, const PositionContext& context) {
  const profile::Series series = context.series;
  const profile::JointScaling& scaling = context.scaling;
  const auto& joint = context.joint;
  if (series == profile::Series::kSk1x0e || series == profile::Series::kSk300e) {
    // BU 0020 6.1.2 (SK 7x0E only), 7.3.5; BU 2700 6.4.4: SK 2xxE, and SK 530E and above.
    throw wrongSetting(drive, "mode", "\"position\"",
                       std::string("velocity: inverters ") + profile::toString(series) + " do not position");
  }
  PositionSetup setup;
  const auto lead = readLead(drive, joint);
  const char* const unit = lead ? "m" : "rad";
  const double unit_per_turn = lead ? *lead : kTwoPi;
  const double turns = numberOr(drive, "position/gear_ratio", scaling.gear_ratio, 1e-6, 1e6, "");
  setup.axis.unit_per_radian = unit_per_turn / kTwoPi;
  setup.axis.revolutions_per_motor_turn = turns / scaling.gear_ratio;
  setup.axis.scale.revolutions_per_unit = (scaling.inverted ? -turns : turns) / unit_per_turn;
  setup.axis.scale.offset = numberOr(drive, "position/offset", 0.0, -kMost, kMost, unit);
  if (drive.has("position/steps_per_revolution")) {
    setup.axis.scale.steps_per_revolution = requiredNumber(drive, "position/steps_per_revolution", 1.0, 1e6, "");
  }
  setup.axis.tolerance =
      numberOr(drive, "position/tolerance", kDefaultTolerance / turns * unit_per_turn, 0.0, kMost, unit);
  if (drive.has("position/speed")) {
    const double speed = requiredNumber(drive, "position/speed", 1e-6, kMost, lead ? "m/s" : "rad/s");
    setup.axis.speed = RadPerSec{speed / setup.axis.unit_per_radian};
  }
  readLimits(drive, unit, joint, setup.axis);
  const auto bits = integerOr(drive, "position/bits", 32, 16, 32);
  if (bits != 16 && bits != 32) throw wrongSetting(drive, "position/bits", std::to_string(bits), "16 or 32");
  setup.bits = static_cast<std::uint8_t>(bits);
  setup.order = choiceOr(drive, "position/word_order", profile::FieldOrder::kHighFirst, kOrders);
  setup.setpoint_mode = static_cast<std::int32_t>(integerOr(drive, "position/setpoint_mode", -1, -1, 100));
  const bool has_field = profile::thirdBeforeSecond(series);
  setup.home = readBit(drive, {"position/home", "position/home_function", kReferenceRun}, has_field);
  setup.teach = readTeach(drive, setup.home, has_field);
  setup.referenced = readReferenced(drive);
  setup.axis.homing_timeout = seconds(numberOr(drive, "position/homing_timeout", 60.0, 0.1, 3600.0, "s"));
  return setup;
}

void refusePositionKeys(const Settings& drive) {
  if (drive.has("lead")) {
    throw wrongSetting(drive, "lead", shortNumber(drive.number("lead").value_or(0.0)), "mode: position beside it");
  }
}

void checkPositionCarried(const Settings& drive, const PositionSetup& setup, profile::Series series,
                          const DriveIdentity& identity) {
  // The field of SK 700E and 750E takes the places of setpoints 1 and 3 (BU 0020 7.3.1).
  const std::size_t needed = setup.bits == 16 ? 1 : profile::thirdBeforeSecond(series) ? 3 : 2;
  if (identity.process_values >= needed) return;
  throw wrongSetting(drive, "position/bits", std::to_string(setup.bits),
                     std::string("16, or a longer telegram (PPO type, assembly): ") + std::to_string(setup.bits) +
                         " bits need " + std::to_string(needed) + " setpoints and actual values, and the bus carries " +
                         std::to_string(identity.process_values));
}

}  // namespace nord_driver::cycle
