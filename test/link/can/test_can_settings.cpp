#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/can_settings.h"

namespace nord_driver::link {
namespace {

using ::testing::HasSubstr;

CanSettings named(const std::string& interface) {
  CanSettings settings;
  settings.interface = interface;
  return settings;
}

std::string problemOf(const CanSettings& settings) {
  Sentence reason;
  const bool good = checkCanSettings(settings, reason);
  EXPECT_EQ(good, reason.empty());
  return reason.str();
}

// IFNAMSIZ is 16 with the closing zero; the kernel's dev_valid_name() takes neither '/', ':' nor white space.
TEST(CanSettings, AnInterfaceNameIsOneTheKernelCouldHave) {
  for (const char* name : {"can0", "vcan0", "slcan_left.1", "fifteen_letters"}) EXPECT_EQ("", problemOf(named(name)));
  for (const char* name : {"", ".", "..", "can 0", "a/b", "eth0:1", "sixteen_letters_", "virtua:x"}) {
    EXPECT_THAT(problemOf(named(name)), HasSubstr("1 to 15 characters")) << name;
  }
  EXPECT_THAT(problemOf(named("sixteen_letters_")), HasSubstr("'sixteen_letters_'"));
}

TEST(CanSettings, AVirtualBusHasAPlainName) {
  EXPECT_EQ("", problemOf(named("virtual:demo-1_a.b")));
  EXPECT_EQ("", problemOf(named("virtual:" + std::string(64, 'x'))));
  for (const std::string& name : {std::string("virtual:"), std::string("virtual:a b"), std::string("virtual:a/b"),
                                  "virtual:" + std::string(65, 'x'), std::string("virtual:a\0b", 11)}) {
    EXPECT_THAT(problemOf(named(name)), HasSubstr("virtual bus is 1 to 64 letters")) << name;
  }
}

TEST(CanSettings, IdentifiersHaveElevenBitsAndFitIntoTheFilters) {
  CanSettings settings = named("can0");
  settings.ids = {0x7FF};
  EXPECT_EQ("", problemOf(settings));
  settings.ids = {0x800};
  EXPECT_THAT(problemOf(settings), HasSubstr("800h has more than 11 bits"));
  settings.ids.assign(512, 1);
  EXPECT_EQ("", problemOf(settings));
  settings.ids.assign(513, 1);
  EXPECT_THAT(problemOf(settings), HasSubstr("513 identifiers"));
  settings.ids.assign(511, 1);
  settings.remote_ids = {0x732};
  EXPECT_EQ("", problemOf(settings));
  settings.remote_ids = {0x732, 0x733};
  EXPECT_THAT(problemOf(settings), HasSubstr("513 identifiers"));
  settings.ids.assign(1, 1);
  settings.remote_ids = {0x800};
  EXPECT_THAT(problemOf(settings), HasSubstr("800h has more than 11 bits"));
}

}  // namespace
}  // namespace nord_driver::link
