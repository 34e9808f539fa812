// Dumps: what is in them, and what a comparison finds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "tools/linked_drive.h"
#include "tools/parameter_dump.h"
#include "tools/parameter_name.h"
#include "tools/restore/scripted_drive.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class InAFile {
 public:
  explicit InAFile(const std::string& text) { std::ofstream(path_) << text; }
  ~InAFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = ::testing::TempDir() + "nord_dump.yaml";
};

std::string refusal(const std::string& text) {
  const InAFile file{text};
  try {
    readDump(file.path());
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

// What is written is what is read: every value, with its set and element.
TEST(ParameterDump, IsReadAsItWasWritten) {
  LinkedDrive drive;
  drive.connect();
  const Dump taken = takeDump(drive.link(), drive.notAsked());
  const std::string text = dumpText(taken, drive.link().known(), "left", "PROFIBUS station 3");
  EXPECT_THAT(text, HasSubstr("# What nord_param read from drive left, PROFIBUS station 3\nseries: sk5xxe\ncount: " +
                              std::to_string(taken.values.size()) + "\nsettings:\n"));
  EXPECT_THAT(text, HasSubstr("  \"P102 set 4\": {raw: 200, value: 2, unit: \"s\", name: \"Acceleration time\"}\n"));
  const InAFile file{text};
  const Dump read = readDump(file.path());
  ASSERT_EQ(taken.values.size(), read.values.size());
  for (std::size_t i = 0; i < read.values.size(); ++i) {
    EXPECT_EQ(parameterName(taken.values[i].address), parameterName(read.values[i].address));
    EXPECT_EQ(taken.values[i].raw, read.values[i].raw);
  }
}

// A disk that was full, a pipe that broke: half a dump is none, wherever it ends.
TEST(ParameterDump, IsNotReadWhereItWasCutOff) {
  LinkedDrive drive;
  drive.connect();
  const std::string text = dumpText(takeDump(drive.link(), drive.notAsked()), drive.link().known(), "left", "here");
  const std::size_t last = text.rfind("  \"P");
  ASSERT_NE(std::string::npos, last);
  for (std::size_t end = text.find('\n') + 1; end <= last; end = text.find('\n', end) + 1) {
    EXPECT_THAT(refusal(text.substr(0, end)), HasSubstr("is no dump of nord_param")) << end;
  }
  EXPECT_THAT(refusal(text.substr(0, last)), HasSubstr("it was cut off"));
  EXPECT_EQ("accepted", refusal("series: sk5xxe\nsettings: {\"P102 set 1\": {raw: 1}}\n")) << "typed by hand";
}

// Not every firmware has every parameter: what is refused is named, the rest goes on.
TEST(ParameterDump, NamesWhatTheInverterDoesNotHave) {
  LinkedDrive drive;
  sim::PkwRefusal refused;
  refused.error = 0;
  refused.number = 506;
  drive.connect();
  drive.left().pkw().refuse(refused);
  const Dump taken = takeDump(drive.link(), drive.notAsked());
  std::vector<std::string> missing;
  for (const auto& address : taken.missing) missing.push_back(parameterName(address));
  EXPECT_THAT(missing, ::testing::IsSupersetOf({"P506"}));
  EXPECT_EQ(1, std::count(missing.begin(), missing.end(), "P506")) << "asked for once, not for each set";
  EXPECT_THAT(missing, ::testing::Not(::testing::Contains("P151"))) << "of a bus module of another kind";
  EXPECT_THAT(dumpText(taken, drive.link().known(), "left", "here"), HasSubstr("# not in this inverter: P506\n"));
}

// Another bus participant blocks the access (BU 2700 6.5.1.1): that does not say that the inverter has no P102.
TEST(ParameterDump, IsNotTakenWhileTheDriveRefusesForTheMoment) {
  LinkedDrive drive;
  sim::PkwRefusal refused;
  refused.error = 103;
  refused.number = 102;
  drive.connect();
  drive.left().pkw().refuse(refused);
  try {
    takeDump(drive.link(), drive.notAsked());
    FAIL() << "a dump without P102";
  } catch (const Trouble& trouble) {
    EXPECT_THAT(trouble.what(), HasSubstr("PKW error 103"));
  }
}

TEST(ParameterDump, AsksAgainWhatIsRefusedForTheMoment) {
  ScriptedDrive drive{{{"P102 set 1", 200}}};
  const std::atomic<bool> not_asked{false};
  drive.blocked["P102 set 1"] = 1;
  const Dump taken = takeDump(drive, not_asked);
  ASSERT_EQ(1u, taken.values.size());
  EXPECT_EQ(200, taken.values[0].raw);
  drive.blocked["P102 set 1"] = 1;
  EXPECT_EQ(1u, readAlike(drive, taken, not_asked).values.size());
  drive.blocked["P102 set 1"] = -1;
  EXPECT_THROW(takeDump(drive, not_asked), Trouble);
  EXPECT_THROW(readAlike(drive, taken, not_asked), Trouble);
}

TEST(ParameterDump, IsNotTakenOfADriveThatFallsSilent) {
  LinkedDrive drive;
  drive.connect();
  drive.left().pkw().setSilent(true);
  EXPECT_THROW(takeDump(drive.link(), drive.notAsked()), Trouble);
  const std::atomic<bool> asked{true};
  EXPECT_THROW(takeDump(drive.link(), asked), Trouble);
}

TEST(ParameterDump, RefusesAFileThatIsNone) {
  EXPECT_THROW(readDump("/is/not/there.yaml"), UsageError);
  EXPECT_THAT(refusal("drives: {}\n"), HasSubstr("is no dump of nord_param: expected the keys series and settings"));
  EXPECT_THAT(refusal("series: sk5xxe\n"), HasSubstr("expected the keys series and settings")) << "cut off";
  EXPECT_THAT(refusal("series: sk9\nsettings:\n"), HasSubstr("series \"sk9\" is not known"));
  EXPECT_THAT(refusal("series: sk5xxe\nsettings: {P1050: {raw: 1}}\n"), HasSubstr("\"P1050\" is no parameter"));
  EXPECT_THAT(refusal("series: sk5xxe\nsettings: {P105: {raw: many}}\n"), HasSubstr("is no dump of nord_param"));
  EXPECT_THAT(refusal("series: sk5xxe\nsettings: {P105: 500}\n"), HasSubstr("is no dump of nord_param"));
}

}  // namespace
}  // namespace nord_driver::tools
