#include <gtest/gtest.h>

#include "nord_driver/sim/pkw_server.h"

namespace nord_driver::sim {
namespace {

class Pkw : public ::testing::Test {
 protected:
  /// Order and answer as four words in hexadecimal.
  std::string ask(const std::string& order) { return ask(server, order); }
  static std::string ask(PkwServer& to, const std::string& order) {
    const auto bytes = fromHex(order);
    ByteReader reader{bytes};
    PkwWords words;
    words.pke = reader.u16be();
    words.ind = reader.u16be();
    words.pwe1 = reader.u16be();
    words.pwe2 = reader.u16be();
    to.receive(words);
    const PkwWords& answer = to.answer();
    return toHexWord(answer.pke) + " " + toHexWord(answer.ind) + " " + toHexWord(answer.pwe1) + " " +
           toHexWord(answer.pwe2);
  }

  ParameterStore parameters;
  PkwServer server{parameters, 0, true};
};

// BU 0020 9.3: P102 of set 3 to 10.00 s (the manual prints another time; 1000 at 0.01 s is 10 s).
TEST_F(Pkw, ManualExample) {
  EXPECT_EQ("444E 0200 0000 03E8", ask("744E 0200 0000 03E8"));
  EXPECT_EQ(1000, parameters.value(102, 2));
  EXPECT_EQ(1u, parameters.eepromWrites());
}

TEST_F(Pkw, ReadsWithAndWithoutIndex) {
  parameters.preset(105, 0, 0, 500);
  parameters.preset(105, 3, 0, 870);
  EXPECT_EQ("1451 0000 0000 01F4", ask("1451 0000 0000 0000"));  // P105
  EXPECT_EQ("1451 0300 0000 01F4", ask("1451 0300 0000 0000"));  // label 1 ignores the index
  EXPECT_EQ("4451 0300 0000 0366", ask("6451 0300 0000 0000"));
  EXPECT_EQ("15E9 0000 0000 0000", ask("15E9 0000 0000 0000"));  // P513
  parameters.preset(513, 0, 0, -1);
  EXPECT_EQ("0000 0000 0000 0000", ask("0000 0000 0000 0000"));
  EXPECT_EQ("15E9 0000 FFFF FFFF", ask("15E9 0000 0000 0000"));  // -0.1 s
}

TEST_F(Pkw, ArrayWithoutSetsHasItsElementInTheWholeByte) {
  parameters.show(701, 4, 102);
  EXPECT_EQ("46A5 0400 0000 0066", ask("66A5 0400 0000 0000"));  // P701[-05]
  EXPECT_EQ("66A5 0000 0000 0005", ask("96A5 0000 0000 0000"));  // five elements
}

TEST_F(Pkw, UnknownNumbers) {
  EXPECT_EQ("77CF 0000 0000 0000", ask("17CF 0000 0000 0000"));  // 0: P999 does not exist
  EXPECT_EQ("7001 0000 0000 0000", ask("1001 0000 0000 0000"));  // 0: not mapped
  EXPECT_EQ("76A3 0000 0000 0000", ask("26A3 0000 0000 0001"));  // 0: a write to P699, which does not exist
}

// The other error numbers of the table that an SK 5xxE without POSICON can give.
TEST_F(Pkw, ErrorNumbers) {
  EXPECT_EQ("76A4 0000 0000 0001", ask("76A4 0000 0000 0000"));  // 1: P700 is read only
  EXPECT_EQ("75E3 0000 0000 0002", ask("25E3 0000 0000 0005"));  // 2: P507 = 5
  EXPECT_EQ("7451 0400 0000 0003", ask("6451 0400 0000 0000"));  // 3: P105 has no second element
  EXPECT_EQ("76A5 0500 0000 0003", ask("66A5 0500 0000 0000"));  // 3: P701 has five
  EXPECT_EQ("75E9 0000 0000 0004", ask("65E9 0000 0000 0000"));  // 4: P513 is no array
  EXPECT_EQ("7451 0000 0000 0005", ask("8451 0000 0000 01F4"));  // 5: no double word
  EXPECT_EQ("7451 0000 0000 00C9", ask("4451 0000 0000 0000"));  // 201: label 4 is no order
  EXPECT_EQ(0u, parameters.eepromWrites());
}

// Labels 12 and 14 write to RAM only, as does everything while P560 = 0; mains off forgets it.
TEST_F(Pkw, RamWrites) {
  EXPECT_EQ("444E 0000 0000 0064", ask("C44E 0000 0000 0064"));
  EXPECT_EQ("144E 0000 0000 0065", ask("E44E 0000 0000 0065"));
  EXPECT_EQ(0u, parameters.eepromWrites());
  EXPECT_EQ(101, parameters.value(102, 0));
  parameters.restoreFromEeprom();
  EXPECT_EQ(200, parameters.value(102, 0));

  parameters.preset(560, 0, 0, 0);
  EXPECT_EQ("144E 0000 0000 0066", ask("244E 0000 0000 0066"));
  EXPECT_EQ(0u, parameters.eepromWrites());
}

// An inverter that does not know labels 11-14 says 201.
TEST_F(Pkw, MayNotKnowRamOrders) {
  PkwServer old{parameters, 0, false};
  EXPECT_EQ("744E 0000 0000 00C9", ask(old, "C44E 0000 0000 0064"));
  EXPECT_EQ(200, parameters.value(102, 0));
}

// The answer to the previous order stands until the new one is executed.
TEST_F(Pkw, StaleAnswerStands) {
  PkwServer slow{parameters, 2, true};
  for (int i = 0; i < 3; ++i) ask(slow, "1451 0000 0000 0000");
  EXPECT_EQ("1451 0000 0000 01F4", ask(slow, "1451 0000 0000 0000"));
  EXPECT_EQ("1451 0000 0000 01F4", ask(slow, "15E9 0000 0000 0000"));
  EXPECT_EQ("1451 0000 0000 01F4", ask(slow, "15E9 0000 0000 0000"));
  EXPECT_EQ("15E9 0000 0000 0000", ask(slow, "15E9 0000 0000 0000"));
}

// A standing order is executed once; the same again counts only after another one in between.
TEST_F(Pkw, EqualOrdersCannotBeToldApart) {
  for (int i = 0; i < 10; ++i) ask("744E 0200 0000 03E8");
  EXPECT_EQ(1u, parameters.eepromWrites());
  ask("0000 0000 0000 0000");
  ask("744E 0200 0000 03E8");
  EXPECT_EQ(2u, parameters.eepromWrites());
}

}  // namespace
}  // namespace nord_driver::sim
