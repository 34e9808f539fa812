#include <gtest/gtest.h>

#include "sim/inverter/pkw_server.h"

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

  static PkwSettings settings(unsigned delay, bool ram_orders = true, bool double_word_answers = true) {
    PkwSettings settings;
    settings.delay = delay;
    settings.ram_orders = ram_orders;
    settings.double_word_answers = double_word_answers;
    return settings;
  }

  ParameterStore parameters;
  PkwServer server{parameters, settings(0)};
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

// The inverter gives the others of the table never by itself; here they are made: for one parameter, or for all.
TEST_F(Pkw, ErrorNumbersOnRequest) {
  for (const unsigned error : {6u, 7u, 9u, 101u, 102u, 103u, 202u}) {
    server.refuse(PkwRefusal{static_cast<Word>(error), 105});
    EXPECT_EQ("7451 0000 0000 " + toHexWord(static_cast<Word>(error)), ask("1451 0000 0000 0000"));
    EXPECT_EQ("144E 0000 0000 00C8", ask("144E 0000 0000 0000"));
  }
  server.refuse(PkwRefusal{101, std::nullopt});
  EXPECT_EQ("744E 0000 0000 0065", ask("244E 0000 0000 03E8"));
  EXPECT_EQ(200, parameters.value(102));
  server.refuse(std::nullopt);
  ask("0000 0000 0000 0000");
  EXPECT_EQ("144E 0000 0000 03E8", ask("244E 0000 0000 03E8"));
}

// P613 has 32 bits: answers 2 and 5, orders 3, 8, 11 and 13; word orders are of the wrong type (BU 2700 6.5.1.1).
TEST_F(Pkw, DoubleWords) {
  EXPECT_EQ("564D 0100 0001 86A0", ask("864D 0100 0001 86A0"));  // P613[-02] = 100.000 rev
  EXPECT_EQ("564D 0100 0001 86A0", ask("664D 0100 0000 0000"));
  EXPECT_EQ("564D 0200 FFFF FFFF", ask("B64D 0200 FFFF FFFF"));  // RAM only, negative
  EXPECT_EQ("264D 0000 0000 0007", ask("D64D 0000 0000 0007"));
  EXPECT_EQ("264D 0000 0000 0008", ask("364D 0000 0000 0008"));
  EXPECT_EQ("264D 0000 0000 0008", ask("164D 0000 0000 0000"));
  EXPECT_EQ("764D 0000 0000 0005", ask("264D 0000 0000 0001"));
  EXPECT_EQ("764D 0000 0000 0005", ask("C64D 0000 0000 0001"));
  EXPECT_EQ(2u, parameters.eepromWrites());
  EXPECT_EQ(-1, parameters.value(613, 0, 2));
}

// "Answers 2 and 5 only for PPO 2 and PPO 4" (BU 0020 7.5.1): an inverter that keeps to it says 202.
TEST_F(Pkw, MayNotGiveDoubleWords) {
  PkwServer strict{parameters, settings(0, true, false)};
  EXPECT_EQ("764D 0000 0000 00CA", ask(strict, "664D 0000 0000 0000"));
  EXPECT_EQ("1451 0000 0000 01F4", ask(strict, "1451 0000 0000 0000"));
}

// Every label of the table that is no order is refused with 201.
TEST_F(Pkw, ReservedLabels) {
  for (const char* order : {"4451", "5451", "A451", "F451"}) {
    EXPECT_EQ("7451 0000 0000 00C9", ask(std::string(order) + " 0000 0000 0000"));
  }
}

// A silent channel leaves the last answer standing for ever.
TEST_F(Pkw, MayNeverAnswer) {
  ask("1451 0000 0000 0000");
  server.setSilent(true);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ("1451 0000 0000 01F4", ask("15E9 0000 0000 0000"));
  server.setSilent(false);
  EXPECT_EQ("15E9 0000 0000 0000", ask("15E9 0000 0000 0000"));
}

// P700 is an array from firmware V1.9 on; before, its elements are refused and only the fault can be read (BU 0020 8).
TEST_F(Pkw, FaultNumberOfAnOldFirmware) {
  Device device;
  device.firmware = 1.8;
  ParameterStore before{device};
  before.show(700, 0, 102);
  PkwServer old{before, settings(0)};
  EXPECT_EQ("76A4 0000 0000 0004", ask(old, "66A4 0000 0000 0000"));
  EXPECT_EQ("16A4 0000 0000 0066", ask(old, "16A4 0000 0000 0000"));
  EXPECT_EQ("46AB 0000 0000 0012", ask(old, "66AB 0000 0000 0000"));  // P707 says 1.8
  EXPECT_EQ("46A4 0200 0000 0000", ask("66A4 0200 0000 0000"));
}

// The series have different shapes: five bus setpoints in one array on SK 54xE, a table of its own on SK 700E.
TEST_F(Pkw, ShapesOfTheOtherSeries) {
  Device device;
  device.series = Series::kSk54xe;
  ParameterStore of_54xe{device};
  PkwServer sk54xe{of_54xe, settings(0)};
  EXPECT_EQ("460A 0000 0000 0001", ask(sk54xe, "660A 0000 0000 0000"));  // P546[-01], set 1
  EXPECT_EQ("460A 1300 0000 0004", ask(sk54xe, "760A 1300 0000 0004"));  // P546[-05], set 4
  EXPECT_EQ("760A 1400 0000 0003", ask(sk54xe, "660A 1400 0000 0000"));
  EXPECT_EQ("760B 0000 0000 0000", ask(sk54xe, "160B 0000 0000 0000"));  // no P547

  device.series = Series::kSk700e;
  ParameterStore of_700e{device};
  PkwServer sk700e{of_700e, settings(0)};
  EXPECT_EQ("760A 0000 0000 0002", ask(sk700e, "260A 0000 0000 0008"));  // P546 ends with 7
  EXPECT_EQ("15E5 0000 0000 000A", ask(sk700e, "25E5 0000 0000 000A"));  // P509 = 10
  EXPECT_EQ("46D2 0200 0000 0600", ask(sk700e, "66D2 0200 0000 0000"));  // P746[-03]
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
  PkwServer old{parameters, settings(0, false)};
  EXPECT_EQ("744E 0000 0000 00C9", ask(old, "C44E 0000 0000 0064"));
  EXPECT_EQ(200, parameters.value(102, 0));
}

// The answer to the previous order stands until the new one is executed.
TEST_F(Pkw, StaleAnswerStands) {
  PkwServer slow{parameters, settings(2)};
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
