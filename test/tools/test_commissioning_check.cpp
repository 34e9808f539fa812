// The demo's robot with drives as they come from the factory, of every series: what the check finds, by hand from the
// manuals' factory settings, and that nothing is left once it was written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <memory>

#include "catalogue/shipped.h"
#include "config/yaml_settings.h"
#include "sim/profibus/simulated_segment.h"
#include "tools/commissioning_check.h"
#include "tools/commissioning_text.h"
#include "tools/parameter_link.h"
#include "tools/restore/scripted_drive.h"
#include "transport/profibus/profibus_dp.h"

namespace nord_driver::tools {
namespace {

using profile::Series;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// config/demo.yaml with drives of one series, and the simulated segment it runs on.
class DemoRobot {
 public:
  /// `parameters`: of both simulated drives, "P509: 0".
  DemoRobot(const std::string& series, const std::string& parameters, bool read_only = false) {
    file_ = YAML::LoadFile(std::string(NORD_DRIVER_SOURCE_DIR) + "/config/demo.yaml");
    file_["bus"]["slot_time"] = 0.0005;
    file_["read_only"] = read_only;
    for (const char* name : {"left", "right"}) {
      file_["drives"][name]["series"] = series;
      file_["drives"][name]["parameters"] = YAML::Load("{" + parameters + "}");
    }
    config_ = node::readNodeConfig(YamlSettings{"", file_});
    ProfibusDpTransport transport;
    drives_ = drivesToCheck(config_, node::configureTransport(config_, transport).identities, {},
                            catalogue::shippedCatalogues());
    segment_config_ = sim::readSimConfig(file_);
  }

  /// Connects to each drive in turn, as the program does.
  template <typename Task>
  void onEach(Task task) {
    for (CommissionedDrive& drive : drives_) {
      const ToolConfig config = readToolConfig(file_, drive.asked.name);
      ProfibusDpTransport transport([this](const link::SerialSettings&) {
        auto made = std::make_unique<Wire>(segment());
        return made;
      });
      ParameterLink link{config, transport, catalogue::shippedCatalogues()};
      link.connect(std::chrono::seconds{5}, not_asked_);
      task(drive, link);
      link.finish();
    }
  }
  commissioning::Findings check() {
    onEach([this](CommissionedDrive& drive, ParameterLink& link) { readFacts(drive, link, not_asked_); });
    return findingsIn(drives_);
  }
  void fix(const commissioning::Findings& findings, bool persistent = false) {
    onEach([&](CommissionedDrive& drive, ParameterLink& link) {
      for (const Fix& fix : fixesFor(drive, findings, persistent)) {
        const ParameterAnswer answer = link.write(fix.access);
        EXPECT_TRUE(answer.success) << fixText(fix) << ": " << answer.message;
      }
    });
  }
  const std::vector<CommissionedDrive>& drives() const { return drives_; }
  sim::SimulatedSegment& segment() {
    if (!segment_) segment_ = std::make_unique<sim::SimulatedSegment>(segment_config_);
    return *segment_;
  }

 private:
  /// The segment outlives the transports that open it.
  class Wire final : public link::ByteLink {
   public:
    explicit Wire(sim::SimulatedSegment& segment) : segment_(segment) {}
    bool open() noexcept override { return segment_.open(); }
    void close() noexcept override { segment_.close(); }
    bool isOpen() const noexcept override { return segment_.isOpen(); }
    bool write(ByteView telegram) noexcept override { return segment_.write(telegram); }
    std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
      return segment_.read(buffer, capacity);
    }
    void discardInput() noexcept override { segment_.discardInput(); }
    bool waitReadable(Instant until) noexcept override { return segment_.waitReadable(until); }
    void sleepUntil(Instant when) noexcept override { segment_.sleepUntil(when); }
    Instant now() const noexcept override { return segment_.now(); }
    bool keepsBaudRate() const noexcept override { return segment_.keepsBaudRate(); }
    const std::string& lastError() const noexcept override { return segment_.lastError(); }

   private:
    sim::SimulatedSegment& segment_;
  };

