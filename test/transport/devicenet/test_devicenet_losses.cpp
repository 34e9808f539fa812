// The DeviceNet transport when modules, the interface or others on the bus do what they should not, and as a guest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "profile/status_word.h"
#include "transport/devicenet/devicenet_rig.h"

namespace nord_driver {
namespace {

using profile::ParameterShape;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::readOf;
using Rig = test::DevicenetRig;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// --- Losses ----------------------------------------------------------------------------------------------------------

TEST(DeviceNetTransportTest, ASilentModuleIsNamedAndComesBack) {
  Rig rig{test::DevicenetSettings{2}};
  ASSERT_TRUE(rig.starts());
  rig.device(1).powerOff();
  EXPECT_LE(rig.until([&] { return !rig.inputs[1].inverter_answers; }), milliseconds{50});
  rig.run(milliseconds{300});
  EXPECT_TRUE(rig.inputs[0].inverter_answers);
  EXPECT_FALSE(rig.inputs[1].module_answers || rig.inputs[1].inverter_missing);
  EXPECT_EQ(1, rig.silences);
  EXPECT_STRNE("", rig.transport.note(1).text);
  rig.device(1).powerOn();
  EXPECT_LE(rig.until([&] { return rig.allAnswer(); }), seconds{2});
  EXPECT_EQ(0, rig.unasked);
  EXPECT_THAT(rig.violations(), IsEmpty());
}

// Nobody could have answered yet in the moment in which the duplicate-MAC check ends.
TEST(DeviceNetTransportTest, WiresAreSuspectedOnlyWhenTheModulesHadTimeToAnswer) {
  Rig rig;
  rig.device().powerOff();
  rig.until([&] { return rig.bus->sentTo("42E") > 0; });
  EXPECT_STREQ("can0 is open, and the modules are asked for the first time", rig.transport.busText().c_str());
  rig.run(milliseconds{900});
  EXPECT_THAT(rig.transport.busText().str(), HasSubstr("for the first time"));
  rig.run(milliseconds{150});
  EXPECT_THAT(rig.transport.busText().str(),
              HasSubstr("no device answers (asked: 5): are the modules and the bus powered"));
  EXPECT_THAT(rig.transport.busText().str(), HasSubstr("terminated? nord_param scan finds who is there"));
}

// It hears us, and we do not hear it. Where what stops it is set only after the connection counts as lost, it gets that stop
// word all the same.
TEST(DeviceNetTransportTest, AModuleThatIsNotHeardGetsItsStopWord) {
  for (const char* io : {"poll", "strobe", "cos", "cyclic"}) {
    for (const Duration drive_timeout : {milliseconds{50}, milliseconds{250}}) {
      test::DevicenetSettings settings{1};
      settings.drive().set("io", std::string{io});
      Rig rig{settings};
      ASSERT_TRUE(rig.starts()) << io;
      rig.outputs[0].control_word = 0x047F;
      rig.run(milliseconds{200});
      ASSERT_EQ(0x7F, rig.device().output[1]) << io;
      rig.device().unheard = true;
      rig.until([&] { return !rig.inputs[0].module_answers; });
      rig.run(drive_timeout);
      rig.outputs[0].control_word = 0x047E;
      rig.run(milliseconds{40});
      EXPECT_EQ(0x7E, rig.device().output[1]) << io << ", " << toSeconds(drive_timeout) << " s";
      EXPECT_EQ(0u, rig.device().io_deaths) << io;
    }
  }
}

// The stop word takes the enable away and so acknowledges a fault (BU 0020 8). The first answer may come too late for its cycle
// and before the next one: the fault in it is told before any word is sent that the inverter does not ignore.
TEST(DeviceNetTransportTest, AFaultInTheFirstAnswerIsToldBeforeAStopWordIsSent) {
  Rig rig;
  rig.device().deaf_to_io = true;
  rig.device().input = {0x00, 0x38, 0x0B, 0x00, 0x00};
  ASSERT_LT(rig.until([&] { return rig.bus->sentTo("42D") != 0; }), seconds{5});
  rig.bus->say("3C5#00380B0000");
  rig.device().deaf_to_io = false;
  rig.bus->seen.clear();
  rig.cycle();
  EXPECT_THAT(rig.bus->seen, Contains("> 42D#0000000000"));
  EXPECT_LT(rig.until([&] { return rig.inputs[0].inverter_answers; }), milliseconds{300});
  EXPECT_EQ(0u, std::count(rig.bus->seen.begin(), rig.bus->seen.end(), "> 42D#007E040000"));
  EXPECT_TRUE(profile::StatusWord{rig.inputs[0].input.status_word}.fault());
  rig.cycle();
  EXPECT_THAT(rig.bus->seen, Contains("> 42D#007E040000"));
}

// The same of a connection that was lost and came back between two cycles: what was told on the one before does not count.
TEST(DeviceNetTransportTest, AFaultInTheFirstDataOfAConnectionThatCameBackAtOnceIsToldBeforeAStopWordIsSent) {
  for (const char* io : {"cos", "cyclic"}) {
    test::DevicenetSettings settings{1};
    settings.drive().set("io", std::string{io});
    Rig rig{settings};
    ASSERT_TRUE(rig.starts()) << io;
    rig.run(milliseconds{200});
    const Instant start = rig.transport.now();
    rig.transport.exchange(rig.outputs, rig.inputs);
    ASSERT_TRUE(rig.inputs[0].inverter_answers) << io;
    rig.device().input = {0x00, 0x38, 0x0B, 0x00, 0x00};
    rig.bus->say("42B#05CE010001000300");
    const bool cyclic = rig.device().held == 0x21;
    rig.transport.sleepUntil(start + milliseconds{10});
    if (cyclic) rig.bus->say("345#00380B0000");
    ASSERT_TRUE(rig.device().established) << io;
    rig.bus->seen.clear();
    rig.cycle();
    EXPECT_THAT(rig.bus->seen, Contains("> 42D#0000000000")) << io;
    EXPECT_EQ(0, std::count(rig.bus->seen.begin(), rig.bus->seen.end(), "> 42D#007E040000")) << io;
    EXPECT_LT(rig.until([&] { return rig.inputs[0].inverter_answers; }), milliseconds{300}) << io;
    EXPECT_EQ(0, std::count(rig.bus->seen.begin(), rig.bus->seen.end(), "> 42D#007E040000")) << io;
    EXPECT_TRUE(profile::StatusWord{rig.inputs[0].input.status_word}.fault()) << io;
    rig.run(milliseconds{40});
    EXPECT_THAT(rig.bus->seen, Contains("> 42D#007E040000")) << io;
  }
}

TEST(DeviceNetTransportTest, AConnectionReleasedByOthersIsUnasked) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  // Somebody with our MAC id in its header takes the poll connection away.
  rig.bus->say("42E#004C030102");
  rig.device().held = 0x01;
  rig.device().established = false;
  EXPECT_LE(rig.until([&] { return rig.unasked > 0; }), milliseconds{300});
  EXPECT_EQ(0, rig.silences);
}

TEST(DeviceNetTransportTest, AShutdownMessageIsUnaskedAndTold) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  rig.bus->say("42B#05CE010001000300");
  rig.cycle();
  rig.cycle();
  EXPECT_EQ(1, rig.unasked);
  EXPECT_THAT(rig.told, Contains(HasSubstr("MAC id 5: says that it shuts down")));
}

