// The files against what stands in C++ source, because the cycle needs it there.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "profile/cycle_parameters.h"
#include "profile/word_function.h"

namespace nord_driver::catalogue {
namespace {

using profile::CycleParameter;
using profile::Series;

// P151 is of the bus module in front of the inverter.
Device deviceOf(std::uint16_t number, Series series) {
  if (number >= 150 && number < 200) return Module::kProfibus;
  return series;
}

std::vector<std::string> differences(const CycleParameter& row, const ParameterEntry* entry) {
  if (entry == nullptr) return {"missing"};
  std::vector<std::string> fields;
  if (row.name != entry->title()) fields.emplace_back("name");
  if (std::abs(row.resolution - entry->step()) > 1e-9) fields.emplace_back("resolution");
  if (row.is_signed != entry->isSigned()) fields.emplace_back("signed");
  if (row.shape != entry->shape()) fields.emplace_back("shape");
  if (row.elements != entry->elements.value_or(1)) fields.emplace_back("elements");
  if (entry->sizeOf(1) != 16) fields.emplace_back("size");
  return fields;
}

// What the cycle was compiled with is what the files say.
TEST(CatalogueAgreement, EveryParameterOfTheCycleIsInTheFiles) {
  std::set<std::string> found;
  int compared = 0;
  for (const Series series : profile::kAllSeries) {
    for (std::uint16_t number = 0; number < 1000; ++number) {
      const CycleParameter* row = profile::findCycleParameter(number, series);
      if (row == nullptr) continue;
      ++compared;
      const Device device = deviceOf(number, series);
      for (const std::string& field : differences(*row, shipped().find(device, number))) {
        found.insert(toString(device) + " " + std::to_string(number) + " " + field);
      }
    }
  }
  EXPECT_EQ(132, compared);
  EXPECT_EQ(std::set<std::string>{}, found);
}

// FaultReader asks for elements of P700, and without one where the inverter knows no array (BU 0020 8).
TEST(CatalogueAgreement, TheCurrentFaultIsAnArrayOfThree) {
  for (const Series series : profile::kAllSeries) {
    const ParameterEntry* entry = shipped().find(series, 700);
    ASSERT_NE(nullptr, entry) << toString(series);
    EXPECT_EQ(profile::ParameterShape::kArray, entry->shape()) << toString(series);
    EXPECT_EQ(3u, entry->elements) << toString(series);
    EXPECT_DOUBLE_EQ(0.1, entry->step()) << toString(series);
  }
}

// Abort codes that mean the same as a number of the parameter channel (BU 0060 p. 62, BU 0260 p. 56, BU 0020 7.5.1).
TEST(CatalogueAgreement, AbortsStandForTheSameNumbers) {
  const std::map<std::uint32_t, std::uint32_t> kSame{{0x06010002, 1}, {0x06020000, 0}, {0x06070010, 5}, {0x06070012, 5},
                                                     {0x06070013, 5}, {0x06090011, 3}, {0x06090030, 2}, {0x06090031, 2},
                                                     {0x06090032, 2}, {0x06090036, 2}};
  EXPECT_EQ(24u, shippedFaults().all(FaultCodes::kSdoAbort).size());
  for (const FaultEntry* entry : shippedFaults().all(FaultCodes::kSdoAbort)) {
    const auto same = kSame.find(entry->number);
    const auto expected = same == kSame.end() ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{same->second};
    EXPECT_EQ(expected, entry->stands_for) << faultLabel(FaultCodes::kSdoAbort, entry->number);
  }
}

// The functions of words, both ways: every code the files name, and no other.
std::vector<std::string> wordDifferences(Series series, std::size_t place, bool setpoint) {
  const profile::WordParameter at =
      setpoint ? profile::setpointParameter(series, place) : profile::actualValueParameter(series, place);
  const ParameterEntry* const entry = shipped().find(series, at.number);
  if (entry == nullptr) return {"missing"};
  std::vector<std::string> found;
  for (std::uint16_t code = 0; code < 100; ++code) {
    const auto* function =
        setpoint ? profile::findSetpointFunction(series, place, code) : profile::findActualValueFunction(series, code);
    std::string name;
    for (const auto& [first, value] : entry->valuesOf(at.index)) {
      if (first <= code && code <= value.last) name = value.name;
    }
    if (name.compare(0, 8, "reserved") == 0) name.clear();
    if (name == (function == nullptr ? "" : function->name)) continue;
    found.push_back(std::string{profile::toString(series)} + " P" + std::to_string(at.number) + " = " +
                    std::to_string(code) + ": the file says \"" + name + "\"");
  }
  return found;
}

TEST(CatalogueAgreement, TheFunctionsOfWordsAreThoseOfTheFiles) {
  for (const Series series : profile::kAllSeries) {
    for (std::size_t place = 1; place <= 3; ++place) {
      EXPECT_EQ(std::vector<std::string>{}, wordDifferences(series, place, true));
      EXPECT_EQ(std::vector<std::string>{}, wordDifferences(series, place, false));
    }
  }
}

}  // namespace
}  // namespace nord_driver::catalogue