  YAML::Node file_;
  node::NodeConfig config_;
  std::vector<CommissionedDrive> drives_;
  sim::SimConfig segment_config_;
  std::unique_ptr<sim::SimulatedSegment> segment_;
  std::atomic<bool> not_asked_{false};
};

/// "left bus_has_control 0 -> 4".
std::vector<std::string> shortly(const commissioning::Findings& findings) {
  std::vector<std::string> texts;
  for (const commissioning::Finding& finding : findings) {
    std::string text = finding.drive + " " + finding.rule;
    if (finding.key.index != 0) text += " [-" + std::to_string(finding.key.index) + "]";
    if (finding.raw) text += " " + std::to_string(*finding.raw);
    if (finding.remedy) text += " -> " + std::to_string(finding.remedy->raw);
    texts.push_back(text);
  }
  return texts;
}

struct FactoryNew {
  const char* series;
  std::vector<std::string> found;  ///< in each drive
};

// P509 = 0, control terminals, is the factory setting of every series (BU 0020 6.1.2 and 6.2.2, BU 0280 5.1.3); P480
// has {1, 2, 5, 12} in SK 1x0E and 2xxE (BU 0280 5.1.2), 0 in the others. P513 = 0 and P151 = 0 stop the drive as soon as
// the watchdog has noticed (BU 2700 7.1.1), P120 = 1. P105 = 50 Hz is more than the demo asks for.
const std::vector<FactoryNew>& factoryNew() {
  static const std::vector<FactoryNew> kRows{
      {"sk1x0e", {"bus_has_control 0 -> 3", "bus_bits [-1] 1 -> 0", "bus_bits [-2] 2 -> 0"}},
      {"sk2xxe", {"bus_has_control 0 -> 3", "bus_bits [-1] 1 -> 0", "bus_bits [-2] 2 -> 0"}},
      {"sk300e", {"bus_has_control 0 -> 10"}},
      {"sk5xxe", {"bus_has_control 0 -> 4"}},
      {"sk54xe", {"bus_has_control 0 -> 4"}},
      {"sk700e", {"bus_has_control 0 -> 10"}},
      {"sk750e", {"bus_has_control 0 -> 10"}},
  };
  return kRows;
}

TEST(CommissioningCheck, FindsWhatAFactoryNewDriveLacksAndLeavesNothing) {
  ASSERT_EQ(profile::kAllSeries.size(), factoryNew().size());
  for (const FactoryNew& row : factoryNew()) {
    DemoRobot robot{row.series, "P509: 0"};
    std::vector<std::string> expected;
    for (const char* drive : {"left ", "right "}) {
      for (const std::string& found : row.found) expected.push_back(drive + found);
    }
    const commissioning::Findings findings = robot.check();
    EXPECT_THAT(shortly(findings), ElementsAreArray(expected)) << row.series;
    robot.fix(findings);
    EXPECT_THAT(shortly(robot.check()), IsEmpty()) << row.series;
  }
}

// What somebody has set wrong on an inverter that is used with this bus already.
TEST(CommissioningCheck, FindsWhatSomebodyHasSet) {
  DemoRobot robot{"sk5xxe", "P513: -0.1, P104: [0, 0, 2, 0], P560: 0, P105: 40"};
  const commissioning::Findings findings = robot.check();
  const std::vector<std::string> of_left{"left bus_errors_heeded -1 -> 0", "left top_speed 400",
                                         "left minimum_zero 20 -> 0", "left writes_saved 0 -> 1"};
  ASSERT_EQ(8u, findings.size());
  EXPECT_THAT(shortly({findings.begin(), findings.begin() + 4}), ElementsAreArray(of_left));
  robot.fix(findings);
  EXPECT_THAT(shortly(robot.check()), ElementsAre("left top_speed 400", "right top_speed 400"))
      << "how fast the machine may be is for a person to decide";
}

// Its end changes nothing, and any time-out it would be told to set trips on its words 0000 (BU 2700 7.1.1).
TEST(CommissioningCheck, AsksForNoTimeoutOfANodeThatLooksOn) {
  DemoRobot right{"sk5xxe", "P513: 0", true};
  EXPECT_THAT(shortly(right.check()), IsEmpty());
  DemoRobot tripping{"sk5xxe", "P513: 0.5", true};
  const commissioning::Findings findings = tripping.check();
  EXPECT_THAT(shortly(findings), ElementsAre("left timeout_long_enough 5", "right timeout_long_enough 5"));
  for (const CommissionedDrive& drive : tripping.drives()) EXPECT_THAT(fixesFor(drive, findings, false), IsEmpty());
  EXPECT_THAT(
      checkText(tripping.drives(), findings),
      HasSubstr("= 0.5 s: the words of a node that looks on (read_only) are 0000: it trips E10.x by them; set it "
                "to 0 while the node looks on (BU 2700, 7.1.1"));
}

TEST(CommissioningCheck, PutsTheBusFirst) {
  DemoRobot robot{"sk2xxe", "P509: 0, P560: 0"};
  const commissioning::Findings findings = robot.check();
  const std::vector<Fix> fixes = fixesFor(robot.drives()[0], findings, true);
  ASSERT_EQ(4u, fixes.size());
  EXPECT_TRUE(fixes[0].finding.selects_bus);
  EXPECT_EQ(profile::ParameterAction::kWritePersistent, fixes[0].access.request.action);
  EXPECT_THAT(fixText(fixes[0]),
              AllOf(StartsWith("left: P509 Control word source: 0 Control terminals or keyboard -> 3 System bus"),
                    HasSubstr("from then on the bus commands this drive")));
}

TEST(CommissioningCheck, IsToldDriveByDrive) {
  DemoRobot robot{"sk5xxe", "P560: 0"};
  const commissioning::Findings findings = robot.check();
  EXPECT_EQ(
      "drive left (PROFIBUS station 3), sk5xxe: 1 finding\n"
      "  warning  P560 Save in EEPROM = 0 RAM only: parameters changed by anybody, NORD CON included, are lost at "
      "power "
      "off; set it to 1 Write to EEPROM (BU 0020, 7.5, p. 83)\n"
      "drive right (PROFIBUS station 4), sk5xxe: 1 finding\n"
      "  warning  P560 Save in EEPROM = 0 RAM only: parameters changed by anybody, NORD CON included, are lost at "
      "power "
      "off; set it to 1 Write to EEPROM (BU 0020, 7.5, p. 83)\n"
      "2 findings in 2 drives\n",
      checkText(robot.drives(), findings));
  const YAML::Node json = YAML::Load(checkJson(robot.drives(), findings));
  EXPECT_EQ(2, json["findings"].as<int>());
  const YAML::Node finding = json["drives"][1]["findings"][0];
  EXPECT_EQ("writes_saved", finding["rule"].as<std::string>());
  EXPECT_EQ(560, finding["number"].as<int>());
  EXPECT_EQ(1, finding["remedy_raw"].as<int>());
  EXPECT_EQ("warning", finding["severity"].as<std::string>());
}

// That says nothing of the parameter: neither that it is unreadable nor that the rest may be judged without it.
TEST(CommissioningCheck, AsksAgainForWhatIsRefusedForTheMoment) {
  const DemoRobot robot{"sk5xxe", ""};
  const std::atomic<bool> not_asked{false};
  CommissionedDrive drive = robot.drives()[0];
  ScriptedDrive parameters{{{"P509", 4}}};
  parameters.blocked["P509"] = 2;
  readFacts(drive, parameters, not_asked);
  EXPECT_EQ(4, drive.facts.value().raw({509}));
  parameters.blocked["P509"] = -1;
  EXPECT_THROW(readFacts(drive, parameters, not_asked), Trouble);
}

TEST(CommissioningCheck, SaysOfADriveThatItCouldNotBeAsked) {
  DemoRobot robot{"sk5xxe", "P560: 1"};
  std::vector<CommissionedDrive> drives = robot.drives();
  drives[0].trouble = "it sleeps";
  EXPECT_EQ(
      "drive left (PROFIBUS station 3), sk5xxe: could not be asked: it sleeps\n"
      "drive right (PROFIBUS station 4), sk5xxe: could not be asked: \n"
      "0 findings in 0 drives\n",
      checkText(drives, findingsIn(drives)));
}

}  // namespace
}  // namespace nord_driver::tools
