#include <gtest/gtest.h>

#include "core/text.h"

namespace nord_driver {
namespace {

TEST(Text, IsTrimmedAtBothEnds) {
  EXPECT_EQ("a b", trimmed(" \t a b\r\n"));
  EXPECT_EQ("", trimmed(" \v\f "));
  EXPECT_EQ("", trimmed(""));
}

TEST(Text, LettersOnlyBecomeSmall) {
  EXPECT_EQ("[1018sub1] \xC4", lowerCase("[1018Sub1] \xC4"));
}

TEST(Text, BeginsBehindTheByteOrderMark) {
  EXPECT_EQ(3u, textBegin("\xEF\xBB\xBF[FileInfo]"));
  EXPECT_EQ(0u, textBegin("[FileInfo]"));
  EXPECT_EQ(0u, textBegin(""));
}

}  // namespace
}  // namespace nord_driver
