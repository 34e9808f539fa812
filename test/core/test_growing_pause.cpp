#include <gtest/gtest.h>

#include "core/growing_pause.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

TEST(GrowingPause, DoublesUpToItsLimit) {
  GrowingPause pause{milliseconds{250}, milliseconds{800}};
  EXPECT_EQ(milliseconds{250}, pause.next());
  EXPECT_EQ(milliseconds{500}, pause.next());
  EXPECT_EQ(milliseconds{800}, pause.next());
  EXPECT_EQ(milliseconds{800}, pause.next());
  pause.reset();
  EXPECT_EQ(milliseconds{250}, pause.next());
}

}  // namespace
}  // namespace nord_driver
