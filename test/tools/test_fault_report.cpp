// What nord_param faults tells, of a simulated drive and of a catalogue with more in it than the manuals say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "catalogue/shipped.h"
#include "tools/fault_report.h"
#include "tools/linked_drive.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::uint16_t kOvercurrent = 40, kWatchdog = 102;
const std::atomic<bool> kNotAsked{false};

// The one of the drive that stands; cause and remedy are those of the files of its series.
TEST(FaultReport, TellsTheFaultThatStands) {
  LinkedDrive drive;
  drive.connect();
  drive.left().inverter().trip(kOvercurrent, true);
  const FaultReport report = readFaults(drive.link(), kNotAsked);
  EXPECT_EQ(kOvercurrent, report.error.raw);
  EXPECT_EQ("E4.0", report.error.label);
  EXPECT_THAT(report.error.name, Not(IsEmpty()));
  EXPECT_THAT(report.error.cause, Not(IsEmpty()));
  EXPECT_THAT(report.error.remedy, Not(IsEmpty()));
  EXPECT_EQ(0, report.warning.raw);
  ASSERT_EQ(5u, report.last.size());
  EXPECT_EQ(kOvercurrent, report.last[0].raw);
  EXPECT_EQ(0, report.last[1].raw);
  EXPECT_THAT(report.note, IsEmpty());
  const std::string text = faultText(report, drive.link());
  EXPECT_THAT(text, HasSubstr("drive left, PROFIBUS station 3, sk5xxe\n"));
  EXPECT_THAT(text, HasSubstr("current error     E4.0  " + report.error.name + "\n"));
  EXPECT_THAT(text, HasSubstr("remedy  " + report.error.remedy + "\n"));
  EXPECT_THAT(text, HasSubstr("current warning   none\n"));
  EXPECT_THAT(text, Not(HasSubstr("last fault 2"))) << "there was none before";
}

// A guest comes to a drive at rest; one in fault is at rest.
TEST(FaultReport, ComesToADriveInFault) {
  LinkedDrive drive;
  drive.connect();
  drive.left().inverter().trip(kOvercurrent, true);
  for (int i = 0; i < 3; ++i) drive.link().read({105, 0, 0});
  drive.link().finish();
  EXPECT_EQ("", drive.trouble());
  EXPECT_EQ(kOvercurrent, readFaults(drive.link(), kNotAsked).error.raw);
}

// Newest first, the one before it second.
TEST(FaultReport, TellsTheLastFaults) {
  LinkedDrive drive({{701, 0, 0, kWatchdog}});
  drive.connect();
  drive.left().inverter().trip(kOvercurrent, false);
  const FaultReport report = readFaults(drive.link(), kNotAsked);
  EXPECT_EQ(kOvercurrent, report.last[0].raw);
  EXPECT_EQ(kWatchdog, report.last[1].raw);
  EXPECT_EQ("E10.2", report.last[1].label);
}

// Numbers of their own: what the files say of faults is not about them.
TEST(FaultReport, TellsAWarningWithoutTheWordsOfAFault) {
  LinkedDrive drive;
  drive.connect();
  drive.left().inverter().setWarning(21);
  const FaultReport report = readFaults(drive.link(), kNotAsked);
  EXPECT_EQ(21, report.warning.raw);
  EXPECT_EQ("2.1", report.warning.label);
  EXPECT_THAT(report.warning.name, IsEmpty());
  EXPECT_THAT(faultText(report, drive.link()), HasSubstr("current warning   2.1\n"));
}

// A crashed master has left 047F: the guest's 047E acknowledges by taking the enable away (BU 0020 8), and that is said.
TEST(FaultReport, SaysThatItsComingHasAcknowledged) {
  LinkedDrive drive;
  drive.segment().run(std::chrono::seconds{1});
  sim::InverterModel& inverter = drive.left().inverter();
  for (const std::uint16_t word : {std::uint16_t{0x047E}, std::uint16_t{0x047F}}) {
    sim::ProcessData data;
    data.control = word;
    inverter.receive(data);
    drive.segment().run(std::chrono::seconds{1});
  }
  inverter.trip(kOvercurrent, false);
  drive.segment().run(std::chrono::seconds{1});
  drive.connect();
  const FaultReport report = readFaults(drive.link(), kNotAsked);
  EXPECT_EQ(0, report.error.raw);
  EXPECT_EQ(kOvercurrent, report.last[0].raw);
  EXPECT_THAT(report.note, HasSubstr("drive left was in fault when this program came"));
}

