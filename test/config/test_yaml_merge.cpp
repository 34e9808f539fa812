// Merge keys, against what PyYAML makes of the same text: rosparam reads with it, and the node gets what it read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/yaml_merge.h"
#include "config/yaml_settings.h"
#include "config/yaml_tree.h"
#include "support/temporary_folder.h"

namespace nord_driver {
namespace {

using ::testing::ElementsAre;

std::string flow(const YAML::Node& node) {
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  return emitter.c_str();
}

std::string merged(const std::string& text) {
  return flow(withKeysMerged(YAML::Load(text), "a.yaml"));
}

template <typename Step>
std::string refusal(Step step) {
  try {
    step();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusalOf(const std::string& text) {
  return refusal([&] { merged(text); });
}

TEST(YamlMerge, OwnKeysCountWhereverTheMergeKeyStands) {
  EXPECT_EQ("{a: {x: 1, y: 2}, b: {x: 1, y: 3, z: 4}}", merged("a: &a {x: 1, y: 2}\nb: {<<: *a, y: 3, z: 4}"));
  EXPECT_EQ("{a: {x: 1, y: 2}, b: {x: 1, y: 3}}", merged("a: &a {x: 1, y: 2}\nb: {y: 3, <<: *a}"));
  EXPECT_EQ("{b: {x: 1, y: 3}}", merged("b: {<<: {x: 1, y: 2}, y: 3}"));
  EXPECT_EQ("{x: 1, a: {x: 1}}", merged("a: &a {x: 1}\n<<: *a"));
}

TEST(YamlMerge, OfAListTheEarlierCountsAndOfTwoKeysTheLater) {
  const std::string groups = "a: &a {x: 1, y: 2}\nc: &c {y: 5, z: 6}\n";
  const std::string before = "{a: {x: 1, y: 2}, c: {y: 5, z: 6}, b: ";
  EXPECT_EQ(before + "{z: 6, x: 1, y: 2, w: 7}}", merged(groups + "b: {<<: [*a, *c], w: 7}"));
  EXPECT_EQ(before + "{x: 1, y: 5, z: 6}}", merged(groups + "b: {<<: [*c, *a]}"));
  EXPECT_EQ(before + "{x: 1, y: 5, z: 6}}", merged(groups + "b: {<<: *a, <<: *c}"));
  EXPECT_EQ("{b: {y: 3}}", merged("b: {<<: [], y: 3}"));
}

// One level: a group that is there itself takes the place of the whole one of that name.
TEST(YamlMerge, GroupsOfOneNameDoNotBecomeOne) {
  EXPECT_EQ("{a: {g: {x: 1, y: 2}, h: 1}, b: {h: 1, g: {y: 3}}}",
            merged("a: &a {g: {x: 1, y: 2}, h: 1}\nb: {<<: *a, g: {y: 3}}"));
}

TEST(YamlMerge, WhatIsMergedMayMergeItself) {
  EXPECT_EQ("{a: {x: 1, y: 2}, b: {x: 1, y: 3}, c: {x: 1, y: 3, z: 4}}",
            merged("a: &a {x: 1, y: 2}\nb: &b {<<: *a, y: 3}\nc: {<<: *b, z: 4}"));
  EXPECT_EQ("{b: {x: 1, y: 3}}", merged("b: {<<: {<<: {x: 1}, y: 2}, y: 3}"));
  EXPECT_EQ("{l: [{x: 1, y: 2}, 5]}", merged("l: [{<<: {x: 1}, y: 2}, 5]"));
  EXPECT_EQ("{a: {g: {x: 1}}, b: {g: {x: 1}}}", merged("a: &a {g: {<<: {x: 1}}}\nb: {<<: *a}"));
}

// In the group itself both stay, for whoever tells of it.
TEST(YamlMerge, OfAKeyThatStandsTwiceTheLastIsTaken) {
  EXPECT_EQ("{a: {x: 1, x: 2}, b: {x: 2}}", merged("a: &a {x: 1, x: 2}\nb: {<<: *a}"));
}

TEST(YamlMerge, AQuotedKeyIsAnyKey) {
  EXPECT_EQ("{a: {x: 1}, b: {<<: {x: 1}}}", merged("a: &a {x: 1}\nb: {'<<': *a}"));
  EXPECT_EQ("{b: {x: 1}}", merged("b: {!!merge foo: {x: 1}}"));
  EXPECT_FALSE(isMergeKey(YAML::Load("{!!str <<: 5}").begin()->first));
}

// Quoted, a number is a text; after the merge, too.
TEST(YamlMerge, ValuesKeepTheirKind) {
  const YAML::Node root = withKeysMerged(YAML::Load("a: &a {x: '1', y: 1, z: }\nb: {<<: *a}"), "a.yaml");
  EXPECT_EQ("!", root["b"]["x"].Tag());
  EXPECT_EQ("?", root["b"]["y"].Tag());
  EXPECT_TRUE(root["b"]["z"].IsNull());
}

// yaml-cpp's aliases are one node: what is changed behind one name would change behind the other.
TEST(YamlMerge, WhatSharedANodeDoesNotAfterwards) {
  const YAML::Node read = YAML::Load("a: &a {g: {x: 1}}\nb: {<<: *a}\nc: *a");
  YAML::Node root = withKeysMerged(read, "a.yaml");
  root["b"]["g"]["x"] = 5;
  root["c"]["g"]["x"] = 6;
  EXPECT_EQ("{a: {g: {x: 1}}, b: {g: {x: 5}}, c: {g: {x: 6}}}", flow(root));
  EXPECT_TRUE(isMergeKey(read["b"].begin()->first)) << "the file's own tree is as it was";
  EXPECT_EQ(1, read["a"]["g"]["x"].as<int>());
}

TEST(YamlMerge, WhatIsNoGroupIsRefused) {
  const std::string expected = " is not valid, expected a group or a list of groups, whose keys are taken";
  EXPECT_EQ("a.yaml: line 1: <<: \"left\"" + expected, refusalOf("b: {<<: left}"));
  EXPECT_EQ("a.yaml: line 1: <<: nothing" + expected, refusalOf("b: {<<: }"));
  EXPECT_EQ("a.yaml: line 3: <<: \"left\"" + expected, refusalOf("a: &a {x: 1}\nb:\n  <<: [*a, left]"));
  EXPECT_EQ("a.yaml: line 1: <<: a list in the list" + expected, refusalOf("b: {<<: [[{x: 1}]]}"));
  EXPECT_EQ("a.yaml: line 1: <<: \"5\"" + expected, refusalOf("b: {<<: {g: {<<: 5}}, g: 1}")) << "not even taken";
}

// PyYAML takes this for {x: 1}; nobody means it.
TEST(YamlMerge, AGroupThatMergesItselfIsNotWalkable) {
  EXPECT_EQ("it is more than 50 groups and lists deep", whyNotWalkable(YAML::Load("a: &a {<<: *a, x: 1}")));
}

// The way of the programs: several files, each with its own anchors, and the parameter server's reading of values.
TEST(YamlMerge, FilesAreMergedBeforeTheyAreLaidOverEachOther) {
  const test::TemporaryFolder folder;
  folder.write("a.yaml",
               "drives:\n  left: &wheel {address: 3, series: sk5xxe, monitor: [P746]}\n"
               "  right: {<<: *wheel, address: 4}\n");
  folder.write("b.yaml", "common: &common {series: sk2xxe}\ndrives: {right: {<<: *common}}\n");
  folder.write("c.yaml", "drives: {left: {<<: 5}}\n");
  const YAML::Node file = readYamlFiles({folder.path("a.yaml"), folder.path("b.yaml")});
  const YamlSettings right{"drives/right", file["drives"]["right"]};
  EXPECT_THAT(right.keys(), ElementsAre("address", "monitor", "series"));
  EXPECT_EQ(4, right.integer("address"));
  EXPECT_EQ("sk2xxe", right.text("series"));
  EXPECT_EQ("sk5xxe", file["drives"]["left"]["series"].as<std::string>());
  EXPECT_EQ("--config " + folder.path("c.yaml") +
                ": line 1: <<: \"5\" is not valid, expected a group or a list of groups, whose keys are taken",
            refusal([&] { readYamlFiles({folder.path("c.yaml")}); }));
}

TEST(YamlMerge, SettingsMergeWhatTheyAreGiven) {
  const YamlSettings settings{"~", YAML::Load("a: &a {x: 1}\nb: {<<: *a, y: 2}")};
  EXPECT_EQ(1, settings.group("b")->integer("x"));
  EXPECT_EQ("~: line 1: <<: \"5\" is not valid, expected a group or a list of groups, whose keys are taken",
            refusal([] {
              YamlSettings{"~", YAML::Load("b: {<<: 5}")};
            }));
}

}  // namespace
}  // namespace nord_driver
