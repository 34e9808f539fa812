// The configuration of a PROFIBUS segment: what is accepted, what is refused and in which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "support/map_settings.h"
#include "transport/profibus/profibus_dp.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using test::MapSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Segment {
  explicit Segment(std::size_t count = 2) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string name = "drive" + std::to_string(i);
      settings.push_back(std::make_shared<MapSettings>("~drives/" + name + "/"));
      settings.back()->set("address", static_cast<int>(3 + i)).set("series", "sk5xxe").set("pole_pairs", 2);
      drives.push_back({name, settings.back()});
    }
  }
  ProfibusDpConfig read(double cycle_rate = 100.0) const { return readProfibusDpConfig(bus, drives, cycle_rate); }
  std::string refusal(double cycle_rate = 100.0) const {
    try {
      // The whole transport, so that what only the master checks is refused in words too.
      ProfibusDpTransport{[](const link::SerialSettings&) { return nullptr; }}.configure(bus, drives, cycle_rate);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  MapSettings bus{"~bus/", {{"device", std::string{"/dev/ttyUSB0"}}}};
  std::vector<std::shared_ptr<MapSettings>> settings;
  std::vector<DriveSettings> drives;
};

TEST(ProfibusDpConfigTest, HasItsDefaults) {
  const ProfibusDpConfig config = Segment{}.read();
  EXPECT_EQ("/dev/ttyUSB0", config.device);
  EXPECT_EQ(500'000u, config.bus.baud.bitsPerSecond());
  EXPECT_EQ(1, config.bus.master.value());
  EXPECT_EQ(1, config.bus.max_retries);
  EXPECT_EQ(milliseconds{200}, config.watchdog);
  ASSERT_EQ(2u, config.slaves.size());
  EXPECT_EQ(3, config.slaves[0].address.value());
  EXPECT_EQ(0x7531, config.slaves[0].ident_number);
  EXPECT_EQ(12u, config.slaves[0].output_length) << "PPO 1";
  EXPECT_EQ((std::vector<std::uint8_t>{0xF3, 0xF1}), config.slaves[0].configuration) << "BU 0020 5.2.2";
  EXPECT_TRUE(config.slaves[0].user_parameters.empty());
  EXPECT_EQ(milliseconds{200}, config.slaves[0].watchdog);
  EXPECT_TRUE(config.drives[0].ppo.has_pkw);
}

TEST(ProfibusDpConfigTest, TakesWhatIsGiven) {
  Segment segment;
  segment.bus.set("baud_rate", 1'500'000).set("master_address", 2).set("max_retries", 3).set("watchdog", 0.5);
  segment.settings[0]->set("ppo_type", 3).set("user_parameters", "00 1A ff");
  const ProfibusDpConfig config = segment.read();
  EXPECT_EQ(1'500'000u, config.bus.baud.bitsPerSecond());
  EXPECT_EQ(2, config.bus.master.value());
  EXPECT_EQ(3, config.bus.max_retries);
  EXPECT_EQ(milliseconds{500}, config.slaves[1].watchdog);
  EXPECT_EQ(4u, config.slaves[0].output_length) << "PPO 3";
  EXPECT_FALSE(config.drives[0].ppo.has_pkw);
  EXPECT_EQ((std::vector<std::uint8_t>{0x00, 0x1A, 0xFF}), config.slaves[0].user_parameters);
}

// --- Slot time -------------------------------------------------------------------------------------------------------

// A pty or a USB adapter holds bytes back for milliseconds: an answer would count as lost that is on its way.
TEST(ProfibusDpConfigTest, SlotTimeIsAtLeast20MsBehindAnAdapter) {
  EXPECT_EQ(milliseconds{20}, Segment{}.read().bus.slotTime());
  Segment slow{1};
  slow.bus.set("baud_rate", 9600).set("watchdog", 1.0);
  EXPECT_EQ(milliseconds{20}, slow.read(5.0).bus.slotTime()) << "the table's 100 bit times are 10.4 ms";
  slow.bus.set("baud_rate", 45450);
  EXPECT_EQ(milliseconds{20}, slow.read(5.0).bus.slotTime()) << "640 bit times are 14.1 ms";
}

TEST(ProfibusDpConfigTest, SlotTimeIsTheTablesOnANativeUart) {
  if (!std::filesystem::exists("/dev/ttyS0")) GTEST_SKIP() << "this machine has no /dev/ttyS0";
  Segment segment;
  segment.bus.set("device", "/dev/ttyS0");
  EXPECT_EQ(std::chrono::microseconds{400}, segment.read().bus.slotTime()) << "200 bit times at 500 kbit/s";
}

TEST(ProfibusDpConfigTest, ASlotTimeThatIsGivenCounts) {
  Segment segment;
  segment.bus.set("slot_time", 0.005);
  EXPECT_EQ(milliseconds{5}, segment.read().bus.slotTime());
}

// --- Times that do not fit -------------------------------------------------------------------------------------------

// 12 bytes each way and 9 of frame: 8 drives at 19.2 kbit/s take far more than a cycle of 100 Hz.
TEST(ProfibusDpConfigTest, ACycleThatDoesNotFitTheBaudRateIsRefusedWithTheRateThatWould) {
  Segment segment{8};
  segment.bus.set("baud_rate", 19200).set("watchdog", 5.0);
  const std::string sentence = segment.refusal();
  EXPECT_THAT(sentence, AllOf(HasSubstr("~bus/baud_rate: 19200 bit/s is too slow for 8 drives at 100 Hz"),
                              HasSubstr("expected a cycle_rate of at most ")));
  const double rate = std::stod(sentence.substr(sentence.rfind("at most ") + 8));
  EXPECT_EQ("accepted", segment.refusal(0.999 * rate)) << "the sentence must be right";
  EXPECT_NE("accepted", segment.refusal(1.01 * rate));
}

// With one silent drive and its retries the others must not be caught by their watchdogs: 2 x 20 ms slots and more.
TEST(ProfibusDpConfigTest, AWatchdogShorterThanTheWorstCycleIsRefused) {
  Segment segment;
  segment.bus.set("watchdog", 0.04);
  EXPECT_THAT(segment.refusal(), AllOf(HasSubstr("~bus/watchdog: 0.04 is not valid, expected at least 0.04"),
                                       HasSubstr("s, the worst cycle with one silent drive")));
  segment.bus.set("watchdog", 0.05);
  EXPECT_EQ("accepted", segment.refusal());
  segment.bus.set("max_retries", 3);
  EXPECT_NE("accepted", segment.refusal()) << "more retries, a longer worst cycle";
}

TEST(ProfibusDpConfigTest, TheMastersOwnAddressIsRefusedToADrive) {
  Segment segment;
  segment.bus.set("master_address", 5);
  segment.settings[1]->set("address", 5);
  EXPECT_THAT(segment.refusal(), HasSubstr("address: 5 is not valid, expected another address than the master's own"));
}

// All but one silent: that one waits for all the slots of the others. It fits, or is told with the figure.
TEST(ProfibusDpConfigTest, AWatchdogShorterThanACycleWithOneStationLeftIsWarnedOf) {
  for (const std::size_t count : {1u, 2u, 5u}) EXPECT_TRUE(Segment{count}.read().warnings.empty()) << count;
  Segment segment{7};  // 6 x 2 slots of 20 ms, and their telegrams
  ASSERT_EQ(1u, segment.read().warnings.size());
  EXPECT_THAT(segment.read().warnings[0],
              AllOf(HasSubstr("~bus/watchdog: 0.2 s is shorter than a cycle in which all stations but one are silent"),
                    HasSubstr("(0.25"), HasSubstr(" s for 7 stations")));
  segment.bus.set("watchdog", 0.3);
  EXPECT_TRUE(segment.read().warnings.empty());
  segment.bus.set("max_retries", 2);
  EXPECT_EQ(1u, segment.read().warnings.size());
}

TEST(ProfibusDpConfigTest, AWatchdogShorterThanTwoCyclesIsRefused) {
  Segment segment;
  segment.bus.set("watchdog", 0.3).set("slot_time", 0.001);
  EXPECT_EQ("accepted", segment.refusal(10.0));
  EXPECT_THAT(segment.refusal(5.0), HasSubstr("~bus/watchdog: 0.3 is not valid, expected at least 0.4 s"));
}

// 255 x 255 x 10 ms: what is advised of a time that no two factors make.
TEST(ProfibusDpConfigTest, TheLongestWatchdogIsOneThatASlaveCanBeTold) {
  Segment segment;
  segment.bus.set("watchdog", 650.25);
  EXPECT_EQ("accepted", segment.refusal());
  EXPECT_EQ(milliseconds{650'250}, segment.read().watchdog);
}

// --- Refusals --------------------------------------------------------------------------------------------------------

struct Wrong {
  std::string key;
  MapSettings::Value value;
  std::string sentence;
};

void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.key << ": " << wrong.sentence;
}

class WrongBusKey : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongBusKey, IsRefusedByNameValueAndExpectation) {
  Segment segment;
  segment.bus.set(GetParam().key, GetParam().value);
  EXPECT_THAT(segment.refusal(), AllOf(HasSubstr("~bus/" + GetParam().key), HasSubstr(GetParam().sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongBusKey,
    ::testing::Values(Wrong{"device", std::string{},
                            "\"\" is not valid, expected a serial device such as /dev/ttyUSB0"},
                      Wrong{"device", 3, "expected a text"},
                      Wrong{"baud_rate", 115200, "115200 bit/s is no PROFIBUS rate: expected 9600, 19200"},
                      Wrong{"baud_rate", 0, "0 is not valid, expected a whole number from 1 to 12000000"},
                      Wrong{"master_address", 126, "126 is not valid, expected a whole number from 0 to 125"},
                      Wrong{"max_retries", 16, "16 is not valid, expected a whole number from 0 to 15"},
                      Wrong{"watchdog", 0.0, "0 is not valid, expected a number from 0.01 to 650.25 s"},
                      Wrong{"watchdog", 651.0, "651 is not valid, expected a number from 0.01 to 650.25 s"},
                      Wrong{"watchdog", 650.0, "650.25 s is the next longer one"},
                      Wrong{"slot_time", 1.5, "1.5 is not valid, expected a number from 0 to 1 s"},
                      Wrong{"listen_first", 11.0, "11 is not valid, expected a number from 0 to 10 s"},
                      Wrong{"record_addressing", std::string{"both"}, "\"both\" is not valid, expected index or slot"},
                      Wrong{"slot_time", 0.0001, "0.0001 is not valid, expected at least 0.00023 s"},
                      Wrong{"gsd", std::vector<std::string>{"nord.gsd"},
                            "\"nord.gsd\" is not valid, expected a GSD file that can be read"}));

class WrongDriveKey : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongDriveKey, IsRefusedByNameValueAndExpectation) {
  Segment segment;
  segment.settings[1]->set(GetParam().key, GetParam().value);
  EXPECT_THAT(segment.refusal(), AllOf(HasSubstr("~drives/drive1/" + GetParam().key), HasSubstr(GetParam().sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongDriveKey,
    ::testing::Values(Wrong{"address", 2, "2 is not valid, expected a whole number from 3 to 125"},
                      Wrong{"address", 0, "0 is not valid, expected a whole number from 3 to 125"},
                      Wrong{"address", 127, "127 is not valid, expected a whole number from 3 to 125"},
                      Wrong{"address", 126,
                            "126 is not valid, expected a whole number from 3 to 125: 126 is what a module has from "
                            "the factory, give it an address of its own"},
                      Wrong{"address", 3, "3 is not valid, expected another address than drive \"drive0\" has"},
                      Wrong{"address", 1, "1 is not valid, expected a whole number from 3 to 125"},
                      Wrong{"module", std::string{"sk_cu5"},
                            "\"sk_cu5\" is not valid, expected sk_tu3 (SK TU3-PBR), sk_cu4"},
                      Wrong{"io_byte", true, "true is not valid, expected false: only SK CU4/TU4-PBR"},
                      Wrong{"ppo_type", 5, "5 is not valid, expected a whole number from 1 to 4"},
                      Wrong{"ppo_type", 0, "0 is not valid, expected a whole number from 1 to 4"},
                      Wrong{"inverter", 2, "2 is not valid, expected 1: SK TU1/2/3-PBR serves one inverter"},
                      Wrong{"user_parameters", std::string{"0G"}, "\"0G\" is not valid, expected hexadecimal bytes"},
                      Wrong{"user_parameters", std::string{"001"}, "\"001\" is not valid, expected hexadecimal bytes"},
                      Wrong{"user_parameters", std::string(2 * 238, '0'), "at most 237"}));

TEST(ProfibusDpConfigTest, WhatIsMissingIsNamed) {
  Segment segment;
  segment.bus.erase("device");
  EXPECT_THAT(segment.refusal(), HasSubstr("~bus/device is missing: expected a serial device such as /dev/ttyUSB0"));
  segment = Segment{};
  segment.settings[0]->erase("address");
  EXPECT_THAT(segment.refusal(), HasSubstr("~drives/drive0/address is missing: expected a whole number from 3 to 125"));
}

// Set_Prm says f1 * f2 * 10 ms (BU 2700 8.1.1); 257 is a prime number. Rounded down it would be shorter than checked.
TEST(ProfibusDpConfigTest, AWatchdogNoSlaveCanBeToldIsRefusedWithTheNextOne) {
  Segment segment;
  segment.bus.set("watchdog", 2.57);
  EXPECT_THAT(segment.refusal(),
              HasSubstr("~bus/watchdog: 2.57 is not valid, expected a time a slave can be told: 2.58 s is"));
  segment.bus.set("watchdog", 0.205);
  EXPECT_THAT(segment.refusal(), HasSubstr("~bus/watchdog: 0.205 is not valid, expected a time a slave can be told: "));
  segment.bus.set("watchdog", 2.58);
  EXPECT_EQ("accepted", segment.refusal());
}

// 0.29 is 0.28999... in a double, and still 29 * 10 ms.
TEST(ProfibusDpConfigTest, EveryMultipleOf10MsUpTo2550MsCanBeTold) {
  Segment segment;
  segment.bus.set("slot_time", 0.0005);
  for (int n = 2; n <= 255; ++n) {
    segment.bus.set("watchdog", n / 100.0);
    ASSERT_EQ(milliseconds{10 * n}, segment.read().watchdog);
  }
}

// The figures behind a refusal: 0.2 s at 19.2 kbit/s with 8 slaves.
TEST(ProfibusDpConfigTest, AWatchdogThatDoesNotFitIsRefusedWithTheFigures) {
  Segment segment{8};
  segment.bus.set("baud_rate", 19200);
  EXPECT_THAT(segment.refusal(4.0), AllOf(HasSubstr("~bus/watchdog: 0.2 is not valid, expected at least 0.5 s"),
                                          HasSubstr("for 8 stations at 19200 bit/s, slot time 0.02 s, 1 retries")));
}

TEST(ProfibusDpConfigTest, OptionsOfTheBusAreOffUnlessAskedFor) {
  Segment segment;
  ProfibusDpConfig config = segment.read();
  EXPECT_EQ(Duration::zero(), config.bus.listen_first);
  EXPECT_FALSE(config.bus.sync_outputs);
  EXPECT_FALSE(config.bus.freeze_inputs);
  EXPECT_FALSE(config.scan);
  EXPECT_FALSE(config.records.by_slot);
  EXPECT_TRUE(config.records.number_offset);
  segment.bus.set("listen_first", 0.5).set("sync", true).set("freeze", true).set("scan", true);
  segment.bus.set("record_addressing", "slot").set("record_number_offset", false);
  config = segment.read();
  EXPECT_EQ(milliseconds{500}, config.bus.listen_first);
  EXPECT_TRUE(config.bus.sync_outputs);
  EXPECT_TRUE(config.bus.freeze_inputs);
  EXPECT_TRUE(config.scan);
  EXPECT_TRUE(config.records.by_slot);
  EXPECT_FALSE(config.records.number_offset);
}

// A driver that was killed may have left a wheel turning: its watchdog, told by the same file, runs out while a guest
// listens. No longer than the engine can, and no shorter than asked for.
TEST(ProfibusDpConfigTest, AGuestListensForAsLongAsAWatchdogMayRun) {
  struct Case {
    double watchdog, listen_first, expected;
  };
  for (const Case& in : {Case{0.2, 0.0, 0.5}, Case{0.25, 0.0, 0.5}, Case{0.26, 0.0, 0.51}, Case{2.0, 0.0, 2.25},
                         Case{2.0, 4.0, 4.0}, Case{9.75, 0.0, 10.0}, Case{9.8, 0.0, 10.0}, Case{60.0, 0.0, 10.0}}) {
    Segment segment;
    segment.bus.set("watchdog", in.watchdog).set("listen_first", in.listen_first);
    ProfibusDpConfig config = segment.read();
    endWithoutATrip(config);
    EXPECT_NEAR(in.expected, toSeconds(config.bus.listen_first), 1e-9) << in.watchdog << " s";
    EXPECT_EQ(Duration::zero(), config.slaves[1].watchdog);
    EXPECT_NO_THROW(config.bus.validate());
  }
}

TEST(ProfibusDpConfigTest, AnEmptyListOfGsdFilesIsFine) {
  Segment segment;
  segment.bus.set("gsd", std::vector<std::string>{});
  EXPECT_EQ("accepted", segment.refusal());
}

}  // namespace
}  // namespace nord_driver