// Who has been off the bus checks its MAC id again.
TEST(DeviceNetTransportTest, BusOffEndsTheExchangeUntilTheMacIsCheckedAgain) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  rig.bus->controller = link::CanState::kBusOff;
  rig.cycle();
  rig.cycle();
  EXPECT_FALSE(rig.transport.connected());
  EXPECT_FALSE(rig.inputs[0].module_answers);
  EXPECT_EQ(1, rig.silences);
  EXPECT_EQ("can0: the controller is bus-off", rig.transport.busText().str());
  rig.run(seconds{1});
  rig.bus->controller = link::CanState::kActive;
  const Duration took = rig.until([&] { return rig.allAnswer(); });
  EXPECT_GE(took, milliseconds{1990});
  EXPECT_LE(took, milliseconds{2300});
}

TEST(DeviceNetTransportTest, AnInterfaceThatWasPulledIsOpenedAgain) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  rig.bus->present = false;
  rig.run(seconds{1});
  EXPECT_FALSE(rig.transport.connected());
  EXPECT_STREQ("the CAN interface is not open", rig.transport.note(0).text);
  rig.bus->present = true;
  EXPECT_LE(rig.until([&] { return rig.allAnswer(); }), milliseconds{2800});
}

// --- Others on the bus -----------------------------------------------------------------------------------------------

