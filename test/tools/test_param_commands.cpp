// What nord_param can refuse before it touches the bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/param_commands.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;

constexpr auto kSeries = profile::Series::kSk5xxe;

WriteOptions write(const std::string& value, bool raw = false) {
  WriteOptions made;
  made.value = value;
  made.raw = raw;
  return made;
}

double checked(const std::string& name, const WriteOptions& wanted) {
  return checkedWrite(wanted, parseParameterName(name), kSeries).value;
}

// The set and the element are in the name or in an option, not two different ones.
TEST(ParamCommands, TakesSetAndIndexFromNameOrOption) {
  EXPECT_EQ(2, addressOf("P510", 0, 2).index);
  EXPECT_EQ(2, addressOf("P510[-02]", 0, 0).index);
  EXPECT_EQ(2, addressOf("P510[-02]", 0, 2).index);
  EXPECT_EQ(3, addressOf("P102", 3, 0).parameter_set);
  EXPECT_THROW(addressOf("P510[-02]", 0, 1), UsageError);
}

TEST(ParamCommands, ChecksAValueAgainstTheCatalogue) {
  EXPECT_DOUBLE_EQ(2.5, checked("P102", write("2.5")));
  EXPECT_DOUBLE_EQ(2.5, checked("P102", write("250", true)));
  EXPECT_DOUBLE_EQ(-0.1, checked("P513", write("-1", true)));
  EXPECT_THROW(checked("P513", write("-0.2")), Trouble);
  EXPECT_THROW(checked("P513", write("-2", true)), Trouble);
  EXPECT_THROW(checked("P102", write("fast")), UsageError);
  EXPECT_THROW(checked("P102", write("2.5", true)), UsageError) << "a raw value is a whole number";
}

// Without a unit nobody knows what a value means: raw, and only when it is said so.
TEST(ParamCommands, WritesWhatTheCatalogueDoesNotKnowOnlyRaw) {
  EXPECT_THROW(checked("P420", write("1")), UsageError);
  EXPECT_DOUBLE_EQ(1.0, checked("P420", write("1", true)));
  EXPECT_THROW(checked("P420", write("5000000000", true)), Trouble);
}

}  // namespace
}  // namespace nord_driver::tools
