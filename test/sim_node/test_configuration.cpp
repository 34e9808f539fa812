#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

struct End {
  int exit_code = -1;
  std::string words;  // stdout and stderr
};

End run(const std::string& arguments) {
  const std::string command = std::string(NORD_SIM_NODE_PROGRAM) + " " + arguments + " 2>&1";
  End end;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return end;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) end.words += part.data();
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

/// The node with these parameters, which it is expected to refuse.
End runWith(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  ros::param::del("/wrong");
  ros::param::set("/wrong/bus/device", "/dev/null");
  ros::param::set("/wrong/drives/left/address", 3);
  ros::param::set("/wrong/" + key, value);
  return run("__name:=wrong");
}

// --version needs no master and no configuration.
TEST(Configuration, Version) {
  const End end = run("--version");
  EXPECT_EQ(0, end.exit_code);
  EXPECT_THAT(end.words, testing::MatchesRegex("nord_sim_node [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

// Nor does --help; and what looks like a configuration file is not silently passed over.
TEST(Configuration, Usage) {
  const End help = run("--help");
  EXPECT_EQ(0, help.exit_code);
  EXPECT_THAT(help.words, testing::HasSubstr("nord_sim_node [--help]"));
  const End unknown = run("config/demo.yaml");
  EXPECT_EQ(2, unknown.exit_code);
  EXPECT_THAT(unknown.words, testing::HasSubstr("nord_sim_node: \"config/demo.yaml\" is not known, expected --help"));
}

// A wrong configuration ends the node with a sentence that names key, value and what was expected.
TEST(Configuration, RefusesInWords) {
  const struct {
    const char* key;
    XmlRpc::XmlRpcValue value;
    const char* words;
  } rows[] = {
      {"drives/left/address", 127, "drives/left/address: 127 is not valid; expected a whole number from 1 to 126"},
      {"drives/left/gear_ratio", -2.0, "drives/left/gear_ratio: -2 is not valid; expected a number greater than 0"},
      {"drives/left/ram_orders", "perhaps", "drives/left/ram_orders: perhaps is not valid; expected true or false"},
      {"drives/left/parameters/P513", 2000.0,
       "drives/left/parameters/P513: 2000 is not valid; expected a number from -0.1 to 100"},
      {"drives/right/joint", "r", "drives/right/address is missing; expected a whole number from 1 to 126"},
      {"bus/baud_rate", 300, "bus/baud_rate: 300 is not valid; expected a whole number from 9600 to 12000000"},
      {"body/left", "left", "body/right is missing; a body has left, right, wheel_radius, wheel_separation"},
      // /dev/null is there already, and no link.
      {"drives/left/joint", "l",
       "bus/device: /dev/null exists and is no symbolic link; expected a path where the simulator may put one"},
  };
  for (const auto& row : rows) {
    const End end = runWith(row.key, row.value);
    EXPECT_EQ(1, end.exit_code) << end.words;
    EXPECT_THAT(end.words, testing::HasSubstr(row.words));
  }
}

// Nothing configured at all is refused, too.
TEST(Configuration, RefusesNothing) {
  const End end = run("__name:=empty");
  EXPECT_EQ(1, end.exit_code);
  EXPECT_THAT(end.words, testing::HasSubstr("drives: nothing is configured; expected a group with at least one drive"));
}

}  // namespace
}  // namespace nord_driver::sim_node
