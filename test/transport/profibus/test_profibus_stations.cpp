// Stations with several inverters: slots, offsets, and what a GSD file changes in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "support/map_settings.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;
using test::MapSettings;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Module {
  MapSettings& add(int inverter, int ppo_type, int address = 3) {
    const std::string name = "fi" + std::to_string(settings.size() + 1);
    settings.push_back(std::make_shared<MapSettings>("~drives/" + name + "/"));
    settings.back()->set("address", address).set("series", "sk2xxe").set("pole_pairs", 2).set("ppo_type", ppo_type);
    settings.back()->set("inverter", inverter);
    drives.push_back({name, settings.back()});
    return *settings.back();
  }
  ProfibusDpConfig read(double cycle_rate = 100.0) const { return readProfibusDpConfig(bus, drives, cycle_rate); }
  std::string configuration() const { return toHex(read().slaves.at(0).configuration); }
  std::string refusal(double cycle_rate = 100.0) const {
    try {
      read(cycle_rate);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  MapSettings bus{"~bus/", {{"device", std::string{"/dev/ttyUSB0"}}}};
  std::vector<std::shared_ptr<MapSettings>> settings;
  std::vector<DriveSettings> drives;
};

/// A file of its own for each test.
class GsdText {
 public:
  explicit GsdText(const std::string& text)
      : path_(testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".gsd") {
    std::ofstream{path_} << text;
  }
  ~GsdText() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// BU 0220 4.2.1, 4.2.2.4: slot 1 is 30h (I/O) or Empty, slots 2 to 5 are the inverters; P182: 245, 247, 241, 243.
TEST(ProfibusStations, SlotOneIsEmptyOrTheIoByte) {
  Module module;
  module.add(1, 1);
  EXPECT_EQ("00 F5", module.configuration());
  EXPECT_EQ(0u, module.read().drives[0].offset);
  module.settings[0]->set("io_byte", true);
  EXPECT_EQ("30 F5", module.configuration());
  EXPECT_EQ(1u, module.read().drives[0].offset);
  EXPECT_EQ(13u, module.read().slaves[0].output_length);
}

// Inverter 3 is not there: its slot is, and everything behind it moves by nothing.
TEST(ProfibusStations, GapsBetweenInvertersAreEmptySlots) {
  Module module;
  module.add(1, 2).set("io_byte", true);
  module.add(2, 3);
  module.add(4, 4);
  const ProfibusDpConfig config = module.read();
  ASSERT_EQ(1u, config.slaves.size());
  EXPECT_EQ("30 F7 F1 00 F3", toHex(config.slaves[0].configuration));
  EXPECT_EQ(1u, config.drives[0].offset);
  EXPECT_EQ(17u, config.drives[1].offset) << "PPO 2 is 16 bytes on this module";
  EXPECT_EQ(21u, config.drives[2].offset);
  EXPECT_EQ(29u, config.slaves[0].output_length);
  EXPECT_EQ(29u, config.slaves[0].input_length);
}

// The order in the file does not matter: the number says where an inverter is connected.
TEST(ProfibusStations, InvertersAreSortedByTheirNumber) {
  Module module;
  module.add(2, 3);
  module.add(1, 1);
  const ProfibusDpConfig config = module.read();
  EXPECT_EQ("00 F5 F1", toHex(config.slaves[0].configuration));
  EXPECT_EQ(12u, config.drives[0].offset);
  EXPECT_EQ(0u, config.drives[1].offset);
  EXPECT_THAT(config.stations[0].drives, ElementsAre(1, 0));
}

TEST(ProfibusStations, TheFirstSlotsMayBeEmpty) {
  Module module;
  module.add(3, 1);
  EXPECT_EQ("00 00 00 F5", module.configuration());
}

// Without a GSD file: DPV1_Enable, and nothing else (EN 50170-8: three bytes before the user's).
TEST(ProfibusStations, TheModuleSpeaksDpV1) {
  Module module;
  module.add(1, 1);
  const profibus::SlaveConfig slave = module.read().slaves[0];
  EXPECT_EQ(0x0BA8, slave.ident_number);
  EXPECT_EQ("80 00 00", toHex(slave.user_parameters));
  EXPECT_TRUE(slave.dpv1);
  module.settings[0]->set("user_parameters", "00 00 00 01");
  EXPECT_EQ("00 00 00 01", toHex(module.read().slaves[0].user_parameters));
  EXPECT_FALSE(module.read().slaves[0].dpv1) << "not switched on";
}

// BU 2700 3.1: SK 5xxE and 54xE are behind either, the others behind one of the two only.
TEST(ProfibusStations, TheSeriesDecidesWhichModuleItIsBehind) {
  for (const auto& [series, ident] : {std::pair{"sk1x0e", 0x0BA8},
                                      {"sk2xxe", 0x0BA8},
                                      {"sk5xxe", 0x7531},
                                      {"sk54xe", 0x7531},
                                      {"sk300e", 0x7531},
                                      {"sk700e", 0x7531}}) {
    Module module;
    module.add(1, 1).set("series", series);
    EXPECT_EQ(ident, module.read().slaves[0].ident_number) << series;
  }
  Module module;
  module.add(1, 1).set("series", "sk54xe").set("module", "sk_cu4");
  EXPECT_EQ(0x0BA8, module.read().slaves[0].ident_number);
  module.settings[0]->set("series", "sk300e");
  EXPECT_THAT(module.refusal(),
              HasSubstr("~drives/fi1/module: \"sk_cu4\" is not valid, expected sk_tu1, sk_tu2 or sk_tu3"));
  module.settings[0]->set("series", "sk2xxe").set("module", "sk_tu3");
  EXPECT_THAT(module.refusal(), HasSubstr("~drives/fi1/module: \"sk_tu3\" is not valid, expected sk_cu4"));
}

TEST(ProfibusStations, OnePlaceBehindAModuleIsOneDrives) {
  Module module;
  module.add(1, 1);
  module.add(1, 1);
  EXPECT_THAT(module.refusal(), HasSubstr("~drives/fi2/inverter: 1 is not valid, expected another number from 1 to 4 "
                                          "than drive \"fi1\" behind the same module has"));
  module.settings[1]->set("inverter", 5);
  EXPECT_THAT(module.refusal(), HasSubstr("~drives/fi2/inverter: 5 is not valid, expected a whole number from 1 to 4"));
  module.settings[1]->set("inverter", 2).set("series", "sk5xxe").set("module", "sk_tu3");
  EXPECT_NE("accepted", module.refusal());
}

// What belongs to the module is said once, or everywhere the same.
TEST(ProfibusStations, DrivesOfOneModuleMustNotContradictEachOther) {
  Module module;
  module.add(1, 1).set("io_byte", true);
  module.add(2, 1).set("io_byte", false);
  EXPECT_THAT(module.refusal(), HasSubstr("~drives/fi2/io_byte: false is not valid, expected true, as drive \"fi1\""));
  module.settings[1]->set("io_byte", true);
  EXPECT_EQ("accepted", module.refusal());
}

TEST(ProfibusStations, ModulesAreToldApartByTheirAddress) {
  Module module;
  module.add(1, 1, 3);
  module.add(1, 2, 4);
  const ProfibusDpConfig config = module.read();
  ASSERT_EQ(2u, config.slaves.size());
  EXPECT_EQ("00 F7", toHex(config.slaves[1].configuration));
  EXPECT_EQ(1u, config.drives[1].slave);
}

// --- GSD files -------------------------------------------------------------------------------------------------------

constexpr const char* kGsd = R"gsd(#Profibus_DP
GSD_Revision=3
Ident_Number=0x0BA8
500_supp=1
MaxTsdr_500=300
Min_Slave_Intervall=60
Modular_Station=1
Max_Module=5
DPV1_Slave=1
C1_Read_Write_supp=1
C1_Response_Timeout=25
User_Prm_Data_Len=5
User_Prm_Data=0,0,0,0x11,0x22
Module="PPO Type 2 (with reserve)" 0xF3,0xF5
EndModule
Module="PPO Type 1" 0xF5
Ext_User_Prm_Data_Const(0)=0x33
EndModule
)gsd";

// EN 50170-8: WD_Base_1ms, bit 2 of DPV1_Status_1, would make a watchdog of 0.2 s one of 20 ms.
TEST(ProfibusStations, TheWatchdogHasOneBase) {
  std::string text = kGsd;
  text.replace(text.find("=0,0,0,0x11"), 11, "=0x84,0,0,0x11");
  const GsdText gsd{text};
  Module module;
  module.bus.set("gsd", std::vector<std::string>{gsd.path()});
  module.add(1, 2);
  EXPECT_EQ("80 00 00 11 22", toHex(module.read().slaves[0].user_parameters));
  module.settings[0]->set("user_parameters", "84 00 00");
  EXPECT_THAT(module.refusal(), AllOf(HasSubstr("fi1/user_parameters: \"84 00 00\""), HasSubstr("WD_Base_1ms")));
}

// A module of the manual that the file has, too: with its parameters, in the order of the slots.
TEST(ProfibusStations, SlotsHaveTheParametersOfTheFile) {
  const GsdText gsd{std::string{kGsd} +
                    "Module=\"Empty\" 0x00\nExt_User_Prm_Data_Const(0)=0x44\nEndModule\n"
                    "Module=\"Profibus Module I/O\" 0x30\nExt_User_Prm_Data_Const(0)=0x55,0x66\nEndModule\n"};
  Module module;
  module.bus.set("gsd", std::vector<std::string>{gsd.path()});
  module.add(2, 1).set("io_byte", true);
  const profibus::SlaveConfig slave = module.read().slaves[0];
  EXPECT_EQ("30 00 F5", toHex(slave.configuration));
  EXPECT_EQ("80 00 00 11 22 55 66 44 33", toHex(slave.user_parameters));
}

// A GSD decides where the manuals contradict each other.
TEST(ProfibusStations, AGsdFileGivesParametersIdentifiersAndTimes) {
  const GsdText gsd{kGsd};
  Module module;
  module.bus.set("gsd", std::vector<std::string>{gsd.path()});
  module.add(1, 2);
  module.add(2, 1);
  const ProfibusDpConfig config = module.read();
  const profibus::SlaveConfig& slave = config.slaves[0];
  EXPECT_EQ("80 00 00 11 22 33", toHex(slave.user_parameters)) << "DPV1_Enable, then the module's own in slot order";
  EXPECT_TRUE(slave.dpv1);
  EXPECT_EQ(milliseconds{250}, slave.record_timeout);
  EXPECT_EQ("00 F3 F5 F5", toHex(slave.configuration));
  EXPECT_EQ(20u, config.drives[0].ppo.bytes()) << "two words without use more than the manual";
  EXPECT_EQ(20u, config.drives[1].offset);
  EXPECT_EQ(300u, config.bus.max_tsdr_bits);
  EXPECT_EQ(315u, config.bus.slot_bits);
  EXPECT_TRUE(config.warnings.empty());
}

// Max_Module counts modules, however many identifiers each has; what Max_Data_Len and its like count is bytes.
TEST(ProfibusStations, AModuleOfSeveralIdentifiersIsOneModule) {
  const GsdText gsd{
      "#Profibus_DP\nIdent_Number=0x7531\nModular_Station=0\nMax_Module=1\n"
      "Max_Input_Len=20\nMax_Output_Len=20\nMax_Data_Len=40\n"
      "Module=\"PPO 1\" 0xF3,0xF1\nEndModule\nModule=\"PPO 2\" 0xF3,0xF5\nEndModule\n"};
  for (const int ppo_type : {1, 2}) {
    Module module;
    module.bus.set("gsd", gsd.path().c_str());
    module.add(1, ppo_type).set("series", "sk5xxe").set("module", "sk_tu3");
    EXPECT_EQ("accepted", module.refusal()) << ppo_type;
  }
}

// The slot of the module's own inputs and outputs, one per inverter, an empty one before: modules, all of them.
TEST(ProfibusStations, MoreModulesThanTheGsdAllowsAreRefused) {
  const GsdText gsd{
      "#Profibus_DP\nIdent_Number=0x0BA8\nModular_Station=1\nMax_Module=3\n"
      "Module=\"PPO 1\" 0xF3,0xF1\nEndModule\n"};
  Module module;
  module.bus.set("gsd", gsd.path().c_str());
  module.add(1, 1);
  module.add(2, 1);
  EXPECT_EQ("accepted", module.refusal());
  Module beyond;
  beyond.bus.set("gsd", gsd.path().c_str());
  beyond.add(1, 1);
  beyond.add(3, 1);
  EXPECT_THAT(beyond.refusal(), HasSubstr("inverter: 4 modules are needed, expected at most 3 (" + gsd.path()));
}

// Max_User_Prm_Data_Len counts those of the modules, too: three for DP-V1, and one of each PPO 1.
TEST(ProfibusStations, MoreUserParametersThanTheGsdAllowsAreRefused) {
  const GsdText gsd{
      "#Profibus_DP\nIdent_Number=0x0BA8\nModular_Station=1\nMax_User_Prm_Data_Len=5\n"
      "DPV1_Slave=1\nC1_Read_Write_supp=1\n"
      "Module=\"PPO 1\" 0xF5\nExt_User_Prm_Data_Const(0)=0x33\nEndModule\n"};
  Module module;
  module.bus.set("gsd", gsd.path().c_str());
  module.add(1, 1).set("user_parameters", "80 00 00 01 02 03 04 05");
  EXPECT_THAT(module.refusal(),
              HasSubstr("~drives/fi1/user_parameters: Set_Prm would carry 8 bytes of station and modules, expected at "
                        "most 5 (Max_User_Prm_Data_Len of " +
                        gsd.path()));
  module.settings[0]->set("user_parameters", "80 00 00 01 02");
  EXPECT_EQ("accepted", module.refusal());
  Module from_file;
  from_file.bus.set("gsd", gsd.path().c_str());
  from_file.add(1, 1);
  from_file.add(2, 1);
  EXPECT_EQ("80 00 00 33 33", toHex(from_file.read().slaves[0].user_parameters));
  from_file.add(3, 1);
  EXPECT_THAT(from_file.refusal(), HasSubstr("~drives/fi1/user_parameters: Set_Prm would carry 6 bytes"));
}

// Set_Prm carries the defaults of station and modules.
TEST(ProfibusStations, AGsdFileGivesDefaultsOfParameters) {
  const GsdText gsd{
      "#Profibus_DP\nIdent_Number=0x0BA8\nModular_Station=1\n"
      "ExtUserPrmData=1 \"a\"\nBit(7) 1 0-1\nEndExtUserPrmData\n"
      "ExtUserPrmData=2 \"b\"\nUnsigned16 500 0-1000\nEndExtUserPrmData\n"
      "Ext_User_Prm_Data_Const(0)=0x01,0,0\nExt_User_Prm_Data_Ref(0)=1\n"
      "Module=\"PPO 1\" 0xF5\nExt_User_Prm_Data_Const(0)=0,0\nExt_User_Prm_Data_Ref(0)=2\nEndModule\n"};
  Module module;
  module.bus.set("gsd", gsd.path().c_str());
  module.add(1, 1);
  EXPECT_EQ("81 00 00 01 F4", toHex(module.read().slaves[0].user_parameters));
}

// MaxTsdr of 300 bit times at 500 kbit/s and a margin of 15: 0.63 ms.
TEST(ProfibusStations, ASlotTimeBelowMaxTsdrIsRefused) {
  const GsdText gsd{kGsd};
  Module module;
  module.bus.set("gsd", gsd.path().c_str()).set("slot_time", 0.0006);
  module.add(1, 1);
  EXPECT_THAT(module.refusal(), HasSubstr("~bus/slot_time: 0.0006 is not valid, expected at least 0.00063 s"));
}

// Min_Slave_Intervall 60 x 0.1 ms: not above 166 Hz.
TEST(ProfibusStations, ACycleShorterThanTheIntervalOfAModuleIsRefused) {
  const GsdText gsd{kGsd};
  Module module;
  module.bus.set("gsd", gsd.path().c_str());
  module.add(1, 1);
  EXPECT_EQ("accepted", module.refusal(160.0));
  EXPECT_THAT(module.refusal(170.0), HasSubstr("station 3 may be asked every 0.006 s only (Min_Slave_Intervall)"));
}

TEST(ProfibusStations, ARateTheModuleDoesNotHaveIsRefused) {
  const GsdText gsd{kGsd};
  Module module;
  module.bus.set("gsd", gsd.path().c_str()).set("baud_rate", 93750);
  module.add(1, 1);
  EXPECT_THAT(module.refusal(), AllOf(HasSubstr("~bus/baud_rate: 93750 is not valid"), HasSubstr("500000")));
}

// What is wrong in a file is named with its line; what it cannot give comes from the manual.
TEST(ProfibusStations, ErrorsInAGsdFileAreWarnings) {
  const GsdText gsd{"#Profibus_DP\nIdent_Number=0x0BA8\nMax_Module=many\nModule=\"Something\" 0x10\nEndModule\n"};
  Module module;
  module.bus.set("gsd", gsd.path().c_str());
  module.add(1, 1);
  const ProfibusDpConfig config = module.read();
  ASSERT_EQ(2u, config.warnings.size());
  EXPECT_THAT(config.warnings[0], HasSubstr(gsd.path() + ":3: "));
  EXPECT_THAT(config.warnings[1], HasSubstr("has no module that is PPO 1"));
  EXPECT_EQ("00 F5", toHex(config.slaves[0].configuration));
}

TEST(ProfibusStations, AGsdFileNobodyNeedsIsNamed) {
  const GsdText gsd{"#Profibus_DP\nIdent_Number=0x1234\n"};
  Module module;
  module.bus.set("gsd", gsd.path().c_str());
  module.add(1, 1);
  ASSERT_EQ(1u, module.read().warnings.size());
  EXPECT_THAT(module.read().warnings[0], HasSubstr("is not used: its ident number (1234h)"));
  EXPECT_EQ("80 00 00", toHex(module.read().slaves[0].user_parameters));
}

// A drive may name its file itself, whatever ident number stands in it.
TEST(ProfibusStations, ADriveMayNameItsGsdFile) {
  const GsdText gsd{"#Profibus_DP\nIdent_Number=0x1234\n"};
  Module module;
  module.add(1, 1).set("gsd", gsd.path().c_str());
  EXPECT_EQ(0x1234, module.read().slaves[0].ident_number);
  EXPECT_FALSE(module.read().slaves[0].dpv1) << "the file knows nothing of it";
}

TEST(ProfibusStations, OneDriveNamesTheFileForItsWholeModule) {
  const GsdText gsd{"#Profibus_DP\nIdent_Number=0x1234\n"};
  Module module;
  module.add(1, 1);
  module.add(2, 1).set("gsd", gsd.path().c_str());
  EXPECT_EQ(0x1234, module.read().slaves[0].ident_number);
  module.settings[0]->set("gsd", "other.gsd");
  EXPECT_THAT(module.refusal(), HasSubstr("~drives/fi2/gsd: " + gsd.path() + " is not valid, expected other.gsd, as "));
}

// A module that takes records may cost one of them a cycle: 23 octets there and back, 60 bit times for the slave and 37
// of idle time are 603 bits, 31.4 ms at 19.2 kbit/s. The exchange itself is 559 bits, the module's silence with one
// retry 2 x (231 bits + 20 ms).
TEST(ProfibusStations, AModuleThatTakesRecordsHasALongerWorstCycle) {
  Module module;
  module.bus.set("baud_rate", 19200).set("watchdog", 1.0);
  module.add(1, 1);
  EXPECT_NEAR(0.1246, toSeconds(module.read(20.0).worst_cycle), 0.0001);
  module.bus.set("watchdog", 0.1);
  EXPECT_THAT(module.refusal(20.0), HasSubstr("~bus/watchdog: 0.1 is not valid, expected at least 0.12"));
  module.settings[0]->set("user_parameters", "00 00 00");  // DPV1_Enable is not set: no records
  EXPECT_NEAR(0.0932, toSeconds(module.read(20.0).worst_cycle), 0.0001);
}

}  // namespace
}  // namespace nord_driver
