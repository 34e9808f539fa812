#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "tools/command_line.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A program of two commands with every kind of value.
class CommandLineTest : public ::testing::Test {
 protected:
  CommandLineTest() {
    namespace po = boost::program_options;
    line_.addOptions()("config", po::value(&files_)->required(), "files")("device", po::value(&device_), "a device")(
        "timeout", po::value(&timeout_), "a time");
    show_.arguments.push_back({"DRIVE", "whose", &drive_});
    change_.arguments = {{"DRIVE", "whose", &drive_}, {"VALUE", "which", &value_}};
    change_.options.add_options()("set", po::value(&set_), "of which set")("raw", po::bool_switch(&raw_), "as it is");
  }
  std::optional<int> parse(std::vector<const char*> words) {
    words.insert(words.begin(), "tool");
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const auto code = line_.parse(static_cast<int>(words.size()), words.data());
    output_ = ::testing::internal::GetCapturedStdout();
    errors_ = ::testing::internal::GetCapturedStderr();
    return code;
  }
  std::string refusal(const std::vector<const char*>& words) {
    EXPECT_EQ(kWrongUsage, parse(words));
    EXPECT_THAT(output_, IsEmpty());
    const std::size_t end = errors_.find("\nRun with --help for more information.\n");
    EXPECT_NE(std::string::npos, end) << errors_;
    return errors_.substr(0, end);
  }

  CommandLine line_{"tool", "1.2.3", "What it is.", "What else there is."};
  Command& show_ = line_.addCommand("show", "show a drive");
  Command& change_ = line_.addCommand("change", "change a drive");
  std::vector<std::string> files_;
  std::string device_;
  Seconds timeout_{5.0};
  std::string drive_;
  std::string value_;
  WholeNumber<1, 4> set_;
  bool raw_ = false;
  std::string output_;
  std::string errors_;
};

TEST_F(CommandLineTest, OptionsStandBeforeAndAfterTheCommand) {
  EXPECT_EQ(std::nullopt,
            parse({"--config", "a", "change", "--set", "2", "left", "--timeout=0.5", "7", "--raw", "--config", "b"}));
  EXPECT_TRUE(line_.asksFor(change_));
  EXPECT_FALSE(line_.asksFor(show_));
  EXPECT_THAT(files_, ElementsAre("a", "b"));
  EXPECT_EQ("left", drive_);
  EXPECT_EQ("7", value_);
  EXPECT_EQ(2, set_.value);
  EXPECT_TRUE(raw_);
  EXPECT_EQ(0.5, timeout_.value);
}

TEST_F(CommandLineTest, WhatIsNotGivenStaysAsItWas) {
  EXPECT_EQ(std::nullopt, parse({"--config", "a", "show", "left"}));
  EXPECT_EQ(5.0, timeout_.value);
  EXPECT_EQ(0, set_.value);
  EXPECT_EQ("", device_);
  EXPECT_FALSE(raw_);
}

// P513 may be -0.1.
TEST_F(CommandLineTest, ANegativeNumberIsNoOption) {
  EXPECT_EQ(std::nullopt, parse({"--config", "a", "change", "left", "-0.1"}));
  EXPECT_EQ("-0.1", value_);
  EXPECT_EQ("--timeout: -1 is not valid, expected more than 0 s",
            refusal({"--config", "a", "--timeout", "-1", "show", "left"}));
}

TEST_F(CommandLineTest, HelpAndVersionNeedNothingElse) {
  EXPECT_EQ(kDone, parse({"--version"}));
  EXPECT_EQ("tool 1.2.3\n", output_);
  for (const char* const help : {"--help", "-h"}) {
    EXPECT_EQ(kDone, parse({help}));
    EXPECT_THAT(output_, StartsWith("What it is.\nUsage: tool [OPTIONS] COMMAND\n"));
    EXPECT_THAT(output_, HasSubstr("  change      change a drive\n"));
    EXPECT_THAT(output_, HasSubstr("What else there is.\n"));
  }
  EXPECT_EQ(kDone, parse({"change", "--help"}));
  EXPECT_THAT(output_, StartsWith("change a drive\nUsage: tool change [OPTIONS] DRIVE VALUE\n"));
  EXPECT_THAT(output_, HasSubstr("--set"));
}

