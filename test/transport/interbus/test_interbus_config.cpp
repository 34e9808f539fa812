// The configuration of an InterBus ring: what is accepted, what is refused and in which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "transport/interbus/interbus_settings.h"

namespace nord_driver {
namespace {

using link::ModbusFunction;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using Ring = test::InterbusSettings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(InterbusConfig, HasItsDefaults) {
  const InterbusConfig config = Ring{}.read();
  EXPECT_EQ("192.168.0.10:502", config.server.server);
  EXPECT_EQ(1, config.server.unit);
  EXPECT_EQ(ModbusFunction::kReadInputRegisters, config.server.inputs.function);
  EXPECT_EQ(ModbusFunction::kWriteRegisters, config.server.outputs.function);
  EXPECT_EQ(0, config.server.inputs.address);
  EXPECT_EQ(0, config.server.outputs.address);
  EXPECT_THAT(config.server.inputs.parts, ElementsAre(WordRange{0, 4}));
  EXPECT_THAT(config.server.outputs.parts, ElementsAre(WordRange{0, 4}));
  EXPECT_THAT(config.server.control_words, ElementsAre(0, 2));
  EXPECT_EQ(0x007F, config.server.run_bits);
  EXPECT_FALSE(config.server.running);
  EXPECT_FALSE(config.server.watchdog);
  EXPECT_EQ(milliseconds{300}, config.server.response_timeout);
  EXPECT_EQ(microseconds{2500}, config.answer_window) << "a quarter of the cycle";
  EXPECT_EQ(milliseconds{5}, Ring{}.read(10.0).answer_window) << "5 ms at most";
  ASSERT_EQ(2u, config.drives.size());
  EXPECT_EQ(2u, config.drives[1].position);
  EXPECT_EQ(1u, config.drives[1].ppo_type);
  EXPECT_EQ(InterbusProfile::kNord, config.drives[1].drive_profile);
}

TEST(InterbusConfig, TakesWhatIsGiven) {
  Ring ring;
  ring.bus.set("gateway", "gateway.local:1502").set("unit", 7).set("word_order", "swapped").set("pcp_word", true);
  ring.bus.set("inputs/function", 3).set("inputs/address", 1000);
  ring.bus.set("outputs/function", 16).set("outputs/address", 2000);
  ring.bus.set("running/address", 100).set("running/function", 4).set("running/mask", 6).set("running/value", 4);
  ring.bus.set("watchdog/address", 3000).set("watchdog/value", 500);
  ring.bus.set("answer_window", 0.001).set("response_timeout", 0.1);
  ring.drive(0).set("address", 4).set("ppo_type", 2).set("input_offset", 8).set("output_offset", 16);
  ring.drive(1).set("address", 2).set("profile", "drivecom").set("array_sub_index", "table");
  const InterbusConfig config = ring.read();
  EXPECT_EQ(7, config.server.unit);
  EXPECT_EQ(ModbusFunction::kReadHoldingRegisters, config.server.inputs.function);
  EXPECT_EQ(1000, config.server.inputs.address);
  EXPECT_EQ(2000, config.server.outputs.address);
  EXPECT_EQ(100, config.server.running->address);
  EXPECT_EQ(ModbusFunction::kReadInputRegisters, config.server.running->function);
  EXPECT_EQ(6, config.server.running->mask);
  EXPECT_EQ(4, config.server.running->value);
  EXPECT_EQ(3000, config.server.watchdog->address);
  EXPECT_EQ(500, config.server.watchdog->value);
  EXPECT_EQ(milliseconds{1}, config.answer_window);
  EXPECT_EQ(milliseconds{100}, config.server.response_timeout);
  EXPECT_EQ((WordRange{8, 5}), config.map->inputs(0)) << "with its PCP word";
  EXPECT_EQ((WordRange{16, 5}), config.map->outputs(0));
  EXPECT_EQ((WordRange{0, 3}), config.map->inputs(1));
  EXPECT_THAT(config.server.control_words, ElementsAre(17, 1));
  EXPECT_EQ(0x7F00, config.server.run_bits);
  EXPECT_EQ(InterbusProfile::kDrivecom, config.drives[1].drive_profile);
  EXPECT_FALSE(config.drives[0].array_sub_by_table);
  EXPECT_TRUE(config.drives[1].array_sub_by_table);
}

// SW1, SW3, SW2 on SK 300E, 700E and 750E (BU 0070 4.2.2), SW1, SW2, SW3 on SK 5xxE (6.1.5).
TEST(InterbusConfig, TheOrderOfTheValuesIsTheSeries) {
  for (const char* series : {"sk5xxe", "sk300e", "sk700e", "sk750e"}) {
    Ring ring{1};
    ring.drive().set("series", series).set("ppo_type", 2);
    const InterbusConfig config = ring.read();
    RegisterImage outputs;
    outputs.resize(config.map->outputWords());
    config.map->put(0, {0x047F, {1, 2, 3}}, outputs);
    const bool in_order = std::string{"sk5xxe"} == series;
    EXPECT_EQ(in_order ? (RegisterImage{0x047F, 1, 2, 3}) : (RegisterImage{0x047F, 1, 3, 2}), outputs) << series;
  }
}

// One request for both images: what is written is said by the function of what is read.
TEST(InterbusConfig, Function23IsForBothImages) {
  Ring ring;
  ring.bus.set("inputs/function", 23);
  EXPECT_EQ(ModbusFunction::kReadWriteRegisters, ring.read().server.outputs.function);
  ring.bus.set("outputs/function", 16);
  EXPECT_EQ("~bus/inputs/function: 23 and outputs/function: 16, expected 23 for both or for none: it moves both images",
            ring.refusal());
}

TEST(InterbusConfig, TheRunningRegisterIsReadAsTheInputsAre) {
  Ring ring;
  ring.bus.set("running/address", 100);
  EXPECT_EQ(ModbusFunction::kReadInputRegisters, ring.read().server.running->function);
  ring.bus.set("inputs/function", 23);
  EXPECT_EQ(ModbusFunction::kReadHoldingRegisters, ring.read().server.running->function);
  ring.bus.set("running/mask", 0x0030);
  EXPECT_EQ(0x0030, ring.read().server.running->value) << "all bits of the mask, where nothing else is said";
}

TEST(InterbusConfig, WhatIsMissingIsNamed) {
  Ring ring;
  ring.bus.erase("gateway").set("gatewy", "192.168.0.10");
  EXPECT_EQ(
      "~bus/gateway is missing: expected host name or address and port of a Modbus/TCP server; did you mean it by "
      "~bus/gatewy?",
      ring.refusal());
  Ring no_frequency;
  no_frequency.drive(1).erase("max_frequency");
  EXPECT_EQ(
      "~drives/drive1/max_frequency is missing: expected P105 in Hz, because without bus/pcp the gateway carries no "
      "parameter channel to "
      "read it by",
      no_frequency.refusal());
  Ring no_address;
  no_address.drive(0).erase("address");
  EXPECT_THAT(no_address.refusal(), HasSubstr("~drives/drive0/address is missing"));
  Ring running;
  running.bus.set("running/value", 1);
  EXPECT_THAT(running.refusal(), HasSubstr("~bus/running/address is missing"));
  Ring watchdog;
  watchdog.bus.set("watchdog/address", 1);
  EXPECT_THAT(watchdog.refusal(), HasSubstr("~bus/watchdog/value is missing"));
}

TEST(InterbusConfig, WrongValuesOfTheBusAreRefusedByKeyAndValue) {
  const auto refusal = [](const char* key, test::MapSettings::Value value) {
    Ring ring;
    ring.bus.set("running/address", 100).set(key, std::move(value));
    return ring.refusal();
  };
  EXPECT_THAT(refusal("gateway", std::string{"192.168.0.10:99999"}),
              HasSubstr("~bus/gateway: \"192.168.0.10:99999\", expected a host name or an address"));
  EXPECT_THAT(refusal("unit", 256), HasSubstr("~bus/unit: 256 is not valid, expected a whole number from 0 to 255"));
  EXPECT_EQ("~bus/inputs/function: 5 is not valid, expected one of the functions 3, 4, 23",
            refusal("inputs/function", 5));
  EXPECT_EQ("~bus/outputs/function: 6 is not valid, expected one of the functions 16, 23",
            refusal("outputs/function", 6));
  EXPECT_EQ("~bus/running/function: 23 is not valid, expected one of the functions 3, 4",
            refusal("running/function", 23));
  EXPECT_THAT(refusal("inputs/address", 65536), HasSubstr("~bus/inputs/address: 65536 is not valid"));
  EXPECT_EQ("~bus/word_order: \"little\" is not valid, expected as_is or swapped",
            refusal("word_order", std::string{"little"}));
  EXPECT_THAT(refusal("running/mask", 0), HasSubstr("~bus/running/mask: 0 is not valid"));
  EXPECT_EQ(
      "~bus/running/value: 2 is not valid, expected no other bits than running/mask, 1, has: the ring would never seem "
      "to run",
      refusal("running/value", 2));
  EXPECT_THAT(refusal("answer_window", 0.006), HasSubstr("~bus/answer_window: 0.006 is not valid"));
  EXPECT_THAT(refusal("response_timeout", 0.0), HasSubstr("~bus/response_timeout: 0 is not valid"));
}

TEST(InterbusConfig, WrongValuesOfADriveAreRefusedByKeyAndValue) {
  const auto refusal = [](const char* key, test::MapSettings::Value value) {
    Ring ring;
    ring.drive(1).set(key, std::move(value));
    return ring.refusal();
  };
  EXPECT_EQ("~drives/drive1/address: 255 is not valid, expected a whole number from 1 to 254", refusal("address", 255));
  EXPECT_EQ("~drives/drive1/address: 1 is also that of drive0, expected a position in the ring of its own",
            refusal("address", 1));
  EXPECT_THAT(refusal("ppo_type", 3), HasSubstr("~drives/drive1/ppo_type: 3 is not valid"));
  EXPECT_EQ("~drives/drive1/profile: \"cia402\" is not valid, expected nord or drivecom",
            refusal("profile", std::string{"cia402"}));
  EXPECT_EQ("~drives/drive1/array_sub_index: \"both\" is not valid, expected element or table",
            refusal("array_sub_index", std::string{"both"}));
  EXPECT_EQ(
      "~drives/drive1/series: \"sk2xxe\" is not valid, expected a series that takes an InterBus technology unit "
      "(sk300e, sk5xxe, sk700e, sk750e)",
      refusal("series", std::string{"sk2xxe"}));
  EXPECT_EQ("~drives/drive1/inverter: 2 is not valid, expected 1: an InterBus technology unit serves one inverter",
            refusal("inverter", 2));
  EXPECT_THAT(refusal("input_offset", 256), HasSubstr("~drives/drive1/input_offset: 256 is not valid"));
}

TEST(InterbusConfig, DrivecomHasPpoType1Only) {
  Ring ring;
  ring.drive().set("profile", "drivecom").set("ppo_type", 2);
  EXPECT_EQ(
      "~drives/drive0/ppo_type: 2 is not valid, expected 1: profile drivecom is effective with three words only "
      "(BU 0070 4.1)",
      ring.refusal());
}

// Words of one drive in those of another would command it.
TEST(InterbusConfig, WordsThatOverlapAreRefusedWithFigures) {
  Ring ring;
  ring.drive(1).set("output_offset", 1);
  EXPECT_EQ(
      "~drives/drive1: its output words 1 to 2 lie in those of drive0, 0 to 1; expected output_offset 2 or higher, or "
      "one that ends before",
      ring.refusal());
}

TEST(InterbusConfig, AnImageBeyondTheLastRegisterIsRefused) {
  Ring ring;
  ring.bus.set("outputs/address", 65533);
  EXPECT_EQ("~bus/outputs/address: the image from register 65533 on ends at register 65536, expected at most 65535",
            ring.refusal());
}

TEST(InterbusConfig, AWatchdogAmongTheOutputsIsRefused) {
  Ring ring;
  ring.bus.set("outputs/address", 100).set("watchdog/address", 103).set("watchdog/value", 500);
  EXPECT_EQ(
      "~bus/watchdog/address: 103 is not valid, expected a register outside the output image, which takes registers "
      "100 to 103",
      ring.refusal());
  ring.bus.set("watchdog/address", 104);
  EXPECT_EQ("accepted", ring.refusal());
}

// 125 registers are read and 123 written by one request.
TEST(InterbusConfig, ASecondConnectionIsAServer) {
  test::InterbusSettings settings;
  settings.bus.set("diagnosis", std::string{"gateway.local:503"});
  EXPECT_EQ("gateway.local:503", settings.read().server.diagnosis);
  settings.bus.set("diagnosis", std::string{"gateway.local:0"});
  EXPECT_THAT(settings.refusal(), StartsWith("~bus/diagnosis: \"gateway.local:0\", expected a host name"));
}

// With it nobody has to type P105 in.
TEST(InterbusConfig, PcpHasItsDefaults) {
  test::InterbusSettings settings;
  settings.bus.set("pcp/invoke/address", 500).set("pcp/result/address", 600);
  settings.drive(0).set("address", 9);
  settings.drive(1) = test::MapSettings("~drives/drive1/", {{"address", 3}, {"series", std::string{"sk5xxe"}}});
  settings.drive(1).set("pole_pairs", 2);
  const InterbusConfig config = settings.read();
  ASSERT_TRUE(config.pcp);
  EXPECT_EQ(500, config.pcp->invoke_address);
  EXPECT_EQ(600, config.pcp->result_address);
  EXPECT_FALSE(config.pcp->result_in_input_registers || config.pcp->swapped);
  EXPECT_TRUE(config.pcp->initiate);
  EXPECT_EQ(seconds(2.0), config.pcp->timeout);
  EXPECT_EQ(7u, blockWords(config.pcp->invoke));
  EXPECT_EQ(7u, blockWords(config.pcp->result));
  EXPECT_EQ(3, config.drives[0].communication_reference) << "by the places in the ring";
  EXPECT_EQ(2, config.drives[1].communication_reference);
}

TEST(InterbusConfig, PcpTakesWhatIsGiven) {
  test::InterbusSettings settings;
  settings.bus.set("pcp/invoke/address", 500).set("pcp/invoke/data", 8).set("pcp/result/address", 500);
  settings.bus.set("pcp/result/function", 4).set("pcp/result/error", 3).set("pcp/result/additional", 2);
  settings.bus.set("pcp/initiate", false).set("pcp/timeout", 0.5).set("pcp/first_reference", 10);
  settings.bus.set("word_order", std::string{"swapped"});
  settings.drive(0).set("communication_reference", 40);
  const InterbusConfig config = settings.read();
  EXPECT_EQ(8u, config.pcp->invoke.data);
  EXPECT_EQ(3u, config.pcp->result.error);
  EXPECT_TRUE(config.pcp->result_in_input_registers && config.pcp->swapped && !config.pcp->initiate);
  EXPECT_EQ(seconds(0.5), config.pcp->timeout);
  EXPECT_EQ(40, config.drives[0].communication_reference);
  EXPECT_EQ(11, config.drives[1].communication_reference);
}

TEST(InterbusConfig, PcpThatCannotBeIsRefused) {
  const auto refusal = [](const std::function<void(test::InterbusSettings&)>& change) {
    test::InterbusSettings settings;
    settings.bus.set("outputs/address", 100).set("watchdog/address", 300).set("watchdog/value", 500);
    settings.bus.set("pcp/invoke/address", 500).set("pcp/result/address", 600);
    change(settings);
    return settings.refusal();
  };
  EXPECT_EQ("accepted", refusal([](auto&) {}));
  EXPECT_THAT(
      refusal([](auto& s) { s.bus.set("pcp/invoke/address", 95); }),
      StartsWith(
          "~bus/pcp/invoke/address: 95 is not valid, expected registers outside the output image, which takes 100 "));
  EXPECT_THAT(refusal([](auto& s) { s.bus.set("pcp/invoke/address", 294); }), HasSubstr("that of the watchdog, 300"));
  EXPECT_THAT(refusal([](auto& s) { s.bus.set("pcp/result/address", 506); }), HasSubstr("outside the invoke block"));
  for (const char* key : {"pcp/invoke/address", "pcp/result/address"}) {
    EXPECT_EQ("~bus/" + std::string(key) + ": 65530 is not valid, expected a block that ends at register 65535 at most",
              refusal([key](auto& s) { s.bus.set(key, 65530); }));
  }
  EXPECT_EQ("~bus/pcp/invoke/data: 3 lies in sub_index, expected a word of its own",
            refusal([](auto& s) { s.bus.set("pcp/invoke/data", 3); }));
  EXPECT_THAT(refusal([](auto& s) { s.bus.set("pcp/result/function", 16); }), StartsWith("~bus/pcp/result/function"));
  EXPECT_EQ("~drives/drive1/communication_reference: 2 is not valid, expected one of its own: drive drive0 has it",
            refusal([](auto& s) { s.drive(1).set("communication_reference", 2); }));
  EXPECT_THAT(refusal([](auto& s) { s.drive(1).set("communication_reference", 1); }), HasSubstr("expected"));
}

TEST(InterbusConfig, ALongImageIsSplitBetweenDrives) {
  Ring ring{64};
  const InterbusConfig config = ring.read();
  EXPECT_THAT(config.server.inputs.parts, ElementsAre(WordRange{0, 124}, WordRange{124, 4}));
  EXPECT_THAT(config.server.outputs.parts, ElementsAre(WordRange{0, 122}, WordRange{122, 6}));
}

}  // namespace
}  // namespace nord_driver
