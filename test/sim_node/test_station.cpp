#include <vector>

#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSilence{300};
const char* const kHere = "10 01 08 00 09 16";

class Station : public SimNodeTest {};

// Unplugged it is silent and has no mains; plugged in it answers.
TEST_F(Station, Unplug) {
  EXPECT_EQ(kHere, bus->askStatus());
  EXPECT_EQ("yes, left: unplugged: the module is silent, the mains are off", set("left/unplug", true));
  EXPECT_EQ("", bus->askStatus(kSilence));
  EXPECT_FALSE(truth().powered);
  EXPECT_EQ("yes, left: plugged in", set("left/unplug", false));
  EXPECT_EQ(kHere, bus->askStatus());
}

// Muted it works and is not heard.
TEST_F(Station, Mute) {
  EXPECT_EQ("yes, left: answers are lost", set("left/mute", true));
  const std::uint64_t before = truth().telegrams;
  EXPECT_EQ("", bus->askStatus(kSilence));
  EXPECT_TRUE(eventually([&](const SimDrive& now) { return now.telegrams == before + 1; }))
      << "however late it was heard";
  EXPECT_EQ("yes, left: answers get through", set("left/mute", false));
  EXPECT_EQ(kHere, bus->askStatus());
}

// The module lives on its 24 V: the exchange goes on with zeros while the inverter is off (BU 0020 2.1.3).
TEST_F(Station, PowerInverter) {
  bus->startUp();
  EXPECT_EQ("0B 31 00 00", bus->pzdUntil("047E 0000", "0B 31 00 00"));
  EXPECT_EQ("yes, left: mains of the inverter off, the module lives on 24 V", set("left/power_inverter", false));
  EXPECT_EQ("00 00 00 00", bus->pzd("047E 0000"));
  EXPECT_TRUE(truth().in_data_exchange);
  EXPECT_EQ("yes, left: mains of the inverter on", set("left/power_inverter", true));
  EXPECT_EQ("0B 31 00 00", bus->pzdUntil("047E 0000", "0B 31 00 00"));
}

// The 24 V of a module with slots: off, its station is silent. A module of one's own has no supply of that kind.
TEST_F(Station, PowerModule) {
  const std::vector<std::uint8_t> is_there{0x10, 0x09, 0x01, 0x49, 0x53, 0x16};
  const std::vector<std::uint8_t> diagnosis{0x68, 0x05, 0x05, 0x68, 0x89, 0x81, 0x6D, 0x3C, 0x3E, 0xF1, 0x16};
  EXPECT_EQ("68 0B 0B 68 81 89 08 3E 3C 02 05 00 FF 0B A8 45 16", bus->ask(diagnosis));
  EXPECT_EQ("yes, lift: 24 V of its module off, the station is silent", set("lift/power_module", false));
  EXPECT_EQ("", bus->ask(is_there, kSilence));
  EXPECT_EQ("yes, lift: 24 V of its module on", set("lift/power_module", true));
  EXPECT_EQ("10 01 09 00 0A 16", bus->ask(is_there));
  EXPECT_EQ("no, left: has a module of its own; unplug takes the power from both", set("left/power_module", false));
  EXPECT_EQ(kHere, bus->askStatus());
}

// The connection between module and inverter broken: E10.8 in the inverter, zeros from the module.
TEST_F(Station, ModuleLink) {
  bus->startUp();
  bus->pzdUntil("047E 0000", "0B 31 00 00");
  EXPECT_EQ("yes, left: the connection between module and inverter is interrupted", set("left/module_link", false));
  EXPECT_EQ("00 00 00 00", bus->pzd("047E 0000"));
  EXPECT_EQ(108, truth().fault_number);
  EXPECT_EQ("yes, left: module and inverter are connected", set("left/module_link", true));
  EXPECT_EQ("0B 38 00 00", bus->pzd("047E 0000"));
}

// Answers as late as asked for; parameters as many telegrams late.
TEST_F(Station, AnswerDelay) {
  SimAnswerDelay::Request request;
  request.seconds = 0.1;
  request.parameter_cycles = 2;
  EXPECT_EQ("left: answers 0.1 s late, parameters 2 telegrams late",
            call<SimAnswerDelay>("left/answer_delay", request).message);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(kHere, bus->askStatus());
  EXPECT_LE(milliseconds(100), std::chrono::steady_clock::now() - start);
  bus->startUp();
  const auto read = [&] { return bus->exchange("1451 0000 0000 0000", "047E 0000").substr(0, 23); };
  for (int i = 0; i < 3; ++i) EXPECT_EQ("00 00 00 00 00 00 00 00", read());
  EXPECT_EQ("14 51 00 00 00 00 01 F4", read());

  request.seconds = 61.0;
  const auto refused = call<SimAnswerDelay>("left/answer_delay", request);
  EXPECT_FALSE(refused.success);
  EXPECT_EQ("left: seconds is 61; expected 0 to 60", refused.message);
}

}  // namespace
}  // namespace nord_driver::sim_node
