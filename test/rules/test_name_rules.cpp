#include <gtest/gtest.h>

#include "rules/name_rules.h"

namespace nord_driver::rules {
namespace {

TEST(NameRules, FindABusByItsNameInAnyLetters) {
  const std::vector<SourceFile> files{{"src/cycle/a.cpp", "int a;\nint b;  // on PROFIBUS\n"},
                                      {"src/drive/b.h", "int canopenOnly();\n"},
                                      {"src/node/c.cpp", "#include \"transport/interbus/x.h\"\n"},
                                      {"src/transport/profibus/d.cpp", "int profibus;\n"},
                                      {"src/node/e.md", "PROFIBUS\n"}};
  EXPECT_EQ((Violations{"src/cycle/a.cpp:2: names a bus, profibus", "src/drive/b.h:1: names a bus, canopen",
                        "src/node/c.cpp:1: names a bus, interbus"}),
            checkBusNames(files, {}));
}

TEST(NameRules, ALineOfTheListMayNameOne) {
  const std::vector<SourceFile> files{{"src/node/a.cpp", "f(\"profibus_dp\");\ng(\"profibus_dp\");\n"}};
  EXPECT_EQ((Violations{"src/node/a.cpp:2: names a bus, profibus"}),
            checkBusNames(files, {{"src/node/a.cpp", "f(\"profibus", "a reason"}}));
  EXPECT_EQ(2u, checkBusNames(files, {{"src/node/b.cpp", "f(\"profibus", "a reason"}}).size());
}

TEST(NameRules, NothingReadIsAViolation) {
  EXPECT_EQ(1u, checkBusNames({{"src/core/a.cpp", ""}}, {}).size());
}

}  // namespace
}  // namespace nord_driver::rules