TEST(FaultReport, IsOneObjectForPrograms) {
  LinkedDrive drive;
  drive.connect();
  drive.left().inverter().trip(kWatchdog, true);
  const FaultReport report = readFaults(drive.link(), kNotAsked);
  const YAML::Node json = YAML::Load(faultJson(report, drive.link()));
  EXPECT_EQ("left", json["drive"].as<std::string>());
  EXPECT_EQ(10.2, json["error"]["number"].as<double>());
  EXPECT_EQ("E10.2", json["error"]["label"].as<std::string>());
  EXPECT_EQ(0.0, json["warning"]["number"].as<double>());
  EXPECT_EQ(5u, json["last"].size());
}

// A drive with two faults and what it stored with them; everything else is refused.
class StoringDrive final : public DriveParameters {
 public:
  explicit StoringDrive(const catalogue::Catalogues& catalogues) : known_(catalogues, series(), {}) {}

  ParameterAnswer read(const catalogue::ParameterAddress& address) override {
    ParameterAnswer answer;
    answer.refused = true;
    answer.message = "drive left refuses it";
    answer.entry = known_.find(address.number);
    if (address.number == 701 && address.index <= 2) answer.raw = address.index == 1 ? kOvercurrent : kWatchdog;
    if (address.number == 702) answer.raw = 100 * address.index;
    answer.success = answer.raw != 0;
    answer.value = catalogue::valueOf(answer.entry, answer.raw, address.index);
    return answer;
  }
  ParameterAnswer write(const catalogue::ParameterAccess&) override { return {}; }
  const std::string& name() const override { return name_; }
  profile::Series series() const override { return profile::Series::kSk5xxe; }
  DriveIdentity identity() const override { return {}; }
  const catalogue::DriveCatalogue& known() const override { return known_; }

 private:
  std::string name_ = "left";
  catalogue::DriveCatalogue known_;
};

// A user's file describes P702, which the bus manuals do not.
TEST(FaultReport, TellsWhatWasStoredWithEachFault) {
  const std::string own = ::testing::TempDir() + "fault_report_own.yaml";
  std::ofstream(own) << "devices: [sk5xxe]\nparameters:\n"
                        "  - {number: 702, name: Frequency at the last fault, unit: Hz, resolution: 0.1, elements: 5,"
                        " read_only: true, source: [a test]}\n";
  const catalogue::Catalogues catalogues = catalogue::loadCatalogues(NORD_DRIVER_SOURCE_DIR "/config", {own});
  std::remove(own.c_str());
  StoringDrive drive{catalogues};
  const FaultReport report = readFaults(drive, kNotAsked);
  ASSERT_EQ(1u, report.last[0].values.size());
  EXPECT_EQ("Frequency at the last fault", report.last[0].values[0].name);
  EXPECT_DOUBLE_EQ(10.0, report.last[0].values[0].value);
  EXPECT_DOUBLE_EQ(20.0, report.last[1].values[0].value);
  EXPECT_THAT(faultText(report, drive), HasSubstr("Frequency at the last fault = 10.0 Hz\n"));
  EXPECT_THAT(faultText(report, drive), HasSubstr("current error     not told: drive left refuses it\n"));
  EXPECT_THAT(faultText(report, drive), HasSubstr("last fault 3      not told: drive left refuses it\n"));
}

TEST(FaultReport, EndsWhenAsked) {
  LinkedDrive drive;
  drive.connect();
  const std::atomic<bool> asked{true};
  EXPECT_THROW(readFaults(drive.link(), asked), Trouble);
}

}  // namespace
}  // namespace nord_driver::tools
