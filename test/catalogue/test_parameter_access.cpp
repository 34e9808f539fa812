// From what a user writes to a request: what cannot be meant is refused before the bus hears of it.
#include <gtest/gtest.h>

#include <limits>

#include "catalogue/parameter_access.h"
#include "catalogue/shipped.h"

namespace nord_driver::catalogue {
namespace {

using profile::ParameterAction;
using profile::ParameterShape;
using profile::Series;

DriveCatalogue drive(Series series = Series::kSk5xxe, std::optional<Module> module = std::nullopt) {
  return {shippedCatalogues(), series, module};
}

ParameterAccess access(std::uint16_t number, std::uint8_t set = 0, std::uint8_t index = 0) {
  return accessTo({number, set, index}, drive());
}

std::string refusal(std::uint16_t number, double value, bool allow_raw = false) {
  ParameterAccess made = access(number);
  return setValue(made, {value, false, allow_raw});
}

TEST(ParameterAccess, AnAddressOutsideThePossibleIsRefusedInWords) {
  EXPECT_EQ("", access(105, 4, 0).error);
  EXPECT_EQ("", access(700, 0, 3).error);
  EXPECT_EQ("parameter 1000 does not exist, expected 0 to 999", access(1000).error);
  EXPECT_EQ("parameter set 5 does not exist, expected 0 to 4", access(105, 5).error);
}

// P102 [7] would write P102 itself. [-01] of a parameter that is printed without elements is harmless.
TEST(ParameterAccess, AnIndexOfAParameterWithoutAnArrayIsRefused) {
  EXPECT_EQ("P102 is no array, expected index 0, not 7", access(102, 1, 7).error);
  EXPECT_EQ("P509 is no array, expected index 0, not 2", access(509, 0, 2).error);
  EXPECT_EQ("", access(102, 1, 1).error);
  EXPECT_EQ("", access(210, 0, 7).error) << "nobody knows whether P210 is one";
}

TEST(ParameterAccess, TheFilesSayHowAParameterIsIndexed) {
  EXPECT_EQ(ParameterShape::kPerSet, access(105, 3).request.shape);
  EXPECT_EQ(3, access(105, 3).request.parameter_set);
  EXPECT_EQ(ParameterShape::kArray, access(700, 0, 2).request.shape);
  EXPECT_EQ(ParameterShape::kPlain, access(509).request.shape);
  EXPECT_EQ(ParameterShape::kArrayPerSet, accessTo({546, 2, 3}, drive(Series::kSk54xe)).request.shape);
  EXPECT_EQ(ParameterShape::kArrayPerSet, access(210, 1, 2).request.shape) << "as it was asked for";
}

TEST(ParameterAccess, AValueBecomesWhatTheInverterStores) {
  ParameterAccess ramp = access(102, 1);
  EXPECT_EQ("", setValue(ramp, {2.5, true, false}));
  EXPECT_EQ(250, ramp.request.raw);
  EXPECT_EQ(ParameterAction::kWritePersistent, ramp.request.action);
  EXPECT_FALSE(ramp.request.double_word);
  EXPECT_DOUBLE_EQ(2.5, valueOf(ramp.entry, 250, 1));
}

// Rounded, 0.1 of a raw value would be 0, and nobody would hear of it.
TEST(ParameterAccess, AValueFinerThanTheResolutionIsRefused) {
  for (int raw = 1; raw <= 65535; ++raw) {
    ASSERT_EQ("", refusal(102, static_cast<float>(0.01 * raw))) << "0.01 s times " << raw << ", as a float";
  }
  EXPECT_EQ("P102: \"2.503\" is not valid, expected a multiple of 0.01 s", refusal(102, 2.503));
  EXPECT_EQ("P509: \"0.4\" is not valid, expected a multiple of 1", refusal(509, 0.4));
  for (std::int32_t raw = 0; raw <= 65'535; ++raw) {
    ParameterAccess ramp = access(102);
    ASSERT_EQ("", setValue(ramp, {raw * 0.01, false, false})) << raw;
    ASSERT_EQ(raw, ramp.request.raw);
  }
}

// 2 is two seconds, as for P102: taken for the raw value it would be a ramp of 0.02 s.
TEST(ParameterAccess, TheDecelerationTimeIsInSeconds) {
  for (const Series series : profile::kAllSeries) {
    ParameterAccess ramp = accessTo({103, 1, 0}, drive(series));
    EXPECT_EQ("", setValue(ramp, {2.0, false, false}));
    EXPECT_EQ(200, ramp.request.raw) << profile::toString(series);
    EXPECT_EQ("", setText(ramp, "0.4 s", false));
    EXPECT_EQ(40, ramp.request.raw);
    EXPECT_EQ("", setRaw(ramp, 70, false));
    EXPECT_EQ(70, ramp.request.raw) << "as dumps hold it";
    EXPECT_EQ("P103 = 2.00 s", valueSentence(ramp, 200, drive(series)));
  }
}

// A quantity of a unit that no source names is written as one that is in no catalogue.
TEST(ParameterAccess, AQuantityOfUnknownUnitIsARawValue) {
  ParameterAccess quick_stop = access(426);
  EXPECT_EQ("P426 Quick stop time: its unit is not known, and raw values need allow_raw_parameters: true",
            setValue(quick_stop, {10.0, false, false}));
  EXPECT_EQ("P426 Quick stop time: its unit is not known", setText(quick_stop, "10", false));
  EXPECT_EQ("P426: \"0.1\" is not valid, expected a multiple of 1", refusal(426, 0.1, true));
  EXPECT_EQ("", setValue(quick_stop, {10.0, false, true}));
  EXPECT_EQ(10, quick_stop.request.raw);
  EXPECT_EQ("", setRaw(quick_stop, 12, false));
  EXPECT_EQ("P426 = 12", valueSentence(quick_stop, 12, drive()));
  for (const std::uint16_t number : std::initializer_list<std::uint16_t>{112, 114, 214, 310, 311, 327, 536})
    EXPECT_NE("", refusal(number, 1.0)) << number;
  for (const std::uint16_t number :
       std::initializer_list<std::uint16_t>{301, 418, 420, 502, 506, 508, 509, 513, 600, 607}) {
    EXPECT_EQ("", refusal(number, 1.0)) << number << " is a number or a choice";
  }
}

TEST(ParameterAccess, AValueOutOfRangeIsRefused) {
  EXPECT_EQ("the value 200 cannot be written to P513, expected -0.1 to 100 s", refusal(513, 200.0));
  EXPECT_NE("", refusal(102, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_NE("", refusal(102, std::numeric_limits<double>::infinity()));
  EXPECT_NE("", refusal(102, 1e300));
  EXPECT_EQ("", refusal(513, -0.1));
}

// A raw value is what the inverter stores: half of one is a mistake, and nobody knows which neighbour was meant.
TEST(ParameterAccess, ARawValueIsAWholeNumber) {
  ASSERT_EQ(nullptr, access(999).entry);
  EXPECT_EQ("P999 is not in the catalogue: its unit is not known, and raw values need allow_raw_parameters: true",
            refusal(999, 12.0));
  EXPECT_EQ("", refusal(999, 12.0, true));
  EXPECT_EQ("the value 12.5 cannot be written to P999, expected a whole number of 32 bits", refusal(999, 12.5, true));
  EXPECT_NE("", refusal(999, 4e9, true));
  ParameterAccess raw = access(513);
  EXPECT_EQ("the value -0.2 cannot be written to P513, expected -0.1 to 100 s", setRaw(raw, -2, false));
  EXPECT_EQ("", setRaw(raw, -1, false));
  EXPECT_EQ(-1, raw.request.raw);
}

// Sent as a word, 70000 would arrive as 4464, and be read back as what was written.
TEST(ParameterAccess, ARawValueBeyondAWordIsADoubleWord) {
  for (const double value : {70'000.0, 65'536.0, -32'769.0}) {
    ParameterAccess wide = access(999);
    ASSERT_EQ("", setValue(wide, {value, true, true}));
    EXPECT_TRUE(wide.request.double_word) << value;
  }
  for (const double value : {65'535.0, -32'768.0, 0.0}) {
    ParameterAccess narrow = access(999);
    ASSERT_EQ("", setValue(narrow, {value, true, true}));
    EXPECT_FALSE(narrow.request.double_word) << value;
  }
}

// CANopen, DeviceNet and InterBus transfer the word FFFFh as 65535: what was read can be written back.
TEST(ParameterAccess, ARawValueMayComeWithoutItsSign) {
  ParameterAccess timeout = access(513);
  EXPECT_EQ("", setRaw(timeout, 65'535, false));
  EXPECT_EQ(-1, timeout.request.raw);
  EXPECT_EQ("the value -0.2 cannot be written to P513, expected -0.1 to 100 s", setRaw(timeout, 65'534, false));
  EXPECT_NE("", setRaw(timeout, 70'000, false));
}

TEST(ParameterAccess, ANameOfAValueMayBeTyped) {
  ParameterAccess source = access(509);
  EXPECT_EQ("", setText(source, "profibus", false));
  EXPECT_EQ(4, source.request.raw);
  EXPECT_EQ("", setText(source, "6", false));
  EXPECT_EQ(6, source.request.raw);
  EXPECT_EQ("P509: \"PROFIBAS\" is not valid, expected perhaps \"PROFIBUS\"", setText(source, "PROFIBAS", false));
  ParameterAccess timeout = access(513);
  EXPECT_EQ("the value -0.2 cannot be written to P513, expected -0.1 to 100 s", setText(timeout, "-0.2", false));
  EXPECT_EQ("P513: \"1.25\" is not valid, expected a multiple of 0.1 s", setText(timeout, "1.25", false));
}

// By whatever way, and whatever the value.
TEST(ParameterAccess, WhatIsReadOnlyOrResetsADeviceIsNotWritten) {
  ParameterAccess version = access(707);
  for (const std::string& why :
       {setValue(version, {1.0, false, true}), setRaw(version, 1, false), setText(version, "1", false)}) {
    EXPECT_EQ("P707 Software version can only be read", why);
  }
  ParameterAccess factory = accessTo({152, 0, 0}, drive(Series::kSk5xxe, Module::kProfibus));
  EXPECT_EQ(0u, setRaw(factory, 1, false).find("P152 Factory setting is never written: ")) << setRaw(factory, 1, false);
  for (const std::uint16_t number : {std::uint16_t{152}, std::uint16_t{970}}) {
    ParameterAccess unknown = access(number);
    ASSERT_EQ(nullptr, unknown.entry);
    EXPECT_EQ("P" + std::to_string(number) + " is never written: it resets the device to its factory settings",
              setRaw(unknown, 1, false));
    EXPECT_NE("", refusal(number, 1.0, true));
  }
}

// P150 to P199 are those of the module where there is one; P740 of the inverter and P176 of the module have one name.
TEST(ParameterAccess, TheModuleInFrontHasItsOwnNumbers) {
  EXPECT_EQ(nullptr, drive().find(151));
  const DriveCatalogue behind = drive(Series::kSk5xxe, Module::kProfibus);
  ASSERT_NE(nullptr, behind.find(151));
  EXPECT_EQ("s", behind.find(151)->unitOf(1));
  EXPECT_EQ("\"profibus address\" is not valid, expected a number: P160 and P508 have this name",
            behind.look("profibus address").error);
  EXPECT_EQ(151, behind.look("Timeout for external bus").entry->number);
  EXPECT_EQ(105, behind.look("maximum frequency").entry->number);
  EXPECT_EQ(nullptr, behind.look("Process data bus in").entry);
  std::uint16_t last = 0;
  for (const ParameterEntry* entry : behind.all()) {
    EXPECT_LT(last, entry->number);
    last = entry->number;
  }
}

TEST(ParameterAccess, ValuesAreNamed) {
  const DriveCatalogue known = drive();
  EXPECT_EQ("4 PROFIBUS", known.valueText(known.find(509), 4));
  EXPECT_EQ("2.1 motor overtemperature (I2t)", known.valueText(known.find(700), 21, 1));
  EXPECT_EQ("0.0 no fault", known.valueText(known.find(701), 0, 2));
  EXPECT_EQ("0.0", known.valueText(known.find(700), 0, 3)) << "the reason of a switch-on block is no fault";
  EXPECT_EQ("-3", known.valueText(nullptr, -3));
  EXPECT_EQ("Process data bus in, Setpoint 1", fullName(known.find(740), 2));
  EXPECT_EQ("Maximum frequency", fullName(known.find(105), 1));
  EXPECT_EQ("", fullName(nullptr, 1));
}

TEST(ParameterAccess, AValueIsASentenceWhetherItIsKnownOrNot) {
  const DriveCatalogue known = drive();
  EXPECT_EQ("P105 = 50.0 Hz", valueSentence(access(105), 500, known));
  EXPECT_EQ("P740[-02] = 2000h", valueSentence(access(740, 0, 2), 8192, known).substr(0, 17));
  EXPECT_EQ("P799 = -3 (raw)", valueSentence(access(799), -3, known));
}

}  // namespace
}  // namespace nord_driver::catalogue
