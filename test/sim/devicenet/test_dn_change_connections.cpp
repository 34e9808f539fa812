// Change of state and cyclic by connection objects 4 and 2 of class 5, or by 4 alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using Texts = DnConversation::Texts;

/// Allocates explicit and change of state, or another choice.
void allocate(DnConversation& bus, const std::string& choice = "11") {
  bus.goOnline();
  ASSERT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 " + choice + " 0A"));
}

/// Sizes and rates of both, as a scanner does it that knows of both.
void connect(DnConversation& bus, const std::string& choice = "11") {
  allocate(bus, choice);
  for (const char* order : {"0E 05 04 07", "0E 05 02 01", "0E 05 02 08", "10 05 04 09 64 00", "10 05 02 09 64 00"}) {
    bus.ask(std::string{"44C#0A "} + order);
  }
  bus.send("44A#");
}

enum class Words { kIdle, kNone };

/// Each production is acknowledged; idle words every 10 ms, or none.
void acknowledging(DnConversation& bus, Duration span, Words words = Words::kIdle) {
  for (const Instant end = bus.bus.now() + span; bus.bus.now() < end;) {
    if (words == Words::kIdle) bus.send("44D#00 7E 04 00 00");
    for (const std::string& text : bus.takeAfter(milliseconds(10))) {
      if (text.substr(0, 4) == "349#") bus.send("44A#");
    }
  }
}

std::string attribute(DnConversation& bus, const std::string& which) {
  bus.askAll("44C#0A 0E 05 " + which, Duration{0});
  for (const std::string& text : bus.takeAfter(milliseconds(20))) {
    if (text.substr(0, 6) == "44B#0A") return text.substr(6);
  }
  return "";
}

// 4 produces Dh and consumes the acknowledge (4xxh|2); 2 consumes our data (4xxh|5) and produces the acknowledge Fh.
TEST(DnChangeConnections, TwoObjects) {
  DnConversation bus;
  allocate(bus);
  EXPECT_EQ("8E4903", attribute(bus, "04 04")) << "349h";
  EXPECT_EQ("8E4A04", attribute(bus, "04 05")) << "44Ah";
  EXPECT_EQ("8E0500", attribute(bus, "04 07"));
  EXPECT_EQ("8E0000", attribute(bus, "04 08"));
  EXPECT_EQ("8E0000", attribute(bus, "04 0F")) << "no path of what it consumes";
  EXPECT_EQ("8E01", attribute(bus, "02 01")) << "configuring";
  EXPECT_EQ("8EC903", attribute(bus, "02 04")) << "3C9h";
  EXPECT_EQ("8E4D04", attribute(bus, "02 05")) << "44Dh";
  EXPECT_EQ("8E0000", attribute(bus, "02 07"));
  EXPECT_EQ("8E0500", attribute(bus, "02 08"));
  EXPECT_EQ("8E0000", attribute(bus, "02 0D")) << "no path of what it produces";
  EXPECT_EQ("9416FF", attribute(bus, "03 01")) << "no bit strobe";
}

// Each runs from its own rate on: 4 sends inputs, and nobody takes words before 2 has its rate.
TEST(DnChangeConnections, ObjectTwoWithoutItsRateTakesNoWords) {
  DnConversation bus{dnGateway()};
  allocate(bus);
  EXPECT_EQ("8E01", attribute(bus, "02 01"));
  bus.ask("44C#0A 10 05 04 09 64 00");
  acknowledging(bus, milliseconds(1000));
  EXPECT_EQ(0u, bus.module().counters().polls);
  EXPECT_LE(10u, bus.module().counters().productions);
  EXPECT_EQ(InverterState::kSwitchOnDisabled, bus.drive().inverter().state());
  EXPECT_LE(1u, bus.referee().count(DnRule::kIoBeforePacketRate)) << bus.referee().report();
  EXPECT_EQ("8E01", attribute(bus, "02 01")) << "configuring all the time";
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
}

