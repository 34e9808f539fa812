#include <gtest/gtest.h>

#include "config/nearest_name.h"

namespace nord_driver {
namespace {

TEST(NearestName, IsTheOneWithTheFewestChanges) {
  EXPECT_EQ("device", nearestName("devcie", {"divide", "device", "ice"}));
  EXPECT_EQ("ab", nearestName("abcd", {"ab"})) << "two changes are a slip of a short name";
  EXPECT_EQ("", nearestName("abcde", {"ab"})) << "three are not";
  EXPECT_EQ("abcdef", nearestName("abcdefghi", {"abcdef"})) << "but a third of a long one is";
  EXPECT_EQ("", nearestName("device", {}));
}

TEST(EditDistance, CountsSingleCharacterChanges) {
  EXPECT_EQ(0u, editDistance("", ""));
  EXPECT_EQ(3u, editDistance("", "abc"));
  EXPECT_EQ(3u, editDistance("abc", ""));
  EXPECT_EQ(0u, editDistance("watchdog", "watchdog"));
  EXPECT_EQ(1u, editDistance("watchdg", "watchdog"));
  EXPECT_EQ(1u, editDistance("watchdog", "watchdogs"));
  EXPECT_EQ(1u, editDistance("watchdog", "watchdig"));
  EXPECT_EQ(3u, editDistance("kitten", "sitting"));
  EXPECT_EQ(2u, editDistance("ab", "ba"));
}

}  // namespace
}  // namespace nord_driver
