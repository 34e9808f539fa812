// What nord_param can refuse before it touches the bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue/shipped.h"
#include "tools/param_commands.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;

const catalogue::DriveCatalogue& known() {
  static const catalogue::DriveCatalogue kKnown{catalogue::shippedCatalogues(), profile::Series::kSk5xxe, {}};
  return kKnown;
}

WriteOptions write(const std::string& value, bool raw = false) {
  WriteOptions made;
  made.value = value;
  made.raw = raw;
  return made;
}

std::int32_t checked(const std::string& name, const WriteOptions& wanted) {
  return checkedWrite(wanted, findParameter(name, known()), known()).request.raw;
}

// The set and the element are in the name or in an option, not two different ones.
TEST(ParamCommands, TakesSetAndIndexFromNameOrOption) {
  EXPECT_EQ(2, addressOf("P510", 0, 2, known()).index);
  EXPECT_EQ(2, addressOf("P510[-02]", 0, 0, known()).index);
  EXPECT_EQ(2, addressOf("P510[-02]", 0, 2, known()).index);
  EXPECT_EQ(3, addressOf("P102", 3, 0, known()).parameter_set);
  EXPECT_THROW(addressOf("P510[-02]", 0, 1, known()), UsageError);
}

TEST(ParamCommands, ChecksAValueAgainstTheCatalogue) {
  EXPECT_EQ(250, checked("P102", write("2.5")));
  EXPECT_EQ(250, checked("Acceleration time", write("2.5 s")));
  EXPECT_EQ(250, checked("P102", write("250", true)));
  EXPECT_EQ(-1, checked("P513", write("-1", true)));
  EXPECT_THROW(checked("P513", write("-0.2")), Trouble);
  EXPECT_THROW(checked("P513", write("-2", true)), Trouble);
  EXPECT_THROW(checked("P102", write("fast")), UsageError);
  EXPECT_THROW(checked("P102", write("2.5", true)), UsageError) << "a raw value is a whole number";
}

TEST(ParamCommands, TakesTheNameOfAValue) {
  EXPECT_EQ(4, checked("P509", write("PROFIBUS")));
  EXPECT_EQ(4, checked("Source control word", write("4 profibus")));
  EXPECT_THROW(checked("P509", write("PROFIBAS")), UsageError);
}

// Without a unit nobody knows what a value means: raw, and only when it is said so.
TEST(ParamCommands, WritesWhatTheCatalogueDoesNotKnowOnlyRaw) {
  EXPECT_THROW(checked("P210", write("1")), UsageError);
  EXPECT_EQ(1, checked("P210", write("1", true)));
  EXPECT_THROW(checked("P210", write("5000000000", true)), Trouble);
}

TEST(ParamCommands, WritesAQuantityOfUnknownUnitOnlyRaw) {
  EXPECT_EQ(200, checked("P103", write("2")));
  try {
    checked("P426", write("0.1"));
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_STREQ("P426 Quick stop time: its unit is not known, write the raw value with --raw", error.what());
  }
  EXPECT_EQ(10, checked("P426", write("10", true)));
}

// Whatever is typed: the drive is not asked.
TEST(ParamCommands, RefusesWhatIsNotToBeWritten) {
  for (const char* name : {"P707", "P152", "P970"}) {
    EXPECT_THROW(checked(name, write("1")), Trouble) << name;
    EXPECT_THROW(checked(name, write("1", true)), Trouble) << name;
  }
}

}  // namespace
}  // namespace nord_driver::tools