TEST(DeviceNetTransportTest, ADeviceWithOurMacIdIsACommunicationFault) {
  Rig rig;
  rig.run(milliseconds{500});
  rig.bus->say("407#80850178563412");
  rig.run(milliseconds{100});
  EXPECT_THAT(rig.transport.busText().str(), HasSubstr("another device has our MAC id 0"));
  EXPECT_THAT(rig.transport.note(0).text, HasSubstr("communication fault"));
  EXPECT_EQ(0u, rig.bus->sentTo("42E"));
  EXPECT_TRUE(rig.starts()) << "it is checked again";
}

// Its modules are not taken away from a scanner that has them.
TEST(DeviceNetTransportTest, AModuleOfAnotherScannerIsNamedAndLeftAlone) {
  Rig rig;
  rig.device().belongsTo(17, 0x03, rig.transport.now());
  rig.until([&] { return rig.transport.busText().str().find("another master") != std::string::npos; });
  rig.cycle();
  EXPECT_EQ("MAC id 5 is allocated to another master, MAC id 17", rig.transport.busText().str());
  EXPECT_STREQ("is allocated to another master, MAC id 17", rig.transport.note(0).text);
  EXPECT_EQ(0u, rig.bus->sentTo("42D"));
  EXPECT_EQ(0x03, rig.device().held);
}

// The module does what the last poll said, whoever sent it.
TEST(DeviceNetTransportTest, AModuleThatAnotherScannerPollsDoesNotCount) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  rig.bus->say("42D#007F040020");
  EXPECT_LE(rig.until([&] { return rig.inputs[0].interruption == Interruption::kContested; }), milliseconds{20});
  rig.cycle();
  EXPECT_EQ(Interruption::kNone, rig.inputs[0].interruption) << "said once";
  EXPECT_FALSE(rig.inputs[0].inverter_answers || rig.inputs[0].inverter_missing);
  EXPECT_STREQ("another scanner works with it, too: end one of the two", rig.transport.note(0).text);
  EXPECT_THAT(rig.transport.busText().str(), HasSubstr("another master is on the bus"));
  const Duration away = rig.until([&] { return rig.allAnswer(); });
  EXPECT_GE(away, milliseconds{900});
  EXPECT_LE(away, milliseconds{1100});
}

// A scanner that has it in its list, too, and is refused tries again every second: nobody but this one works with it.
TEST(DeviceNetTransportTest, AnotherScannerThatIsRefusedTakesNothingAway) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  for (int second = 0; second < 5; ++second) {
    rig.bus->say("42E#014B03010101");
    rig.bus->say("42B#01940B02");
    for (int cycle = 0; cycle < 50; ++cycle) {
      rig.cycle();
      ASSERT_TRUE(rig.inputs[0].inverter_answers) << second << " s, cycle " << cycle;
    }
    EXPECT_THAT(rig.transport.busText().str(), HasSubstr("another master, MAC id 1, is on the bus"));
  }
}

// It would be told what to do by two, as soon as that one has its connection.
TEST(DeviceNetTransportTest, AModuleThatAnotherScannerIsGrantedDoesNotCount) {
  Rig rig;
  ASSERT_TRUE(rig.starts());
  rig.bus->say("42E#014B03010101");
  rig.bus->say("42B#01CB00");
  rig.cycle();
  rig.cycle();
  EXPECT_FALSE(rig.inputs[0].inverter_answers);
}

