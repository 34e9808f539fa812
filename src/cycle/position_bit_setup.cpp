#include "cycle/position_bit_setup.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "config/setting_checks.h"
#include "config/setting_choice.h"
#include "profile/process_data_order.h"

namespace nord_driver::cycle {

namespace {

constexpr Choice<bool> kTargets[] = {{"words", false}, {"array", true}};

/// "bus_in_bit_3": 3 after "bus_in_bit_"; none where it is another word or the number is none of `first` to `last`.
std::optional<std::uint8_t> numberAfter(const std::string& word, const std::string& before, int first, int last) {
  for (int number = first; number <= last; ++number) {
    if (word == before + std::to_string(number)) return static_cast<std::uint8_t>(number);
  }
  return std::nullopt;
}

// As the digital inputs of the inverters have them; their list (P420) is in none of the manuals at hand.
constexpr std::int64_t kReferenceRun = 22, kTeachIn = 24, kQuitTeachIn = 25, kArrayBit0 = 55, kResetPosition = 61;
// The same of the digital outputs (P434).
constexpr std::int64_t kReferenced = 20;

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

using NamedBits = std::vector<std::pair<PositionBit, const char*>>;

/// Bits of the carrier; of the control word and of bus I/O bits as they are numbered.
unsigned maskOf(const PositionBit& bit, unsigned value) {
  return value << bit.number;
}

void checkApart(const Settings& drive, const char* key, const PositionBit& bit, unsigned value,
                const NamedBits& others) {
  for (const auto& [other, name] : others) {
    if (other.carrier != bit.carrier || bit.carrier == PositionBit::Carrier::kPosicon) continue;
    if ((maskOf(bit, value) & maskOf(other, 1)) == 0) continue;
    throw wrongSetting(drive, key, "the bit of " + std::string(name), "another bit");
  }
}

/// The greatest number whose bits, from this one on, are all carried.
unsigned mostElements(const PositionBit& array) {
  const unsigned carried = array.carrier == PositionBit::Carrier::kBusBit       ? 8u - array.number
                           : array.carrier == PositionBit::Carrier::kControlBit ? 10u - array.number
                                                                                : kArrayBits;
  return (1u << std::min(carried, kArrayBits)) - 1u;
}

/// Those of `setup` that have been read, but for the array's.
NamedBits bitsOf(const PositionSetup& setup) {
  NamedBits all;
  if (setup.home) all.emplace_back(*setup.home, "position/home");
  if (setup.reset) all.emplace_back(*setup.reset, "position/reset");
  if (setup.teach) all.emplace_back(setup.teach->teach_in, "position/teach_in");
  if (setup.teach) all.emplace_back(setup.teach->quit, "position/quit_teach_in");
  return all;
}

std::optional<PositionBit> readReset(const Settings& drive, const PositionSetup& read, bool has_field) {
  const auto bit = readBit(drive, {"position/reset", "position/reset_function", kResetPosition}, has_field);
  if (bit) checkApart(drive, "position/reset", *bit, 1, bitsOf(read));
  return bit;
}

std::optional<TeachSetup> readTeach(const Settings& drive, const PositionSetup& read, bool has_field) {
  using Carrier = PositionBit::Carrier;
  const auto teach_in = readBit(drive, {"position/teach_in", "position/teach_in_function", kTeachIn}, has_field);
  auto quit = readBit(drive, {"position/quit_teach_in", "position/quit_teach_in_function", kQuitTeachIn}, has_field);
  std::optional<PositionBit> array = read.array;
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
  NamedBits taken = bitsOf(read);
  checkApart(drive, "position/teach_in", setup.teach_in, 1, taken);
  taken.emplace_back(setup.teach_in, "position/teach_in");
  checkApart(drive, "position/quit_teach_in", setup.quit, 1, taken);
  taken.emplace_back(setup.quit, "position/quit_teach_in");
  if (!array) return setup;
  checkApart(drive, "position/array_bit", *array, setup.element, taken);
  if (setup.element > mostElements(*array)) {
    throw wrongSetting(drive, "position/element", std::to_string(element),
                       "a number whose bits, the first of them position/array_bit, are all carried");
  }
  return setup;
}

/// Elements of the array as targets: by their bits, or by what stands in them.
void readElements(const Settings& drive, PositionSetup& setup) {
  drive::PositionConfig& axis = setup.axis;
  axis.by_element = choiceOr(drive, "position/targets", false, kTargets);
  if (!setup.array && setup.teach) setup.array = setup.teach->array;
  const unsigned most = axis.by_element && setup.array ? mostElements(*setup.array) : (1u << kArrayBits) - 1u;
  setup.elements = static_cast<std::uint8_t>(integerOr(drive, "position/elements", most, 1, most));
  if (!axis.by_element) return;
  if (!setup.array) {
    throw missingSetting(drive, "position/array_bit", "the first of the bits that choose the element");
  }
  if (setup.setpoint_mode < 0) {
    throw missingSetting(drive, "position/setpoint_mode",
                         "what P610 has to be where targets come out of the array, as the drive's own manual says");
  }
  checkApart(drive, "position/array_bit", *setup.array, allBits(setup.elements), bitsOf(setup));
}

std::optional<SignalSetup> readReferenced(const Settings& drive) {
  const std::string expected = "bus_out_bit_0 to 7, status_bit_10, status_bit_13";
  const std::string word = wordOr(drive, "position/referenced", "", expected);
  if (word.empty()) return std::nullopt;
  SignalSetup bit;
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

/// The same bit of the same carrier; of the bus I/O bits and of the control word.
bool isOn(const SignalSetup& signal, const PositionBit& bit, unsigned value) {
  const bool carried = (signal.source == SignalSource::kBusInBit && bit.carrier == PositionBit::Carrier::kBusBit) ||
                       (signal.source == SignalSource::kControlBit && bit.carrier == PositionBit::Carrier::kControlBit);
  return carried && (maskOf(bit, value) >> signal.number & 1u) != 0;
}

}  // namespace

void readPositionBits(const Settings& drive, profile::Series series, PositionSetup& setup) {
  const bool has_field = profile::thirdBeforeSecond(series);
  setup.home = readBit(drive, {"position/home", "position/home_function", kReferenceRun}, has_field);
  setup.reset = readReset(drive, setup, has_field);
  setup.array = readBit(drive, {"position/array_bit", "position/array_function", kArrayBit0}, has_field);
  setup.teach = readTeach(drive, setup, has_field);
  readElements(drive, setup);
  setup.referenced = readReferenced(drive);
  setup.referenced_function =
      static_cast<std::uint16_t>(integerOr(drive, "position/referenced_function", kReferenced, 0, 255));
}

void checkSignalsApart(const Settings& drive, const PositionSetup& setup, const std::vector<SignalSetup>& signals) {
  struct Taken {
    const char* key;
    std::optional<PositionBit> bit;
    unsigned value;
  };
  std::vector<Taken> all{{"position/home", setup.home, 1}, {"position/reset", setup.reset, 1}};
  if (setup.teach) {
    all.push_back({"position/teach_in", setup.teach->teach_in, 1});
    all.push_back({"position/quit_teach_in", setup.teach->quit, 1});
    all.push_back({"position/array_bit", setup.teach->array, setup.teach->element});
  }
  if (setup.axis.by_element) all.push_back({"position/array_bit", setup.array, allBits(setup.elements)});
  for (const SignalSetup& signal : signals) {
    for (const Taken& taken : all) {
      if (!taken.bit || !isOn(signal, *taken.bit, taken.value)) continue;
      throw wrongSetting(drive, "signals/" + signal.name + "/source", sourceText(signal),
                         std::string("another bit: it is one of ") + taken.key);
    }
  }
}

}  // namespace nord_driver::cycle
