// Fault, error and abort numbers in words.
#include <gtest/gtest.h>

#include "catalogue/shipped.h"

namespace nord_driver::catalogue {
namespace {

using profile::Series;

// What a series' own manual prints goes before what holds for all (BU 0020 8.1 against BU 0220 6.2.1: 10.3).
TEST(FaultCatalogue, TheSeriesGoesFirst) {
  EXPECT_EQ("system error of the option (10.3)", shippedFaults().find(FaultCodes::kP700, 103, Series::kSk300e)->name);
  EXPECT_EQ("timeout by P151", shippedFaults().find(FaultCodes::kP700, 103, Series::kSk2xxe)->name);
  EXPECT_EQ("timeout by P151 or P513", shippedFaults().find(FaultCodes::kP700, 103)->name);
  EXPECT_EQ(shippedFaults().find(FaultCodes::kP700, 30), shippedFaults().find(FaultCodes::kP700, 30, Series::kSk2xxe));
}

TEST(FaultCatalogue, WhatIsNotDescribedIsNotThere) {
  EXPECT_EQ(nullptr, shippedFaults().find(FaultCodes::kP700, 777, Series::kSk2xxe));
  EXPECT_EQ(nullptr, shippedFaults().find(FaultCodes::kP170, 5210, Module::kProfibus));
  EXPECT_NE(nullptr, shippedFaults().find(FaultCodes::kP170, 5210, Module::kDevicenet));
}

// The text copy of BU 0060 p. 93: 8100h stands for 10.0 ... 10.7, 2200h for 4.0 and 4.1.
TEST(FaultCatalogue, CodesThatStandForSeveral) {
  EXPECT_EQ((std::vector<std::uint32_t>{100, 101, 102, 103, 104, 105, 106, 107}),
            shippedFaults().find(FaultCodes::kEmcy, 0x8100)->stands_for);
  EXPECT_EQ((std::vector<std::uint32_t>{40, 41}), shippedFaults().find(FaultCodes::kEmcy, 0x2200)->stands_for);
}

// BU 0070 6.4.2, BU 0220 6.2.2, BU 0280 6.2.2, BU 2700 6.5.1.1, typed from there.
TEST(FaultCatalogue, NamesOfTheManuals) {
  EXPECT_EQ("reference limit", shippedFaults().find(FaultCodes::kDrivecom, 0x8612)->name);
  EXPECT_EQ("charging error", shippedFaults().find(FaultCodes::kDrivecom, 0x3230)->name);
  EXPECT_EQ(30u, shippedFaults().all(FaultCodes::kDrivecom).size());
  EXPECT_EQ("PROFIBUS address wrong", shippedFaults().find(FaultCodes::kP170, 5010, Module::kProfibus)->name);
  EXPECT_EQ("address already allocated", shippedFaults().find(FaultCodes::kP170, 5211, Module::kDevicenet)->name);
  EXPECT_EQ("only resettable", shippedFaults().find(FaultCodes::kPkw, 6)->name);
  EXPECT_EQ("internal response label cannot be depicted", shippedFaults().find(FaultCodes::kPkw, 202)->name);
}

TEST(FaultCatalogue, Labels) {
  EXPECT_EQ("E10.2", faultLabel(FaultCodes::kP700, 102));
  EXPECT_EQ("1020", faultLabel(FaultCodes::kP170, 1020));
  EXPECT_EQ("8100h", faultLabel(FaultCodes::kEmcy, 0x8100));
  EXPECT_EQ("603Fh", faultLabel(FaultCodes::kDrivecom, 0x603F));
  EXPECT_EQ("201", faultLabel(FaultCodes::kPkw, 201));
  EXPECT_EQ("B5h", faultLabel(FaultCodes::kDpv1, 0xB5));
  EXPECT_EQ("06090011h", faultLabel(FaultCodes::kSdoAbort, 0x06090011));
  EXPECT_EQ("02h", faultLabel(FaultCodes::kDevicenetGeneral, 2));
}

}  // namespace
}  // namespace nord_driver::catalogue