TEST(DeviceNetTransportTest, AModuleWithAnotherAssemblyIsNotPolled) {
  Rig rig;
  rig.device().produced = rig.device().consumed = 8;
  rig.until([&] { return rig.transport.busText().str().find("bytes") != std::string::npos; });
  rig.cycle();
  EXPECT_THAT(rig.transport.note(0).text,
              HasSubstr("sends 8 and takes 8 bytes of process data by poll; 5 and 5 are configured; P160 selects"));
  EXPECT_EQ(0u, rig.bus->sentTo("42D"));
}

// --- For parameters only ---------------------------------------------------------------------------------------------

// No process data are exchanged: nothing starts P151, and the end trips nobody.
TEST(DeviceNetGuestTest, ReadsWithoutExchangingProcessData) {
  Rig rig{test::DevicenetSettings{1}, true};
  EXPECT_THAT(rig.until([&] { return rig.allAnswer(); }), ::testing::Lt(seconds{3}));
  EXPECT_EQ(profile::DriveState::kReadyToSwitchOn, profile::StatusWord{rig.inputs[0].input.status_word}.state());
  EXPECT_EQ(500, rig.ask(readOf(105, ParameterShape::kPerSet)).raw);
  EXPECT_EQ(0u, rig.bus->sentTo("42D"));
  EXPECT_EQ(0x01, rig.device().held);
  rig.device().attributes[{41, 1, 6}] = {4};
  rig.run(milliseconds{400});
  EXPECT_EQ(profile::DriveState::kOperationEnabled, profile::StatusWord{rig.inputs[0].input.status_word}.state());
  EXPECT_EQ("", rig.transport.identity(0).protected_by);
  rig.transport.close();
  EXPECT_EQ(0x00, rig.device().held) << "released";
}

// What a module was asked before it was switched off it does not answer afterwards: nothing is waited for.
TEST(DeviceNetGuestTest, AnInverterIsThereSoonAfterItsModule) {
  for (const Duration off : {milliseconds{1000}, milliseconds{1500}, milliseconds{2000}, milliseconds{3000}}) {
    Rig rig{test::DevicenetSettings{1}, true};
    ASSERT_TRUE(rig.starts());
    rig.run(seconds{1});
    rig.device().powerOff();
    rig.run(off);
    rig.device().powerOn();
    EXPECT_LE(rig.until([&] { return rig.inputs[0].module_answers; }), seconds{1}) << toSeconds(off) << " s";
    EXPECT_LE(rig.until([&] { return rig.allAnswer(); }), seconds{1}) << toSeconds(off) << " s";
  }
}

// A driver that was killed may have left it turning: until its own time-out has stopped it, it is asked for nothing, and wires
// are not suspected.
TEST(DeviceNetGuestTest, SaysThatAModuleIsLeftToItsOwnTimeOut) {
  test::DevicenetSettings settings{1};
  settings.bus.set("expected_packet_rate", 1.0);
  Rig rig{settings, true};
  EXPECT_DOUBLE_EQ(4.5, rig.transport.identity(0).protection_time);
  rig.run(seconds{1});
  rig.device().wasPolledBy(0, 1000, rig.transport.now());
  rig.run(milliseconds{3500});
  EXPECT_THAT(rig.transport.busText().str(), HasSubstr("MAC id 5 is asked for nothing before its own time-out"));
  EXPECT_THAT(rig.transport.note(0).text, HasSubstr("is asked for nothing before its own time-out"));
  EXPECT_EQ(0u, rig.bus->sentTo("42E"));
  EXPECT_LT(rig.until([&] { return rig.allAnswer(); }), seconds{1});
  EXPECT_EQ(1u, rig.device().io_deaths);
  rig.transport.close();
  EXPECT_EQ(0x02, rig.device().held) << "its process data are not ours";
}

TEST(DeviceNetGuestTest, KeepsOffABusThatIsInUse) {
  Rig rig{test::DevicenetSettings{1}, true};
  rig.run(milliseconds{100});
  rig.bus->say("42D#007E040000");
  rig.run(seconds{5});
  EXPECT_THAT(rig.transport.busText().str(), HasSubstr("the bus is in use: 42Dh was seen"));
  for (const std::string& line : rig.bus->seen) EXPECT_NE('>', line[0]) << line;
}

}  // namespace
}  // namespace nord_driver
