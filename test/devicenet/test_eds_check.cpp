#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devicenet/eds_check.h"
#include "devicenet/eds_samples.h"
#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr EdsAssemblies kHundred{110, 100, false};

std::vector<std::string> check(const NodeConfig& config, const EdsAssemblies& assemblies = kHundred,
                               const char* text = kEds) {
  return checkAgainstEds(config, assemblies, parseEds(text));
}

TEST(EdsCheck, WhatFits) {
  for (const IoKind kind : {IoKind::kPoll, IoKind::kChangeOfState}) EXPECT_THAT(check(nodeConfig(5, kind)), IsEmpty());
  NodeConfig same = nodeConfig(5);
  same.vendor_id = std::uint16_t{389};
  same.product_code = std::uint16_t{7};
  EXPECT_THAT(check(same), IsEmpty());
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 17, 21), {130, 120, true}), IsEmpty());
  EXPECT_THAT(check(nodeConfig(5, IoKind::kStrobe, 4, 4), {70, 20, false}), IsEmpty());
  NodeConfig silent = nodeConfig(5);
  silent.io.kind = IoKind::kNone;
  EXPECT_THAT(check(silent, {111, 101, false}), IsEmpty()) << "explicit messages alone";
}

TEST(EdsCheck, AnotherIdentity) {
  NodeConfig other = nodeConfig(5);
  other.vendor_id = std::uint16_t{1};
  other.device_type = std::uint16_t{3};
  other.product_code = std::uint16_t{8};
  EXPECT_THAT(check(other),
              ElementsAre("line 6: vendor_id is 389, configured is 1", "line 8: device_type is 2, configured is 3",
                          "line 10: product_code is 7, configured is 8"));
}

TEST(EdsCheck, AnotherLength) {
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 8, 8)),
              ElementsAre("line 19: assembly 110 has 5 bytes, configured are 8",
                          "line 28: assembly 100 has 5 bytes, configured are 8"));
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 34, 21), {130, 120, true}),
              ElementsAre("line 26: assembly 130 has at most 33 bytes, configured are 34"));
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 33, 33), {112, 102, false}),
              ElementsAre("line 13: no Output is assembly 102; there are those of assemblies 20, 100, 120"));
}

// Without paths any entry of the length may be the one.
TEST(EdsCheck, WithoutPaths) {
  constexpr const char* kPathless = "[Device]\nVendCode = 389;\n[IO_Info]\nInput1 = 4, 0, 1;\nInput2 = 5, 0, 1;\n";
  EXPECT_THAT(check(nodeConfig(5), kHundred, kPathless), IsEmpty());
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 8, 8), kHundred, kPathless),
              ElementsAre("line 3: no Input has 8 bytes; there are those of 4, 5"));
}

TEST(EdsCheck, AKindItDoesNotHave) {
  EXPECT_THAT(check(nodeConfig(5, IoKind::kCyclic, 4, 4), {70, 20, false}),
              ElementsAre("line 13: the device has no process data by cyclic"));
  EXPECT_THAT(check(nodeConfig(5, IoKind::kChangeOfState, 33, 33), {130, 120, true}),
              ElementsAre("line 26: assembly 130 is not exchanged by change of state",
                          "line 29: assembly 120 is not exchanged by change of state"));
  constexpr const char* kAlone = "[Device]\nVendCode = 389;\n[IO_Info]\nPollInfo = 1, 1, 1;\nStrobeInfo = 2, 1, 1;\n";
  EXPECT_THAT(check(nodeConfig(5, IoKind::kStrobe, 5, 5), kHundred, kAlone),
              ElementsAre("line 5: the device does not have a bit strobe and a poll at the same time"));
  EXPECT_THAT(check(nodeConfig(5, IoKind::kStrobe, 5, 0), kHundred, kAlone), IsEmpty());
}

// What is left open is the file's from then on: another device at that MAC id is named and not polled.
TEST(EdsCheck, FillsTheIdentity) {
  NodeConfig config = nodeConfig(5);
  config.product_code = std::uint16_t{7};
  config = filledFromEds(config, parseEds(kEds));
  EXPECT_EQ(std::uint16_t{389}, config.vendor_id);
  EXPECT_EQ(std::uint16_t{2}, config.device_type);
  EXPECT_EQ(std::uint16_t{7}, config.product_code);
  EXPECT_FALSE(filledFromEds(nodeConfig(5), parseEds("[Device]\nVendCode = 0;")).vendor_id);
}

// The outputs of a bit strobe go by a poll: the assembly they go to is asked for that, and the device for both.
TEST(EdsCheck, ABitStrobeIsPolledBesideIt) {
  EXPECT_THAT(check(nodeConfig(5, IoKind::kStrobe, 5, 5)), IsEmpty()) << "assembly 100 is not strobed";
  constexpr const char* kNoPoll = "[Device]\nVendCode = 389;\n[IO_Info]\nStrobeInfo = 3, 1, 1;\n";
  EXPECT_THAT(check(nodeConfig(5, IoKind::kStrobe, 5, 5), kHundred, kNoPoll),
              ElementsAre("line 3: the device cannot be polled beside the bit strobe"));
  EXPECT_THAT(check(nodeConfig(5, IoKind::kStrobe, 5, 0), kHundred, kNoPoll), IsEmpty());
}

// Of an assembly that parameters lay out the file has the longest: as long or shorter fits, with a path or without.
TEST(EdsCheck, AVariableLengthIsAtMostThatOfTheFile) {
  constexpr const char* kPathless = "[Device]\nVendCode = 389;\n[IO_Info]\nInput1 = 4, 0, 1;\nInput2 = 5, 0, 1;\n";
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 33, 33), {130, 120, true}), IsEmpty());
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 3, 5), {130, 120, true}, kPathless), IsEmpty());
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 5, 5), {130, 120, true}, kPathless), IsEmpty());
  EXPECT_THAT(check(nodeConfig(5, IoKind::kPoll, 6, 5), {130, 120, true}, kPathless),
              ElementsAre("line 3: no Input has 6 bytes; there are those of 4, 5"));
}

}  // namespace
}  // namespace nord_driver::devicenet
