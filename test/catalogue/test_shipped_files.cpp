// The schema of every shipped file, and what must hold for all of them together.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "catalogue/parameter_text.h"
#include "catalogue/shipped.h"

namespace nord_driver::catalogue {
namespace {

// Reading checks every key, kind, range, double number, name and source.
TEST(ShippedFiles, AreValid) {
  ASSERT_NO_THROW(shipped());
  ASSERT_NO_THROW(shippedFaults());
  EXPECT_EQ(9u, shippedParameterFiles().size());
  EXPECT_EQ(14u, shippedFaultFiles().size());
}

// Correcting is the user's: no two files of the project describe the same parameter of the same device.
TEST(ShippedFiles, DescribeNothingTwice) {
  std::map<std::pair<Device, std::uint16_t>, std::string> first;
  for (const std::string& file : shippedParameterFiles()) {
    const ParameterFile content = readParameterFile(file);
    for (const Device& device : content.devices) {
      for (const ParameterEntry& entry : content.entries) {
        const auto [place, is_new] = first.insert({{device, entry.number}, file});
        EXPECT_TRUE(is_new) << file << ": " << toString(device) << " " << entry.number << " is in " << place->second;
      }
    }
  }
}

TEST(ShippedFiles, EveryDeviceHasParameters) {
  std::size_t total = 0;
  for (const Device& device : allDevices()) {
    EXPECT_FALSE(shipped().all(device).empty()) << toString(device);
    total += shipped().all(device).size();
  }
  EXPECT_GT(total, 400u);
}

// Every parameter can be named instead of numbered, and every value it can take goes into words and back.
TEST(ShippedFiles, NamesAndValuesGoBackAndForth) {
  for (const Device& device : allDevices()) {
    for (const ParameterEntry* entry : shipped().all(device)) {
      const std::string where = toString(device) + " " + label(*entry);
      EXPECT_EQ(entry, shipped().look(device, entry->title()).entry) << where << " " << entry->title();
      for (unsigned index = 1; index <= entry->elements.value_or(1); ++index) {
        if (const auto fallback = entry->defaultOf(index)) {
          const auto raw = static_cast<std::int32_t>(entry->rawOf(*fallback));
          EXPECT_EQ(raw, rawFrom(*entry, valueText(*entry, raw, index), index).raw) << where;
        }
        const auto [lowest, highest] = entry->rawRange(index);
        for (const std::int64_t raw : {lowest, highest}) {
          const std::string text = valueText(*entry, static_cast<std::int32_t>(raw), index);
          const RawValue back = rawFrom(*entry, text, index);
          EXPECT_EQ(raw, back.raw.value_or(-12345678)) << where << " " << text << ": " << back.error;
        }
      }
    }
  }
}

// What cuts the branch the driver sits on, or resets a device, is never written.
TEST(ShippedFiles, FactorySettingsAreNeverWritten) {
  for (const Module module : {Module::kProfibus, Module::kDevicenet}) {
    const ParameterEntry* entry = shipped().find(module, 152);
    ASSERT_NE(nullptr, entry);
    EXPECT_FALSE(entry->mayWrite());
    EXPECT_NE("", whyNotWritable(*entry));
  }
}

// Information parameters from P700 on, and those of the modules from P170 on, cannot be written.
TEST(ShippedFiles, InformationIsReadOnly) {
  for (const Device& device : allDevices()) {
    const bool is_module = std::holds_alternative<Module>(device);
    for (const ParameterEntry* entry : shipped().all(device)) {
      if (entry->number >= 0x2000) continue;
      EXPECT_EQ(entry->number >= (is_module ? 170 : 700), entry->read_only.value_or(false))
          << toString(device) << " " << entry->number;
    }
  }
}

TEST(ShippedFiles, EveryTableOfFaultsIsThere) {
  for (const FaultCodes codes : kAllFaultCodes) {
    std::size_t entries = shippedFaults().all(codes).size();
    for (const Device& device : allDevices()) entries += shippedFaults().all(codes, device).size();
    EXPECT_GT(entries, 3u) << toString(codes);
  }
}

// A code that stands for others names numbers that are described.
TEST(ShippedFiles, WhatACodeStandsForIsDescribed) {
  for (const FaultEntry* entry : shippedFaults().all(FaultCodes::kEmcy)) {
    for (const std::uint32_t raw : entry->stands_for) {
      EXPECT_NE(nullptr, shippedFaults().find(FaultCodes::kP700, raw)) << entry->number << " " << raw;
    }
  }
  for (const FaultEntry* entry : shippedFaults().all(FaultCodes::kSdoAbort)) {
    for (const std::uint32_t raw : entry->stands_for) {
      EXPECT_NE(nullptr, shippedFaults().find(FaultCodes::kPkw, raw)) << entry->number << " " << raw;
    }
  }
}

}  // namespace
}  // namespace nord_driver::catalogue
