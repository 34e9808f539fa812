#include <gmock/gmock.h>

#include <vector>

#include "core/node_arguments.h"
#include "core/version.h"

namespace nord_driver {
namespace {

std::optional<ProgramAnswer> answer(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "/path/to/node");
  ProgramText text;
  text.name = "some_node";
  text.version = kVersion;
  text.about = "It is one.";
  text.options = commonOptions();
  text.footer = "Exit code: 0.";
  return answerArguments(static_cast<int>(arguments.size()), arguments.data(), text);
}

// What roslaunch adds is ROS's own affair.
TEST(NodeArguments, OfRosLetTheNodeRun) {
  EXPECT_FALSE(answer({}));
  EXPECT_FALSE(answer({"__name:=left_robot", "__log:=/tmp/x.log", "cmd_vel:=/twist", "_cycle_rate:=50"}));
}

// Help and version need no master and no configuration, wherever they stand.
TEST(NodeArguments, HelpAndVersionAreAnswered) {
  for (const char* word : {"--help", "-h"}) {
    const auto help = answer({"__name:=x", word});
    ASSERT_TRUE(help) << word;
    EXPECT_EQ(help->output,
              "It is one.\n  some_node [--help] [--version] [--manual-page] [--bash-completion] [NAME:=VALUE ...]\n"
              "Exit code: 0.\n");
    EXPECT_EQ(help->error, "");
    EXPECT_EQ(help->exit_code, 0);
  }
  const auto version = answer({"--version"});
  ASSERT_TRUE(version);
  EXPECT_EQ(version->output, std::string("some_node ") + kVersion + "\n");
  EXPECT_EQ(version->exit_code, 0);
}

// nord_driver_node my_robot.yaml would run without that file and complain of a missing key.
TEST(NodeArguments, UnknownOnesAreRefusedByName) {
  for (const char* word : {"my_robot.yaml", "--config", ""}) {
    const auto refused = answer({word});
    ASSERT_TRUE(refused) << word;
    EXPECT_EQ(refused->output, "");
    EXPECT_THAT(refused->error, testing::HasSubstr("some_node: \"" + std::string(word) + "\" is not known, expected"));
    EXPECT_EQ(refused->exit_code, 2);
  }
}

}  // namespace
}  // namespace nord_driver
