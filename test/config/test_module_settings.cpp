// Whose word counts behind a bus module.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/module_settings.h"
#include "support/map_settings.h"

namespace nord_driver {
namespace {

using test::MapSettings;
using ::testing::ElementsAre;

/// Three drives; the first two are behind one module.
struct Drives {
  DriveSettings drive(const std::string& name, int address, std::map<std::string, MapSettings::Value> values) {
    values["address"] = address;
    return {name, std::make_shared<MapSettings>("~drives/" + name + "/", std::move(values))};
  }

  std::vector<DriveSettings> all{drive("a", 5, {{"both", 1}, {"rate", 2.5}}),
                                 drive("b", 5, {{"both", 2}, {"on", true}, {"name", std::string{"x"}}}),
                                 drive("c", 6, {{"far", 1}})};
};

TEST(ModuleSettings, TakesItsOwnWordFirstAndThenThatOfTheOthersBehindTheModule) {
  const Drives drives;
  const ModuleSettings a{drives.all[0], drives.all}, b{drives.all[1], drives.all};
  EXPECT_EQ(1, a.integer("both"));
  EXPECT_EQ(2, b.integer("both"));
  EXPECT_EQ(2.5, b.number("rate"));
  EXPECT_EQ(true, a.boolean("on"));
  EXPECT_EQ("x", a.text("name"));
  EXPECT_THAT(a.texts("name").value(), ElementsAre("x"));
  EXPECT_TRUE(a.has("on"));
  EXPECT_FALSE(a.has("far")) << "it is behind another module";
  EXPECT_THAT(a.keys(), ElementsAre("address", "both", "rate"));
}

// A refusal names the key where it stands.
TEST(ModuleSettings, NamesTheKeyOfWhoSaysIt) {
  const Drives drives;
  const ModuleSettings a{drives.all[0], drives.all}, b{drives.all[1], drives.all};
  EXPECT_EQ("~drives/b/on", a.fullName("on"));
  EXPECT_EQ("~drives/a/none", a.fullName("none"));
  EXPECT_STREQ(
      "~drives/b/both differs from that of drive \"a\", expected the same: both are inverters behind one module, which "
      "has it only once",
      b.differing("both").what());
}

}  // namespace
}  // namespace nord_driver
