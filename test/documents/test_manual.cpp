// What a shell and man(1) know of the programs: made from the same tables as --help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "nord_driver/profile/series.h"
#include "tools/program.h"

namespace nord_driver::documents {
namespace {

using test::Ended;
using test::runProgram;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::UnorderedElementsAreArray;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

const fs::path kSource{NORD_DRIVER_SOURCE_DIR};
const fs::path kManual{NORD_DRIVER_MANUAL_DIR};

std::string pathOf(const std::string& program) {
  return std::string{NORD_DRIVER_PROGRAM_DIR} + "/" + program;
}

/// What bash offers for the last of `words`; the line is split as bash splits it.
Words offered(const std::string& program, const Words& words, const std::string& environment = {}) {
  std::string line = "'" + program + "'";
  for (const std::string& word : words) line += " '" + word + "'";
  const Ended bash = runProgram(
      {"/bin/bash", "-c",
       environment + " source " + (kManual / program).string() + "; compopt() { :; }; COMP_WORDS=(" + line +
           "); COMP_CWORD=" + std::to_string(words.size()) + "; _" + program + "; printf '%s\\n' \"${COMPREPLY[@]}\""});
  EXPECT_EQ("", bash.errors);
  std::istringstream lines{bash.output};
  Words found;
  for (std::string word; std::getline(lines, word);) {
    if (!word.empty()) found.push_back(word);
  }
  return found;
}

Words found(const std::string& text, const std::string& pattern) {
  const std::regex expression{pattern};
  Words all;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), expression); at != std::sregex_iterator{}; ++at) {
    if (std::find(all.begin(), all.end(), (*at)[1].str()) == all.end()) all.push_back((*at)[1].str());
  }
  return all;
}

std::string helpOf(const Words& command) {
  const Ended help = runProgram(command);
  EXPECT_EQ(0, help.code) << help.errors;
  return help.output;
}

/// The options at the beginning of a line of --help, or in the brackets of a node's.
Words optionsIn(const std::string& help) {
  return found(help, "(?:\\n  |\\[)(--[a-z-]+)");
}

Words commandsIn(const std::string& help) {
  const std::size_t at = help.find("\nCommands (");
  const std::string list = at == std::string::npos ? "" : help.substr(help.find('\n', at + 1));
  return found(list.substr(0, list.find("\n\n")), "\\n  ([a-z][a-z-]*) ");
}

class EveryProgram : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Manual, EveryProgram,
                         ::testing::Values("nord_driver_node", "nord_sim_node", "nord_sim", "nord_param"),
                         [](const auto& program) { return std::string{program.param}; });

TEST_P(EveryProgram, HasEveryOptionOfItsHelpCompleted) {
  const Words options = optionsIn(helpOf({pathOf(GetParam()), "--help"}));
  EXPECT_THAT(options, IsSupersetOf({"--help", "--version", "--manual-page", "--bash-completion"}));
  EXPECT_THAT(offered(GetParam(), {"--"}), IsSupersetOf(options));
  EXPECT_THAT(offered(GetParam(), {"--vers"}), ::testing::ElementsAre("--version"));
}

TEST_P(EveryProgram, HasAManualPageThatNamesEveryOption) {
  const std::string page = (kManual / (std::string{GetParam()} + ".1")).string();
  const Ended man =
      runProgram({"/bin/bash", "-c", "MANPAGER=cat MANWIDTH=100 LC_ALL=C.UTF-8 man --warnings -l " + page});
  if (man.code == 127) GTEST_SKIP() << "man is not installed (man-db)";
  EXPECT_EQ(0, man.code);
  EXPECT_EQ("", man.errors);
  EXPECT_THAT(man.output, HasSubstr("NAME\n       " + std::string{GetParam()} + " - "));
  for (const std::string& option : optionsIn(helpOf({pathOf(GetParam()), "--help"}))) {
    EXPECT_THAT(man.output, HasSubstr("\n       " + option));
  }
}

TEST(Completion, OffersTheCommandsOfNordParamAndTheirOptions) {
  const Words commands = commandsIn(helpOf({pathOf("nord_param"), "--help"}));
  EXPECT_THAT(commands, IsSupersetOf({"list", "read", "write", "dump", "compare"}));
  EXPECT_THAT(offered("nord_param", {"--config", "robot.yaml", ""}), IsSupersetOf(commands));
  std::ifstream page{kManual / "nord_param.1"};
  const std::string manual{std::istreambuf_iterator<char>(page), std::istreambuf_iterator<char>()};
  for (const std::string& command : commands) {
    EXPECT_THAT(offered("nord_param", {command, "--"}),
                UnorderedElementsAreArray(optionsIn(helpOf({pathOf("nord_param"), command, "--help"}))))
        << command;
    EXPECT_THAT(manual, HasSubstr("\n.SS " + std::regex_replace(command, std::regex{"-"}, R"(\-)")));
  }
  EXPECT_THAT(offered("nord_param", {"read", "--set", ""}), ::testing::ElementsAre("1", "2", "3", "4"));
}

// What nord_driver_plugins.xml declares, and what the series are called.
TEST(Completion, OffersTransportsAndSeries) {
  std::ifstream file{kSource / "nord_driver_plugins.xml"};
  const std::string declared{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const Words transports = found(declared, "class name=\"nord_driver/([a-z_]+)\"");
  EXPECT_THAT(transports, Contains("canopen"));
  EXPECT_THAT(offered("nord_driver_node", {"_transport", ":="}), UnorderedElementsAreArray(transports));
  EXPECT_THAT(offered("nord_sim_node", {"_transport", ":="}), UnorderedElementsAreArray(transports));
  EXPECT_THAT(offered("nord_driver_node", {"_transport", ":=", "can"}), ::testing::ElementsAre("canopen"));
  Words series;
  for (const profile::Series known : profile::kAllSeries) series.emplace_back(profile::toString(known));
  EXPECT_THAT(offered("nord_driver_node", {"_drives/left/series", ":="}), UnorderedElementsAreArray(series));
}

TEST(Completion, OffersFilesAndTheTemplatesOfThePackage) {
  std::string name = (fs::temp_directory_path() / "nord_completion.XXXXXX").string();
  ASSERT_NE(nullptr, mkdtemp(name.data()));
  const fs::path folder{name};
  fs::create_directory(folder / "share");
  fs::create_directory_symlink(kSource, folder / "share" / "nord_driver");
  std::ofstream{folder / "my robot.yaml"} << "drives: {}\n";
  const std::string in_folder = "cd " + folder.string() + "; export CMAKE_PREFIX_PATH=" + folder.string() + ";";
  const Words files = offered("nord_param", {"--config", ""}, in_folder);
  EXPECT_THAT(files, Contains("my robot.yaml"));
  std::size_t templates = 0;
  for (const auto& entry : fs::directory_iterator{kSource / "config" / "templates"}) {
    if (entry.path().extension() != ".yaml") continue;
    ++templates;
    EXPECT_THAT(files,
                Contains(folder.string() + "/share/nord_driver/config/templates/" + entry.path().filename().string()));
  }
  EXPECT_GT(templates, 3u);
  EXPECT_THAT(offered("nord_sim", {"--config", "my"}, in_folder), ::testing::ElementsAre("my robot.yaml"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace nord_driver::documents
