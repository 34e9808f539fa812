// The files against the catalogue in C++ source, entry by entry.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "profile/fault_table.h"
#include "profile/parameter_catalogue.h"
#include "profile/pkw.h"

namespace nord_driver::catalogue {
namespace {

using profile::ParameterInfo;
using profile::Series;

// Where file and source differ, and who is right.
const std::set<std::string> kKnown{
    // BU 2700 7.1.3 and BU 0220 5.2.2 print one decimal: the file.
    "module_profibus 171 resolution",
    // BU 2700 7.1.4 and BU 0220 5.2.3: 3 ... 125: the file.
    "module_profibus 180 minimum",
    "module_profibus 180 maximum",
    // No manual says whether P506 depends on the parameter set: the file leaves it open, and so counts it as if it did.
    "sk1x0e 506 shape",
    "sk2xxe 506 shape",
    "sk300e 506 shape",
    "sk5xxe 506 shape",
    "sk54xe 506 shape",
    "sk700e 506 shape",
    "sk750e 506 shape",
};

// Names in the files are those of the manual of the family; the source has one for all.
const std::set<std::string> kOtherNames{
    "PPO type of the slots", "Source control word",      "Source setpoints", "CAN baud rate", "CAN address",
    "Bus actual value",      "Function of bus setpoint", "Current fault",    "Last faults",   "DIP switches"};

std::string lowerCase(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

// P150 ... P199 are of the bus module in front of the inverter.
Device deviceOf(std::uint16_t number, Series series) {
  if (number >= 150 && number < 200) return Module::kProfibus;
  return series;
}

std::vector<std::string> differences(const ParameterInfo& cpp, const ParameterEntry* entry) {
  if (entry == nullptr) return {"missing"};
  std::vector<std::string> fields;
  if (lowerCase(cpp.name) != lowerCase(entry->title()) && kOtherNames.count(cpp.name) == 0) fields.emplace_back("name");
  if (cpp.unit != entry->unitOf(1)) fields.emplace_back("unit");
  if (std::abs(cpp.resolution - entry->step()) > 1e-9) fields.emplace_back("resolution");
  if (cpp.is_signed != entry->isSigned()) fields.emplace_back("signed");
  if (cpp.shape != entry->shape()) fields.emplace_back("shape");
  if (cpp.elements != entry->elements.value_or(1)) fields.emplace_back("elements");
  // The source has the range of a word where it knows none.
  const bool no_range = cpp.minimum == 0 && cpp.maximum == 65535;
  if (no_range && entry->range) return fields;
  if (cpp.minimum != entry->rawRange(1).first) fields.emplace_back("minimum");
  if (cpp.maximum != entry->rawRange(1).second) fields.emplace_back("maximum");
  return fields;
}

TEST(CatalogueAgreement, EveryParameterOfTheSourceIsInTheFiles) {
  std::set<std::string> found;
  int compared = 0;
  for (const Series series : profile::kAllSeries) {
    for (std::uint16_t number = 0; number < 1000; ++number) {
      const ParameterInfo* cpp = profile::findParameter(number, series);
      if (cpp == nullptr) continue;
      ++compared;
      const Device device = deviceOf(number, series);
      for (const std::string& field : differences(*cpp, shipped().find(device, number))) {
        found.insert(toString(device) + " " + std::to_string(number) + " " + field);
      }
    }
  }
  EXPECT_EQ(273, compared);
  EXPECT_EQ(kKnown, found);
}

// Number, name, cause and remedy of the inverters' faults; of the modules' the number (each bus has a file of its own).
TEST(CatalogueAgreement, EveryFaultOfTheSourceIsInTheFiles) {
  for (const profile::FaultInfo& cpp : profile::faultTable()) {
    if (cpp.raw >= 1000) {
      EXPECT_TRUE(shippedFaults().find(FaultCodes::kP170, cpp.raw, Module::kProfibus) != nullptr ||
                  shippedFaults().find(FaultCodes::kP170, cpp.raw, Module::kDevicenet) != nullptr)
          << cpp.raw;
      continue;
    }
    const FaultEntry* entry = shippedFaults().find(FaultCodes::kP700, cpp.raw);
    ASSERT_NE(nullptr, entry) << cpp.raw;
    EXPECT_EQ(cpp.text, entry->name) << cpp.raw;
    EXPECT_EQ(cpp.cause, entry->cause) << cpp.raw;
    EXPECT_EQ(cpp.remedy, entry->remedy) << cpp.raw;
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

// The numbers of the parameter channel the source has words for, and no others.
TEST(CatalogueAgreement, ErrorNumbersOfTheParameterChannel) {
  for (std::uint16_t number = 0; number < 500; ++number) {
    const bool known = profile::pkwErrorText(number).str().find("do not list") == std::string::npos;
    EXPECT_EQ(known, shippedFaults().find(FaultCodes::kPkw, number) != nullptr) << number;
  }
}

}  // namespace
}  // namespace nord_driver::catalogue