TEST_F(CommandLineTest, NamesWhatIsWrongWithAValue) {
  EXPECT_EQ("--set: 5 is not valid, expected a whole number from 1 to 4",
            refusal({"--config", "a", "change", "left", "1", "--set", "5"}));
  EXPECT_EQ("--set: 2x is not valid, expected a whole number from 1 to 4",
            refusal({"--config", "a", "change", "left", "1", "--set", "2x"}));
  EXPECT_EQ("--timeout: nan is not valid, expected more than 0 s",
            refusal({"--config", "a", "--timeout", "nan", "show", "left"}));
  EXPECT_EQ("--timeout: 1e10 is not valid, expected at most 1000000000 s",
            refusal({"--config", "a", "--timeout", "1e10", "show", "left"}));
}

TEST_F(CommandLineTest, NamesWhatIsMissing) {
  EXPECT_EQ("a command is missing, expected one of show, change", refusal({"--config", "a"}));
  EXPECT_EQ("VALUE is missing, expected: tool change [OPTIONS] DRIVE VALUE",
            refusal({"--config", "a", "change", "left"}));
  EXPECT_EQ("the option '--config' is required but missing", refusal({"show", "left"}));
  EXPECT_EQ("the required argument for option '--device' is missing",
            refusal({"--config", "a", "show", "left", "--device"}));
}

// Whatever is wrong besides: an option of a command there is not, or --config that has no value yet.
TEST_F(CommandLineTest, AnUnknownCommandIsToldBeforeItsOptions) {
  constexpr const char* kUnknown = "\"turn\" is no command, expected one of show, change";
  EXPECT_EQ(kUnknown, refusal({"turn"}));
  EXPECT_EQ(kUnknown, refusal({"turn", "--far", "3"}));
  EXPECT_EQ(kUnknown, refusal({"--device", "show", "turn", "--config"}));
  EXPECT_EQ("unrecognised option '--far'", refusal({"show", "--far", "3"}));
}

// An option of another command, an abbreviation and a short option are not known either.
TEST_F(CommandLineTest, ACommandMayTakeAsManyWordsAsThereAre) {
  std::vector<std::string> drives;
  Command& look = line_.addCommand("look", "look at drives");
  look.more = {"DRIVE", "which of them", &drives};
  EXPECT_EQ(std::nullopt, parse({"--config", "a", "look", "left", "--timeout", "2", "right"}));
  EXPECT_TRUE(line_.asksFor(look));
  EXPECT_THAT(drives, ElementsAre("left", "right"));
  EXPECT_EQ(std::nullopt, parse({"--config", "a", "look"}));
  EXPECT_THAT(drives, IsEmpty());
  EXPECT_EQ(kDone, parse({"look", "--help"}));
  EXPECT_THAT(output_, HasSubstr("Usage: tool look [OPTIONS] [DRIVE ...]\n\n  DRIVE       which of them\n\n"));
}

TEST_F(CommandLineTest, NamesWhatIsTooMuch) {
  EXPECT_EQ("\"turn\" is no command, expected one of show, change", refusal({"--config", "a", "turn"}));
  EXPECT_EQ("\"x\" is too much, expected: tool show [OPTIONS] DRIVE", refusal({"--config", "a", "show", "left", "x"}));
  EXPECT_EQ("unrecognised option '--set'", refusal({"--config", "a", "show", "left", "--set", "1"}));
  EXPECT_EQ("unrecognised option '--conf'", refusal({"--conf", "a", "show", "left"}));
  EXPECT_EQ("unrecognised option '-s'", refusal({"--config", "a", "change", "left", "1", "-s", "1"}));
  EXPECT_EQ("option '--device' cannot be specified more than once",
            refusal({"--config", "a", "--device", "b", "--device", "c", "show", "left"}));
}

}  // namespace
}  // namespace nord_driver::tools
