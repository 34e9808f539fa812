#include <gtest/gtest.h>

#include "profibus/configuration_bytes.h"

namespace nord_driver::profibus {
namespace {

std::string lengths(const char* configuration) {
  const auto found = ioLengths(fromHex(configuration));
  if (!found) return "broken";
  return std::to_string(found->outputs) + " out, " + std::to_string(found->inputs) + " in";
}

// PPO 1 to 4 of a module with ident 7531h: 12, 20, 4 and 12 bytes (BU 0020 7.2); of 0BA8h: 12, 16, 4 and 8
// (BU 0220 8.2, P182).
TEST(ConfigurationBytes, OfNordModules) {
  EXPECT_EQ("12 out, 12 in", lengths("F3 F1"));
  EXPECT_EQ("20 out, 20 in", lengths("F3 F5"));
  EXPECT_EQ("4 out, 4 in", lengths("F1"));
  EXPECT_EQ("12 out, 12 in", lengths("F5"));
  EXPECT_EQ("16 out, 16 in", lengths("F7"));
  EXPECT_EQ("8 out, 8 in", lengths("F3"));
}

// Slot 1 of 0BA8h holds the module's own I/O byte (30) or nothing (00); slots 2 to 5 the inverters.
TEST(ConfigurationBytes, OfModularSlaves) {
  EXPECT_EQ("12 out, 12 in", lengths("00 F5"));
  EXPECT_EQ("13 out, 13 in", lengths("30 F5"));
  EXPECT_EQ("29 out, 29 in", lengths("30 F7 F1 00 F3"));
}

// Compact inputs only, outputs only (captured: 21 is two output bytes), and the special format with lengths of its own.
TEST(ConfigurationBytes, OfOtherSlaves) {
  EXPECT_EQ("2 out, 0 in", lengths("21"));
  EXPECT_EQ("0 out, 1 in", lengths("10"));
  EXPECT_EQ("0 out, 32 in", lengths("5F"));
  EXPECT_EQ("0 out, 4 in", lengths("40 03"));
  EXPECT_EQ("8 out, 0 in", lengths("80 C3"));
  EXPECT_EQ("2 out, 3 in", lengths("C2 01 02 AA BB"));
  EXPECT_EQ("1 out, 1 in", lengths("CF 00 00"));
  EXPECT_EQ("0 out, 0 in", lengths("02 AA BB"));
  EXPECT_EQ("0 out, 0 in", lengths(""));
}

TEST(ConfigurationBytes, ThatEndTooSoon) {
  EXPECT_EQ("broken", lengths("40"));
  EXPECT_EQ("broken", lengths("C0 01"));
  EXPECT_EQ("broken", lengths("F3 02 AA"));
}

}  // namespace
}  // namespace nord_driver::profibus
