// What 100 % are in the picture of a drive.
#include <gtest/gtest.h>

#include "tools/linked_drive.h"
#include "tools/scope_scale.h"

namespace nord_driver::tools {
namespace {

std::optional<double> scaleOf(LinkedDrive& drive, std::optional<double> typed) {
  drive.connect();
  ScopeRecord record;
  readScale(drive.link(), typed, false, record);
  return record.max_frequency;
}

TEST(ScopeScale, IsWhatWasTypedInWhereP105CannotBeRead) {
  LinkedDrive without{{}, true, 3}, typed{{}, true, 3};  // PPO 3 carries no parameters
  EXPECT_EQ(std::nullopt, scaleOf(without, std::nullopt));
  EXPECT_EQ(60.0, scaleOf(typed, 60.0));
}

TEST(ScopeScale, IsP105AsTheDriveHasIt) {
  LinkedDrive untyped, typed;
  EXPECT_EQ(50.0, scaleOf(untyped, std::nullopt));
  EXPECT_EQ(50.0, scaleOf(typed, 60.0));
}

}  // namespace
}  // namespace nord_driver::tools
