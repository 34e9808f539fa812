// nord_param on a CAN bus: what the drives, and the driver that may have them, notice of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "catalogue/shipped.h"
#include "sim/canopen/simulated_can_bus.h"
#include "tools/drive_watch.h"
#include "tools/parameter_link.h"
#include "tools/scope_observer.h"
#include "tools/scope_scale.h"
#include "transport/canopen/canopen.h"

namespace nord_driver::test {
namespace {

using sim::InverterState;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

catalogue::ParameterAddress parameter(std::uint16_t number) {
  catalogue::ParameterAddress address;
  address.number = number;
  return address;
}

std::string configuration(bool set_free, bool cia402) {
  const std::string drive = std::string("series: sk5xxe, pole_pairs: 2") + (cia402 ? ", profile: cia402" : "");
  return std::string("{transport: canopen, cycle_rate: 100, bus: {interface: can0") +
         (set_free ? ", set_free: true" : "") +
         "}, drives: {"
         " left: {address: 3, joint: l, " +
         drive + "}, right: {address: 4, joint: r, " + drive + "}}}";
}

/// Nodes 3 and 4, each an SK 5xxE behind its SK TU3-CAO; the program is linked to node 3.
class CanTool {
 public:
  explicit CanTool(const std::vector<sim::ParameterPreset>& parameters = {}, bool set_free = false, bool cia402 = false)
      : config_(tools::readToolConfig(YAML::Load(configuration(set_free, cia402)), "left")),
        transport_([this, parameters, cia402](const link::CanSettings& settings) {
          ids_ = settings.ids;
          auto made = std::make_unique<sim::SimulatedCanBus>(simulated(parameters, cia402));
          bus_ = made.get();
          return made;
        }),
        link_(std::make_unique<tools::ParameterLink>(config_, transport_, catalogue::shippedCatalogues())) {
    bus_->run(seconds{1});  // the nodes have sent their boot-up
    bus_->setTap([this](const CanFrame& frame, sim::SimulatedCanBus::Sender sender, Instant at) {
      if (sender != sim::SimulatedCanBus::Sender::kMaster) return;
      sent_.push_back(frame);
      if (sent_.size() == 1) first_sent_ = at;
    });
  }

  void connect() { link_->connect(seconds{5}, not_asked_); }
  std::string trouble() {
    try {
      connect();
    } catch (const tools::Trouble& error) {
      return error.what();
    }
    return "";
  }
  /// Somebody else sends this, and the node has it.
  void otherSends(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    const std::vector<std::uint8_t> data{bytes};
    bus_->inject(dataFrame(id, ByteView{data.data(), data.size()}));
    bus_->run(milliseconds{20});
  }
  /// As another master does it: NMT start, 047E, 047F with a setpoint of 50 %.
  void otherLetsItRun() {
    otherSends(0x000, {0x01, 0x03});
    otherSends(0x203, {0x7E, 0x04, 0x00, 0x00});
    bus_->run(milliseconds{500});
    otherSends(0x203, {0x7F, 0x04, 0x00, 0x20});
    bus_->run(milliseconds{100});
    ASSERT_EQ(InverterState::kOperationEnabled, left().state());
  }

  tools::ParameterLink& link() { return *link_; }
  CanopenTransport& transport() { return transport_; }
  sim::SimulatedCanBus& bus() { return *bus_; }
  sim::InverterModel& left() { return bus_->drive(0).inverter(); }
  /// Frames of ours that went over the bus.
  std::vector<CanFrame>& sent() { return sent_; }
  Instant firstSent() const { return first_sent_; }
  const std::vector<std::uint32_t>& filteredIds() const { return ids_; }

 private:
  static sim::SimConfig simulated(const std::vector<sim::ParameterPreset>& parameters, bool cia402) {
    sim::SimConfig config;
    config.bus = sim::CanBusConfig{};
    for (const std::uint8_t address : {std::uint8_t{3}, std::uint8_t{4}}) {
      sim::DriveConfig drive;
      drive.name = address == 3 ? "left" : "right";
      drive.address = address;
      drive.bus = sim::CanDriveConfig{};
      drive.bus.as<sim::CanDriveConfig>().cia402 = cia402;
      drive.parameters = parameters;
      config.drives.push_back(drive);
    }
    return config;
  }

