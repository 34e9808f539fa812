// ~<drive>/dump_parameters and verify_parameters: what they find, and that nobody waits for them.
#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <string>

#include "nord_driver/DumpParameters.h"
#include "nord_driver/ReadParameter.h"
#include "nord_driver/VerifyParameters.h"
#include "nord_driver/WriteParameter.h"
#include "rostest/robot_under_test.h"
#include "support/temporary_folder.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Dumped : Answer {
  std::string yaml;
};
struct Verified : Answer {
  std::vector<std::string> differences;
};

Dumped dump(const std::string& drive) {
  DumpParameters service;
  Dumped result;
  static_cast<Answer&>(result) = callService("nord_driver/" + drive + "/dump_parameters", service);
  result.yaml = service.response.yaml;
  return result;
}

Verified verify(const std::string& drive, const std::string& yaml, const std::string& file = {}) {
  VerifyParameters service;
  service.request.yaml = yaml;
  service.request.file = file;
  Verified result;
  static_cast<Answer&>(result) = callService("nord_driver/" + drive + "/verify_parameters", service);
  result.differences = service.response.differences;
  return result;
}

// P102 of set 2, in the RAM.
Answer writeRamp(double seconds) {
  WriteParameter service;
  service.request.number = 102;
  service.request.parameter_set = 2;
  service.request.value = seconds;
  return callService("nord_driver/left/write_parameter", service);
}

constexpr char kNothing[] = "{series: sk5xxe, settings: {}}";
constexpr char kBusy[] = "drive left: its parameters are being dumped or verified already: ask again";

/// A verification that only looks whether the drive is busy may be there first, and has soon ended.
Dumped dumpOnceItMay(const std::string& drive) {
  Dumped result;
  do {
    result = dump(drive);
  } while (result.message == kBusy);
  return result;
}

class ParameterDump : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
};

TEST_F(ParameterDump, IsVerifiedAndShowsExactlyWhatWasChanged) {
  const Dumped taken = dump("left");
  ASSERT_TRUE(taken.success) << taken;
  EXPECT_THAT(taken.yaml, AllOf(HasSubstr("# What nord_param read from drive left, "), HasSubstr("\nseries: sk5xxe\n"),
                                HasSubstr("\n  \"P102 set 2\": {raw: 50, ")));
  EXPECT_THAT(taken.message, HasSubstr(" values of drive left were read"));
  const Verified same = verify("left", taken.yaml);
  EXPECT_TRUE(same.success) << same;
  EXPECT_THAT(same.differences, IsEmpty());

  ASSERT_TRUE(writeRamp(1.5).success);
  const TemporaryFolder folder;
  folder.write("left.yaml", taken.yaml);
  const Verified changed = verify("left", "", folder.path("left.yaml"));
  EXPECT_FALSE(changed.success);
  EXPECT_THAT(changed.message, AllOf(HasSubstr("1 of "), HasSubstr(" settings differ")));
  EXPECT_THAT(changed.differences,
              ElementsAre("P102 set 2 Acceleration time: 0.50 s in the file, 1.50 s in the drive"));
  ASSERT_TRUE(writeRamp(0.5).success);
}

TEST_F(ParameterDump, KeepsNeitherTheBaseNorOtherServicesWaiting) {
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.2));
  // One after the other, so that one is under way all the time.
  std::atomic<bool> enough{false};
  std::future<Dumped> running = std::async(std::launch::async, [&enough] {
    Dumped last = dumpOnceItMay("left");
    while (last.success && !enough) last = dumpOnceItMay("left");
    return last;
  });
  ASSERT_TRUE(eventually([] { return verify("left", kNothing).message == kBusy; }));
  robot().drive(0.4);
  EXPECT_TRUE(robot().waitForTrueSpeed(0.35)) << "cmd_vel is followed";
  for (const char* drive : {"left", "right"}) {
    EXPECT_TRUE(robot().readParameter(drive, 105).success) << drive << " answers within service_timeout";
  }
  EXPECT_TRUE(robot().enable(false).success);
  enough = true;
  const Dumped taken = running.get();
  EXPECT_TRUE(taken.success) << taken;
  EXPECT_FALSE(taken.yaml.empty());
}

TEST_F(ParameterDump, EndsWithWordsWhenItsDriveGoesOffline) {
  std::future<Dumped> running = std::async(std::launch::async, [] { return dumpOnceItMay("left"); });
  ASSERT_TRUE(eventually([] { return verify("left", kNothing).message == kBusy; }));
  ASSERT_TRUE(robot().simulator("left/unplug", true).success);
  const Dumped taken = running.get();
  EXPECT_FALSE(taken.success);
  EXPECT_THAT(taken.message, HasSubstr("drive left"));
  EXPECT_TRUE(taken.yaml.empty());
  EXPECT_FALSE(dump("left").success);
  ASSERT_TRUE(robot().simulator("left/unplug", false).success);
  ASSERT_TRUE(robot().waitForDrivesOnline());
  EXPECT_TRUE(eventually([] { return dump("left").success; }));
}

TEST_F(ParameterDump, IsRefusedInWordsWhereItIsNone) {
  EXPECT_EQ("neither yaml nor file is given, expected one of them", verify("left", "").message);
  EXPECT_EQ("yaml and file are given, expected one of them", verify("left", "a", "/b").message);
  EXPECT_THAT(verify("left", "", "left.yaml").message, HasSubstr("expected an absolute path"));
  EXPECT_THAT(verify("left", "", "/is/not/there.yaml").message, HasSubstr("there is no such file"));
  EXPECT_THAT(verify("left", "", "/dev/zero").message, HasSubstr("it is no ordinary file"));
  EXPECT_THAT(verify("left", "drives: {}").message, HasSubstr("the text in yaml is no dump of nord_param"));
  EXPECT_EQ("the dump has no settings to compare", verify("left", kNothing).message);
  EXPECT_THAT(verify("left", "{series: sk300e, settings: {P102: {raw: 1}}}").message,
              HasSubstr("the dump is of a sk300e"));
}

}  // namespace
}  // namespace nord_driver::test
