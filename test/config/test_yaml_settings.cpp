// The driver's configuration read from files: kinds, groups, and files laid over each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "config/setting_groups.h"
#include "config/yaml_settings.h"
#include "support/temporary_folder.h"

namespace nord_driver {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

YamlSettings settings(const char* text) {
  return YamlSettings{"", YAML::Load(text)};
}

template <typename Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(YamlSettings, ReadsWhatIsThereAndNothingElse) {
  const YamlSettings all = settings("{rate: 100, on_air: true, name: left, wheels: [a, b], bus: {baud_rate: 500000}}");
  EXPECT_EQ(100.0, all.number("rate"));
  EXPECT_EQ(100, all.integer("rate"));
  EXPECT_EQ(true, all.boolean("on_air"));
  EXPECT_EQ("left", all.text("name"));
  EXPECT_THAT(all.texts("wheels").value(), ElementsAre("a", "b"));
  EXPECT_THAT(all.texts("name").value(), ElementsAre("left"));
  EXPECT_EQ(500'000, all.integer("bus/baud_rate"));
  EXPECT_EQ(500'000, all.group("bus")->integer("baud_rate"));
  EXPECT_EQ("bus/baud_rate", all.group("bus")->fullName("baud_rate"));
  EXPECT_FALSE(all.has("nothing"));
  EXPECT_EQ("bus", all.group("bus")->fullName("")) << "the group itself";
  EXPECT_FALSE(all.number("bus/nothing"));
  EXPECT_FALSE(all.group("nothing")->has("key"));
  EXPECT_THAT(all.keys(), ElementsAre("bus", "name", "on_air", "rate", "wheels")) << "asking adds nothing";
}

// The slips that are made most are told with what to do about them.
TEST(YamlSettings, SaysWhatToDoAboutQuotesAndBrackets) {
  const YamlSettings all = settings("{a: '3', b: 'true', c: 'fast', d: [[x, y]], e: [[1, 2]], f: [{address: 3}]}");
  EXPECT_EQ("a: \"3\" is not valid, expected a whole number: write 3 without quotes",
            refusal([&] { all.integer("a"); }));
  EXPECT_EQ("a: \"3\" is not valid, expected a number: write 3 without quotes", refusal([&] { all.number("a"); }));
  EXPECT_EQ("b: \"true\" is not valid, expected true or false: write true without quotes",
            refusal([&] { all.boolean("b"); }));
  EXPECT_EQ("c: \"fast\" is not valid, expected a number", refusal([&] { all.number("c"); }));
  EXPECT_EQ("d: a list of lists is not valid, expected a list of texts: take one pair of brackets away",
            refusal([&] { all.texts("d"); }));
  EXPECT_EQ("e: a list of lists is not valid, expected a list of numbers: take one pair of brackets away",
            refusal([&] { all.numbers("e"); }));
  EXPECT_EQ("f: a list is not valid, expected a group of keys and values: write \"name: ...\" in place of \"- ...\"",
            refusal([&] { all.group("f"); }));
}

// As rosparam sees them: what is quoted is a text, "yes" is true, 0x10 is 16, a whole fraction an integer.
TEST(YamlSettings, TellsKindsAsRosparamDoes) {
  const YamlSettings all =
      settings("{quoted: '5', yes_word: yes, hex: 0x10, whole: 2.0, small: 1.0e-3, negative: -7, none: ~}");
  EXPECT_EQ("5", all.text("quoted"));
  EXPECT_THAT(refusal([&] { all.number("quoted"); }), HasSubstr("quoted: \"5\" is not valid, expected a number"));
  EXPECT_EQ(true, all.boolean("yes_word"));
  EXPECT_THAT(refusal([&] { all.text("yes_word"); }), HasSubstr("yes_word: yes is not valid, expected a text"));
  EXPECT_EQ(16, all.integer("hex"));
  EXPECT_EQ(16.0, all.number("hex"));
  EXPECT_EQ(2, all.integer("whole"));
  EXPECT_EQ(1e-3, all.number("small"));
  EXPECT_EQ(-7, all.integer("negative"));
  EXPECT_FALSE(all.has("none"));
}

// PyYAML, and with it rosparam, wants a point in a fraction and a sign in its exponent: the check must not accept what ends
// the node. Each as rosparam.load_str of Noetic has it.
TEST(YamlSettings, TakesForNumbersWhatRosparamTakes) {
  for (const char* const number : {"1.0e+6", "1.0e-3", ".5", "5.", "0.5", "010", "-7", "+3", "-0.25"}) {
    EXPECT_NO_THROW(settings((std::string("{a: ") + number + "}").c_str()).number("a")) << number;
  }
  EXPECT_EQ(8, settings("{a: 010}").integer("a"));
  const std::pair<const char*, const char*> texts[] = {{"1e6", "1000000"}, {"1.0e6", "1000000"}, {"1e-3", "0.001"},
                                                       {"-.5", "-0.5"},    {"08", "8"},          {"1e-20", "1.0e-20"}};
  for (const auto& [text, better] : texts) {
    const YamlSettings all = settings((std::string("{a: ") + text + "}").c_str());
    EXPECT_EQ(std::string("a: \"") + text + "\" is not valid, expected a number: YAML takes " + text +
                  " for a text, write " + better,
              refusal([&] { all.number("a"); }));
  }
}

// rosparam makes radians of them, as fractions; each as rosparam.load_str of Noetic has it.
TEST(YamlSettings, AnglesAreRadiansAsRosparamMakesThem) {
  const std::pair<const char*, double> angles[] = {{"deg(90)", 1.5707963267948966},
                                                   {"deg(-90.0)", -1.5707963267948966},
                                                   {"deg( 90 )", 1.5707963267948966},
                                                   {"deg(1e2)", 1.7453292519943295},
                                                   {"deg(.5)", 0.008726646259971648},
                                                   {"rad(1.5)", 1.5},
                                                   {"rad( 1.5 )", 1.5},
                                                   {"rad(-1)", -1.0},
                                                   {"rad(5.)", 5.0},
                                                   {"rad(0)", 0.0},
                                                   {"rad(08.5)", 8.5},
                                                   {"!degrees 90", 1.5707963267948966},
                                                   {"!degrees '90'", 1.5707963267948966},
                                                   {"!degrees deg(90)", 1.5707963267948966},
                                                   {"!radians 1.5", 1.5}};
  for (const auto& [text, radians] : angles) {
    EXPECT_EQ(radians, settings((std::string("{a: ") + text + "}").c_str()).number("a")) << text;
  }
  EXPECT_THAT(settings("a: [deg(0), deg(90)]").numbers("a").value(), ElementsAre(0.0, 1.5707963267948966));
  EXPECT_EQ("a: deg(90) is not valid, expected a text", refusal([] { settings("a: deg(90)").text("a"); }));
}

TEST(YamlSettings, WhatRosparamTakesForATextIsNoAngle) {
  for (const char* const text : {"'deg(90)'", "Deg(90)", "deg (90)", "-deg(90)", "deg(1)(2)", "degrees", "rad((1))"}) {
    EXPECT_NO_THROW(settings((std::string("a: ") + text).c_str()).text("a")) << text;
  }
}

// rosparam evaluates what is in rad(...), as Python does, and ends with what it cannot read.
TEST(YamlSettings, AnAngleThatIsNoPlainNumberIsRefused) {
  for (const std::string angle : {"rad(pi/2)", "rad(2*pi)", "rad()", "rad(0x10)", "rad(08)", "rad(1.5.)", "rad(1e999)",
                                  "deg(pi)", "deg()", "deg(inf)", "deg(9O)", "deg(1_0)"}) {
    EXPECT_EQ(
        "~steered/front/max_angle: " + angle + " is not valid, expected one number in the brackets: write the number",
        refusal([&] { YamlSettings("~", YAML::Load("steered: {front: {max_angle: " + angle + "}}")); }));
  }
  EXPECT_EQ("a: rad(2*pi) is not valid, expected one number in the brackets: write the number",
            refusal([] { settings("a: !radians 2*pi"); }));
}

// rosparam itself would end with it, whoever reads that key.
TEST(YamlSettings, AWholeNumberOfMoreThan32BitsIsRefused) {
  const auto refusalOf = [](const std::string& number) {
    return refusal([&] { YamlSettings("~", YAML::Load("drives: {left: {vendor_id: " + number + "}}")); });
  };
  const std::string expected =
      " is not valid, expected -2147483648 to 2147483647: the parameter server takes no longer whole number";
  const std::string key = "~drives/left/vendor_id: ";
  EXPECT_EQ(key + "2147483648" + expected + "; write 2147483648.0", refusalOf("2147483648"));
  EXPECT_EQ(key + "0xFFFFFFFF" + expected + "; write 4294967295.0", refusalOf("0xFFFFFFFF"));
  EXPECT_EQ(key + "-2147483649" + expected + "; write -2147483649.0", refusalOf("-2147483649"));
  EXPECT_EQ(key + "99999999999999999999" + expected, refusalOf("99999999999999999999"));
  const YamlSettings settings("~", YAML::Load("{a: 2147483647, b: -2147483648, c: 4294967295.0, d: 0x7FFFFFFF}"));
  EXPECT_EQ(2147483647, settings.integer("a"));
  EXPECT_EQ(-2147483648LL, settings.integer("b"));
  EXPECT_EQ(4294967295LL, settings.integer("c"));
  EXPECT_EQ(2147483647, settings.integer("d"));
}

TEST(YamlSettings, AWrongKindIsRefusedWithKeyValueAndExpectation) {
  const YamlSettings all = settings("{rate: fast, bus: 3, list: [1, 2], part: 2.5, huge: 99999999999999999999.0}");
  EXPECT_THAT(refusal([&] { all.number("rate"); }), HasSubstr("rate: \"fast\" is not valid, expected a number"));
  EXPECT_THAT(refusal([&] { all.group("bus"); }), HasSubstr("bus: 3 is not valid, expected a group"));
  EXPECT_THAT(refusal([&] { all.number("list"); }), HasSubstr("list: a list is not valid, expected a number"));
  EXPECT_THAT(refusal([&] { all.texts("list"); }), HasSubstr("list: 1 is not valid, expected a list of texts"));
  EXPECT_THAT(refusal([&] { all.integer("part"); }), HasSubstr("part: 2.5 is not valid, expected a whole number"));
  EXPECT_THAT(refusal([&] { all.integer("huge"); }), HasSubstr("expected a whole number"));
  EXPECT_THAT(refusal([&] { all.boolean("rate"); }), HasSubstr("expected true or false"));
}

TEST(YamlSettings, NamesWhereNoGroupIsAreRefusedWithWhatStandsThere) {
  const YamlSettings all = settings("{signals: 5, setpoints: {speed: {}}, outputs: [x]}");
  EXPECT_EQ("signals: 5 is not valid, expected a group of keys and values", refusal([&] { namesIn(all, "signals"); }));
  EXPECT_THAT(refusal([&] { namesIn(all, "outputs"); }), HasSubstr("outputs: a list is not valid, expected a group"));
  EXPECT_THAT(namesIn(all, "setpoints"), ElementsAre("speed"));
  EXPECT_TRUE(namesIn(all, "none").empty());
}

// A group is told by a key in it as well: nobody has to ask for the group itself. One that is empty is absent.
TEST(YamlSettings, AValueWhereAGroupBelongsIsRefused) {
  const YamlSettings all = settings("{stop: coast, linear: {x: 5}, axes: [x], angular: ~, drives: {left: 3}}");
  EXPECT_EQ("stop: \"coast\" is not valid, expected a group of keys and values",
            refusal([&] { all.text("stop/on_fault"); }));
  EXPECT_EQ("linear/x: 5 is not valid, expected a group of keys and values",
            refusal([&] { all.has("linear/x/max_velocity"); }));
  EXPECT_EQ("linear/x: 5 is not valid, expected a group of keys and values",
            refusal([&] { all.group("linear")->number("x/max_velocity"); }));
  EXPECT_EQ("axes: a list is not valid, expected a group of keys and values: write \"name: ...\" in place of \"- ...\"",
            refusal([&] { all.has("axes/x"); }));
  EXPECT_EQ("drives/left: 3 is not valid, expected a group of keys and values",
            refusal([&] { all.group("drives")->group("left"); }));
  EXPECT_FALSE(all.has("angular/z/max_velocity"));
  EXPECT_FALSE(all.group("angular")->has("z/max_velocity"));
}

TEST(YamlSettings, ALaterFileIsLaidOverAnEarlierOne) {
  const std::string first = ::testing::TempDir() + "nord_first.yaml";
  const std::string second = ::testing::TempDir() + "nord_second.yaml";
  std::ofstream(first) << "bus: {device: a, baud_rate: 1}\n";
  std::ofstream(second) << "bus: {device: b}\n";
  const YamlSettings all{"", readYamlFiles({first, second})};
  EXPECT_EQ("b", all.text("bus/device"));
  EXPECT_EQ(1, all.integer("bus/baud_rate"));
  std::remove(first.c_str());
  std::remove(second.c_str());
  EXPECT_THAT(refusal([&] { readYamlFiles({first}); }), HasSubstr(first));
}

// As on the parameter server, where a slash in a name begins a namespace.
TEST(YamlSettings, ASlashInAKeyBeginsAGroup) {
  const YamlSettings settings{"", YAML::Load("linear/x: {max_velocity: 0.5}\n"
                                             "linear/y/max_velocity: 0.3\n"
                                             "linear: {z: {max_velocity: 0.1}}\n"
                                             "drives: {left: {a/b: 1}}")};
  EXPECT_EQ(0.5, settings.number("linear/x/max_velocity"));
  EXPECT_EQ(0.3, settings.number("linear/y/max_velocity"));
  EXPECT_EQ(0.1, settings.number("linear/z/max_velocity"));
  EXPECT_EQ(1, settings.group("drives")->group("left")->integer("a/b"));
  EXPECT_EQ((std::vector<std::string>{"drives", "linear"}), settings.keys());
}

// A few lines can be a tree without end, which nobody walks through: it would take all stack or all memory.
TEST(YamlSettings, ATreeWithoutEndIsRefused) {
  EXPECT_EQ("the file: it is more than 50 groups and lists deep, expected groups of keys and values",
            refusal([] { settings("a: &a [*a]"); }));
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 20; ++i) {
    const std::string below = "*a" + std::to_string(i - 1), name = "a" + std::to_string(i);
    laughs += name + ": &" + name + " [" + below + ", " + below + ", " + below + "]\n";
  }
  EXPECT_EQ("the file: it has more than 100000 values, expected groups of keys and values",
            refusal([&] { settings(laughs.c_str()); }));
  const test::TemporaryFolder folder;
  folder.write("a.yaml", "a: &a [*a]\n");
  EXPECT_THAT(refusal([&] { readYamlFiles({folder.path("a.yaml")}); }), HasSubstr("groups and lists deep"));
}

TEST(YamlSettings, AKeyThatIsNoTextIsRefused) {
  EXPECT_EQ("the file: line 2: a key is a list or a group, expected groups of keys and values",
            refusal([] { settings("a:\n  [1, 2]: 3"); }));
}

// Digits without end are no number; they had been followed on the stack, a frame each.
TEST(YamlSettings, AMillionDigitsAreNoNumber) {
  const std::string digits(2'000'000, '7');
  const YamlSettings settings{"", YAML::Load("a: " + digits + "\nb: 0." + digits)};
  EXPECT_THROW(settings.number("a"), ConfigError);
  EXPECT_THROW(settings.number("b"), ConfigError);
}

}  // namespace
}  // namespace nord_driver