  tools::ToolConfig config_;
  std::vector<std::uint32_t> ids_;
  sim::SimulatedCanBus* bus_ = nullptr;  // of the transport
  std::vector<CanFrame> sent_;
  Instant first_sent_{};
  CanopenTransport transport_;
  std::unique_ptr<tools::ParameterLink> link_;
  std::atomic<bool> not_asked_{false};
};

std::vector<std::string> nmtCommands(const std::vector<CanFrame>& frames) {
  std::vector<std::string> commands;
  for (const CanFrame& frame : frames) {
    if (frame.id == 0) commands.push_back(toHex(frame.bytes()));
  }
  return commands;
}

TEST(CanopenParametersOnly, ReadsAndWritesOnAQuietBus) {
  CanTool tool;
  tool.connect();
  const auto read = tool.link().read(parameter(105));
  EXPECT_TRUE(read.success) << read.message;
  EXPECT_EQ(500, read.raw);
  catalogue::ParameterWrite write;
  write.value = 2.5;
  catalogue::ParameterAccess access = catalogue::accessTo(parameter(102), tool.link().known());
  ASSERT_EQ("", catalogue::setValue(access, write));
  const auto written = tool.link().write(access);
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_EQ(250, tool.bus().drive(0).parameters().value(102, 0));
  EXPECT_THAT(tool.link().finish(), IsEmpty());
  EXPECT_EQ(1, tool.bus().drive(0).parameters().value(560));
  EXPECT_EQ("no rule broken", tool.bus().referee().report());
}

// 6044h is rpm: without P105 nothing says which share of it that is. P105 may be among what is looked at, too.
TEST(CanopenParametersOnly, TheFrequencyOfCia402IsByP105AsItWasRead) {
  for (const std::vector<std::string>& looked_at : {std::vector<std::string>{}, {"P105"}}) {
    CanTool tool{{{105, 0, 0, 600}}, false, true};
    tool.connect();
    tool.left().setLocalControl(true, 20.0);
    tool.link().pass(seconds{3});
    ASSERT_NEAR(20.0, tool.left().frequency(), 0.1);
    tools::DriveWatch watch{tool.link(), looked_at};
    for (int look = 0; look < 2; ++look) {
      const std::vector<tools::WatchedDrive> seen = watch.look();
      ASSERT_EQ(1u, seen.size());
      ASSERT_TRUE(seen[0].frequency);
      EXPECT_NEAR(20.0, *seen[0].frequency, 0.1) << "look " << look << ", values: " << looked_at.size();
    }
    EXPECT_THAT(tool.link().finish(), IsEmpty());
  }
}

// What was typed in is for a P105 that cannot be read: actual value 1 tells a share of what was read.
TEST(CanopenParametersOnly, AScopeOfCia402IsByP105AsItWasReadWhateverWasTypedIn) {
  for (const std::optional<double> typed : {std::optional<double>{}, std::optional<double>{60.0}, {50.0}}) {
    CanTool tool{{{105, 0, 0, 600}}, false, true};
    tool.connect();
    tools::ScopeRecord record;
    tools::readScale(tool.link(), typed, false, record);
    tool.left().setLocalControl(true, 20.0);
    tool.link().pass(seconds{3});
    ASSERT_NEAR(20.0, tool.left().frequency(), 0.1);
    tools::ScopeObserver observer{10};
    tool.link().setObserver(&observer);
    tool.link().pass(milliseconds{50});
    tool.link().setObserver(nullptr);
    const std::vector<tools::ScopeSample> samples = observer.samples();
    ASSERT_FALSE(samples.empty());
    ASSERT_TRUE(record.actualValueScale());
    EXPECT_NEAR(20.0, samples.back().input.actual_values[0] / 16384.0 * *record.actualValueScale(), 0.1);
    EXPECT_THAT(tool.link().finish(), IsEmpty());
  }
}

// 100Ch and 100Dh as a driver may have left them: the node watches from the first question on (CiA 301 7.2.8.3.2.1),
// and the program asks none. With the driver's guarding its end would be E10.0 after 0.3 s.
TEST(CanopenParametersOnly, ItsEndTripsNothing) {
  CanTool tool;
  tool.otherSends(0x603, {0x2B, 0x0C, 0x10, 0x00, 100, 0, 0, 0});
  tool.otherSends(0x603, {0x2F, 0x0D, 0x10, 0x00, 3, 0, 0, 0});
  tool.connect();
  ASSERT_TRUE(tool.link().read(parameter(105)).success);
  EXPECT_THAT(tool.link().finish(), IsEmpty());
  tool.bus().run(seconds{5});
  EXPECT_EQ(0, tool.left().faultNumber());
  EXPECT_EQ(InverterState::kReadyToSwitchOn, tool.left().state());
  EXPECT_EQ(0u, tool.bus().node(0).counters().masters_lost);
  for (const CanFrame& frame : tool.sent()) EXPECT_FALSE(frame.remote) << "a question of guarding";
}

// Pre-operational for the set-up, start, and pre-operational again at the end; only for the drive that was asked for.
TEST(CanopenParametersOnly, ResetsNothingAndTouchesNoOtherNode) {
  CanTool tool;
  tool.connect();
  tool.link().finish();
  tool.bus().run(milliseconds{100});
  EXPECT_THAT(nmtCommands(tool.sent()), ElementsAre("80 03", "01 03", "80 03"));
  EXPECT_EQ(1u, tool.bus().node(0).counters().boot_ups);
  for (const CanFrame& frame : tool.sent()) EXPECT_NE(0x604u, frame.id);
}

// Whatever is sent there may concern another master: no filter hides it.
TEST(CanopenParametersOnly, ListensToTheWholeBusForHalfASecond) {
  CanTool tool;
  EXPECT_THAT(tool.filteredIds(), IsEmpty());
  const Instant start = tool.bus().now();
  tool.connect();
  EXPECT_GE(tool.firstSent() - start, milliseconds{500});
  EXPECT_LT(tool.firstSent() - start, milliseconds{600});
}

// The drive of another master that runs sends its TPDO while it accelerates: that is enough.
TEST(CanopenParametersOnly, ARunningDriveOfAnotherMasterIsLeftAlone) {
  CanTool tool;
  tool.otherLetsItRun();
  EXPECT_EQ(
      "the bus is in use: 183h was seen; nothing is sent beside another master, nor to nodes that one has left "
      "operational: end it, or switch them off and on",
      tool.trouble());
  EXPECT_FALSE(tool.transport().connected());
  EXPECT_THAT(tool.link().finish(), IsEmpty());
  tool.transport().close();
  tool.bus().run(seconds{10});
  EXPECT_THAT(tool.sent(), IsEmpty());
  EXPECT_EQ(InverterState::kOperationEnabled, tool.left().state());
  EXPECT_DOUBLE_EQ(25.0, tool.left().frequency());
}

// A word to a node that the program would not touch, shortly before listening is over.
TEST(CanopenParametersOnly, TheMasterOfOtherNodesIsHeard) {
  CanTool tool;
  const Instant start = tool.bus().now();
  std::vector<profile::ProcessOutput> outputs(1);
  std::vector<DriveExchange> inputs(1);
  tool.transport().exchange(outputs, inputs);
  tool.transport().sleepUntil(start + milliseconds{450});
  EXPECT_THAT(tool.transport().busText().str(), StartsWith("listens for others"));
  tool.otherSends(0x204, {0x7E, 0x04, 0x00, 0x00});
  for (int i = 0; i < 300; ++i) {
    tool.transport().exchange(outputs, inputs);
    tool.transport().sleepUntil(tool.transport().now() + milliseconds{10});
  }
  EXPECT_THAT(tool.transport().busText().str(), HasSubstr("204h was seen"));
  EXPECT_THAT(tool.sent(), IsEmpty());
}

// A driver that is started beside it resets the node first: from then on the node is the driver's.
TEST(CanopenParametersOnly, ADriverThatStartsLaterIsGivenTheBus) {
  CanTool tool;
  tool.connect();
  tool.bus().inject(dataFrame(0x000, ByteView{FixedBytes<2>{0x82, 0x03}}));
  EXPECT_FALSE(tool.link().read(parameter(105)).success);
  EXPECT_THAT(tool.transport().busText().str(), HasSubstr("000h was seen"));
  tool.sent().clear();
  tool.otherLetsItRun();
  EXPECT_FALSE(tool.link().read(parameter(105)).success);
  tool.link().finish();
  tool.transport().close();
  tool.bus().run(seconds{5});
  EXPECT_THAT(tool.sent(), IsEmpty());
  EXPECT_EQ(InverterState::kOperationEnabled, tool.left().state());
  EXPECT_DOUBLE_EQ(25.0, tool.left().frequency());
}

// A guest keeps off any master, that of other nodes as well.
TEST(CanopenParametersOnly, AMasterOfOtherNodesThatStartsLaterIsGivenTheBus) {
  CanTool tool;
  tool.connect();
  tool.bus().inject(dataFrame(0x000, ByteView{FixedBytes<2>{0x01, 0x21}}));
  EXPECT_FALSE(tool.link().read(parameter(105)).success);
  EXPECT_THAT(tool.transport().busText().str(), HasSubstr("000h was seen"));
}

// P513 > 0 is the drive's own watch over control words: only the end of the program lets it act, and it is named.
TEST(CanopenParametersOnly, NamesTheTelegramTimeout) {
  CanTool tool{{{513, 0, 0, 10}}};
  tool.connect();
  const Instant end = tool.bus().now() + seconds{3};
  while (tool.bus().now() < end) ASSERT_TRUE(tool.link().read(parameter(105)).success);
  EXPECT_EQ(0, tool.left().faultNumber());
  EXPECT_THAT(tool.link().finish(), ElementsAre(HasSubstr("drive left has P513 = 1 s")));
}

// Nobody knows who is on the bus now. The node that was left operational talks, and nothing tells whose it is.
TEST(CanopenParametersOnly, ListensAgainAfterTheInterfaceWasAway) {
  CanTool tool;
  tool.connect();
  tool.bus().setInterfacePresent(false);
  EXPECT_FALSE(tool.link().read(parameter(105)).success);
  tool.bus().setInterfacePresent(true);
  tool.sent().clear();
  EXPECT_THAT(tool.trouble(), HasSubstr("183h was seen"));
  EXPECT_THAT(tool.sent(), IsEmpty());
  tool.bus().drive(0).setPlugged(false);
  tool.bus().run(seconds{1});
  tool.bus().drive(0).setPlugged(true);
  tool.bus().setInterfacePresent(false);
  tool.transport().sleepUntil(tool.bus().now() + seconds{1});
  tool.bus().setInterfacePresent(true);
  EXPECT_EQ("", tool.trouble());
  EXPECT_TRUE(tool.link().read(parameter(105)).success);
}

// As a restore leaves it that was cut hard: operational, and sending by its event timer. It is taken back, and read.
TEST(CanopenParametersOnly, ANodeThatWasLeftOperationalIsSetFreeWhenAsked) {
  CanTool refused;
  refused.otherSends(0x000, {0x01, 0x03});
  refused.otherSends(0x203, {0x7E, 0x04, 0x00, 0x00});
  CanTool tool{{}, true};
  for (CanTool* one : {&refused, &tool}) {
    one->otherSends(0x000, {0x80, 0x03});
    one->otherSends(0x603, {0x2B, 0x00, 0x18, 0x05, 50, 0, 0, 0});  // 1800h:5, the event timer of TPDO1: 50 ms
    one->otherSends(0x000, {0x01, 0x03});
    one->bus().run(seconds{1});
  }
  EXPECT_THAT(refused.trouble(), HasSubstr("183h was seen"));
  const Instant start = tool.bus().now();
  EXPECT_EQ("", tool.trouble());
  EXPECT_GE(tool.firstSent() - start, seconds{2});
  EXPECT_THAT(nmtCommands(tool.sent()), ElementsAre("80 03", "01 03"));
  EXPECT_TRUE(tool.link().read(parameter(105)).success);
  EXPECT_THAT(tool.link().finish(), IsEmpty());
  EXPECT_EQ(0, tool.left().faultNumber());
}

// Who asked for it is refused all the same where somebody commands, or a drive says that it runs.
TEST(CanopenParametersOnly, SetsNoNodeFreeBesideAMasterOrWhileADriveRuns) {
  CanTool running{{}, true};
  running.otherLetsItRun();
  EXPECT_EQ(
      "the bus is in use: 183h was seen; nothing is sent beside another master, nor to a drive that runs: end it, "
      "or stop the drive",
      running.trouble());
  EXPECT_THAT(running.sent(), IsEmpty());
  EXPECT_EQ(InverterState::kOperationEnabled, running.left().state());
  CanTool commanded{{}, true};
  std::vector<profile::ProcessOutput> outputs(1);
  std::vector<DriveExchange> inputs(1);
  for (int i = 0; i < 500; ++i) {
    if (i == 150) commanded.otherSends(0x204, {0x7E, 0x04, 0x00, 0x00});
    commanded.transport().exchange(outputs, inputs);
    commanded.transport().sleepUntil(commanded.transport().now() + milliseconds{10});
  }
  EXPECT_THAT(commanded.transport().busText().str(), HasSubstr("204h was seen"));
  EXPECT_THAT(commanded.sent(), IsEmpty());
}

}  // namespace
}  // namespace nord_driver::test