// Its time-out is its own: acknowledges alone, however long they come, do not keep the words alive.
TEST(DnChangeConnections, AcknowledgesAloneDoNotKeepTheWordsAlive) {
  for (const char* choice : {"11", "21"}) {
    DnConversation bus{dnGateway()};
    connect(bus, choice);
    acknowledging(bus, milliseconds(600));
    EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive().inverter().state()) << choice;
    EXPECT_LE(55u, bus.module().counters().polls);
    EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
    acknowledging(bus, milliseconds(360), Words::kNone);
    EXPECT_EQ(0, bus.drive().inverter().faultNumber()) << choice;
    acknowledging(bus, milliseconds(60), Words::kNone);
    EXPECT_EQ(102, bus.drive().inverter().faultNumber()) << choice << ": E10.2, four times 100 ms";
    EXPECT_EQ("8E04", attribute(bus, "02 01")) << "timed out";
    EXPECT_EQ("8E03", attribute(bus, "04 01"));
  }
}

// And the other way round: who acknowledges nothing ends the inputs, which is told like any I/O connection that is over.
TEST(DnChangeConnections, WordsAloneDoNotKeepTheInputsAlive) {
  DnConversation bus{dnGateway()};
  connect(bus);
  bus.poll("44D#00 7E 04 00 00", milliseconds(360));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  bus.poll("44D#00 7E 04 00 00", milliseconds(60));
  EXPECT_EQ("8E04", attribute(bus, "04 01"));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
}

// With acknowledges suppressed object 4 hears nothing, and is not watched.
TEST(DnChangeConnections, WithoutAcknowledgesTheWordsAloneAreWatched) {
  DnConversation bus{dnGateway()};
  connect(bus, "51");
  bus.poll("44D#00 7E 04 00 00", milliseconds(2000));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  bus.bus.run(milliseconds(410));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
}

// Without object 2: 4 consumes our data, and says so; its one time-out is fed by either.
TEST(DnChangeConnections, ObjectFourAlone) {
  SimConfig config = dnGateway();
  DnModuleSettings settings;
  settings.mac = 9;
  settings.cos_instance_4_alone = true;
  config.bus.as<DnBusConfig>().modules.push_back(settings);
  DnConversation bus{config};
  allocate(bus);
  EXPECT_EQ("9416FF", attribute(bus, "02 01")) << "no such object";
  EXPECT_EQ("9416FF", attribute(bus, "02 08"));
  EXPECT_EQ("8E4D04", attribute(bus, "04 05")) << "44Dh";
  EXPECT_EQ("8E0500", attribute(bus, "04 07"));
  EXPECT_EQ("8E0500", attribute(bus, "04 08"));
  bus.ask("44C#0A 10 05 04 09 64 00");
  acknowledging(bus, milliseconds(600));
  EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive().inverter().state());
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.bus.run(milliseconds(410));
  EXPECT_EQ(102, bus.drive().inverter().faultNumber());
  EXPECT_EQ("8E04", attribute(bus, "04 01"));
}

// A poll beside it shares object 2, which goes with the last of the two.
TEST(DnChangeConnections, APollSharesObjectTwo) {
  DnConversation bus;
  allocate(bus, "13");
  EXPECT_EQ("8E0500", attribute(bus, "02 07")) << "a poll is answered with the inputs";
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 10"));
  EXPECT_EQ("9416FF", attribute(bus, "04 01"));
  EXPECT_EQ("8E01", attribute(bus, "02 01"));
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 02"));
  EXPECT_EQ("9416FF", attribute(bus, "02 01"));
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 50 0A")) << "without acknowledges";
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 10"));
  EXPECT_EQ("9416FF", attribute(bus, "02 01"));
  EXPECT_EQ(1, bus.module().connections().choice()) << "the suppression goes with it";
}

}  // namespace
}  // namespace nord_driver::sim
