// The campaign over CANopen: an SK TU3-CAO for each drive, or up to four inverters behind one SK CU4-CAO.
#include "campaign/axes.h"
#include "campaign/rig.h"
#include "campaign/wheels.h"
#include "core/can_frame.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

class CanopenRig final : public CampaignRig {
 public:
  CanopenRig(const CanRobot::Options& options, bool has_twin, bool heartbeats)
      : robot_(options), has_twin_(has_twin), heartbeats_(heartbeats) {}

  CanRobot& robot() override { return robot_; }
  sim::SimulatedCanBus& bus() { return robot_.bus(); }
  sim::DriveUnit* twin() override { return has_twin_ ? &robot_.unit(robot_.config().drives.size()) : nullptr; }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  // A node that somebody resets forgets its life time (CiA 301 7.3.2.2.2), and its RPDOs end: until it has been set up
  // again nothing but a time-out of its own stops its wheel. doc/safety.md asks for one: P513, behind a gateway P151.
  void setUp() override {
    for (std::size_t i = 0; i < robot_.config().drives.size(); ++i) unit(i).parameters().preset(513, 0, 0, 3);
    if (twin() != nullptr) twin()->setPlugged(false);
    if (auto* const module = robot_.node(0).module()) module->parameters().preset(151, 0, 0, 300);
  }
  std::string referee(bool undisturbed) override {
    using Rule = sim::CanRule;
    const sim::CanReferee& referee = robot_.bus().referee();
    if (undisturbed) return referee.report();
    // A heartbeat that crosses a reset says that the node is still operational: it is told to stop until its boot-up.
    const bool believed = led_away_unheard_ || heartbeats_;
    const Rule words = believed ? Rule::kRpdoBeforeOperational : Rule::kCount;  // the latter is none
    return referee.report(
        {Rule::kZeroControlWord, Rule::kUnknownId, Rule::kSdoWhilePending, Rule::kMappingOrder, words});
  }
  void passWithoutTheDriver(Duration span) override { robot_.bus().run(span); }
  void endLosses() override {
    bus().loseAnswers(0);
    bus().loseRequests(0);
    bus().overflow(0);
  }
  const std::vector<Act>& acts() const override { return canopenCampaign().acts(); }

  /// Status words come when they change or with the event timer, 50 ms; two and a half of these.
  Duration silence() const override { return std::chrono::milliseconds{125}; }
  /// Node guarding, 100 ms times 3; P513 or P151 as long.
  Duration driveSideTimeout() const override {
    return std::chrono::milliseconds{300} +
           (robot_.transport().now() < unwatched_until_ ? kOneAccess + kKeptFromIt : Duration::zero());
  }
  // Told "reset node", a gateway has forgotten its life time, and P151 is "started with the first valid telegram" (BU 0220
  // 4.2.3.2): nothing but the driver stops what is behind it, when it has set it up again.
  void nodeReset() {
    if (robot_.node(0).module() != nullptr)
      unwatched_until_ = robot_.transport().now() + 2 * (kOneAccess + kKeptFromIt);
  }
  /// Another master commands the nodes, which this driver may be unable to hear: it then tells them what stops first.
  void nodesLedAway() {
    led_away_ = true;
    const link::CanState state = bus().state();
    led_away_unheard_ =
        led_away_unheard_ || !bus().isOpen() || state == link::CanState::kBusOff || state == link::CanState::kDown;
  }
  Duration wireLatency() const override { return std::chrono::milliseconds{10}; }
  // And the life time (300 ms) until a loss is seen, a question that nobody answers with its repetitions, and the longest
  // pause after a set-up that was refused (NodeBoot, 4 s; after a silence it is 1 s).
  Duration backWithin() const override {
    // A node that is not guarded, and was stopped by somebody nobody heard, is not asked for its state but taken back after
    // a while (NodeConfig::only_asked).
    const Duration taken_back = heartbeats_ && led_away_ ? std::chrono::seconds{15} : Duration::zero();
    return std::chrono::seconds{2} + std::chrono::milliseconds{300} + kOneAccess + std::chrono::seconds{4} + taken_back;
  }

 private:
  /// An access of the start-up and its two repetitions without an answer, 300 ms each (bus/sdo_timeout).
  static constexpr Duration kOneAccess = 3 * std::chrono::milliseconds{300};
  /// The longest cut of the line and the longest halt of the host there are here.
  static constexpr Duration kKeptFromIt = std::chrono::milliseconds{1500} + std::chrono::seconds{2};

  mutable CanRobot robot_;
  bool has_twin_, heartbeats_;
  bool led_away_ = false;
  bool led_away_unheard_ = false;
  Instant unwatched_until_{};
};

sim::SimulatedCanBus& busOf(CampaignRig& rig) {
  return static_cast<CanopenRig&>(rig).bus();
}

// amount: 0 frames are lost, 1 spoilt by an error frame, 2 received twice, 3 received late; extra: how many of 1000, of late ones of 100.
void disturb(CampaignRig& rig, const Event& event) {
  sim::CanDisturbance disturbance;
  const double share = 0.001 * event.extra;
  if (event.amount == 0) disturbance.lose = share;
  if (event.amount == 1) disturbance.error = share;
  if (event.amount == 2) disturbance.duplicate = share;
  if (event.amount == 3) disturbance.late = 10.0 * share;
  disturbance.seed = event.at + 1;
  busOf(rig).setDisturbance(disturbance);
}

// Another master commands all nodes (CiA 301 7.2.8.2): start, stop, pre-operational, reset node, reset communication.
void sayNmt(CampaignRig& rig, const Event& event) {
  constexpr std::uint8_t kCommands[] = {0x01, 0x02, 0x80, 0x81, 0x82};
  const std::uint8_t data[] = {kCommands[event.amount], 0};
  static_cast<CanopenRig&>(rig).nodesLedAway();
  if (kCommands[event.amount] == 0x81) static_cast<CanopenRig&>(rig).nodeReset();
  busOf(rig).inject(dataFrame(0x000, ByteView{data, 2}));
}

// Another master's words for the nodes: SYNC, an SDO request, an SDO answer, a boot-up of a node nobody knows.
void sayForeign(CampaignRig& rig, const Event& event) {
  constexpr std::uint32_t kIds[] = {0x080, 0x603, 0x583, 0x77F};
  const std::uint8_t data[] = {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0};
  const std::size_t lengths[] = {0, 8, 8, 1};
  busOf(rig).inject(dataFrame(kIds[event.amount], ByteView{data, lengths[event.amount]}));
}

void exchange(CampaignRig& rig, const Event& event, std::uint32_t product) {
  sim::CanIdentity identity;
  identity.product = product;
  changeWithoutSupply(rig, event, [&] { busOf(rig).node(event.drive).setIdentity(identity); });
}

// Of the first drive.
bool hasTwin(CampaignRig& rig, const Event& event) {
  return event.drive == 0 && rig.twin() != nullptr;
}

const std::vector<Act>& canopenActs() {
  using R = CampaignRig;
  using E = Event;
  constexpr Range kOnce{0, 0}, kNone{0, 0}, kCount{1, 8}, kSpan{50, 1500};
  // A lost PDO is not counted: nobody confirms it (CiA 301 7.2.2), and a status word comes when it changes or with its timer.
  static const std::vector<Act> acts{
      {"lose_answers", 4, "lose_answers", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { busOf(rig).loseAnswers(static_cast<unsigned>(event.amount)); }, nullptr},
      {"lose_requests", 4, "lose_requests", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { busOf(rig).loseRequests(static_cast<unsigned>(event.amount)); }, nullptr},
      {"overflow", 3, "overflow", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { busOf(rig).overflow(static_cast<unsigned>(event.amount)); }, nullptr, true},
      {"disturb",
       6,
       "disturb",
       Place::kBus,
       Cuts::kNothing,
       kSpan,
       {0, 3},
       {1, 50},
       disturb,
       [](R& rig, const E&) { busOf(rig).setDisturbance({}); }},
      {"adapter", 3, "adapter", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { busOf(rig).setInterfacePresent(false); },
       [](R& rig, const E&) { busOf(rig).setInterfacePresent(true); }},
      {"interface_down", 2, "adapter", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { busOf(rig).setInterfaceUp(false); },
       [](R& rig, const E&) { busOf(rig).setInterfaceUp(true); }},
      {"bus_off", 3, "adapter", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { busOf(rig).setBusOff(); }, [](R& rig, const E&) { busOf(rig).restart(); }},
      {"queue_full", 2, "queue", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { busOf(rig).setQueueFull(true); },
       [](R& rig, const E&) { busOf(rig).setQueueFull(false); }},
      // amount: ms from one frame that finds a place to the next. Who hears a word now and then goes on.
      {"queue_slow",
       2,
       "queue",
       Place::kBus,
       Cuts::kNothing,
       kSpan,
       {4, 150},
       kNone,
       [](R& rig, const E& event) { busOf(rig).setQueuePace(std::chrono::milliseconds{event.amount}); },
       [](R& rig, const E&) { busOf(rig).setQueuePace({}); }},
      // amount: the product code of what stands there meanwhile.
      {"wrong_drive",
       2,
       "power",
       Place::kStation,
       Cuts::kStation,
       kSpan,
       {2, 9},
       kNone,
       [](R& rig, const E& event) { exchange(rig, event, static_cast<std::uint32_t>(event.amount)); },
       [](R& rig, const E& event) { exchange(rig, event, sim::CanIdentity{}.product); }},
      otherDrive(),
      {"twin", 4, "power", Place::kStation, Cuts::kStation, kSpan, kNone, kNone,
       [](R& rig, const E&) { rig.twin()->setPlugged(true); }, [](R& rig, const E&) { rig.twin()->setPlugged(false); },
       false, true, hasTwin},
      {"foreign_nmt", 3, "foreign", Place::kBus, Cuts::kNothing, kOnce, {0, 4}, kNone, sayNmt, nullptr},
      {"foreign_master", 3, "foreign", Place::kBus, Cuts::kNothing, kOnce, {0, 3}, kNone, sayForeign, nullptr},
  };
  return acts;
}

std::unique_ptr<CampaignRig> makeCanopen(const Layout& layout, const TransportWrap& wrap) {
  CanRobot::Options options;
  options.base = layout.wheels != 0;
  options.node = baseSettings(layout);
  options.each = driveSettingsOf(layout);
  for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
    addAxisSettings(layout, i, options.each[i]);
    options.each[i]["process_values"] = 3;
  }
  options.nodes = layout.drives();
  // Of every other size of system the nodes send heartbeats; of the others they are guarded.
  const bool heartbeats = layout.drives() % 2 == 0;
  if (heartbeats) {
    for (Values& values : options.each) values["error_control"] = std::string{"heartbeat"};
  }
  if (layout.otherProfile()) options.drives["profile"] = std::string{"cia402"};
  if (layout.one_module) options.gateway_inverters = layout.drives();
  for (Values& values : options.each) {
    values["vendor_id"] = static_cast<int>(sim::CanIdentity{}.vendor);
    values["product_code"] = static_cast<int>(sim::CanIdentity{}.product);
  }
  // What costs the most has none: it would cost more.
  const bool has_twin = !layout.one_module && layout.drives() <= 3;
  options.simulate = [layout, has_twin](sim::SimConfig& config) {
    simulateWheels(layout, config);
    simulateAxes(layout, kSk53x, config);
    for (sim::DriveConfig& drive : config.drives) drive.bus.as<sim::CanDriveConfig>().cia402 = layout.otherProfile();
    if (!has_twin) return;
    sim::DriveConfig twin = config.drives.front();
    twin.name = "twin";
    twin.joint = "twin_joint";
    twin.bus.as<sim::CanDriveConfig>().doubled_id = true;
    config.drives.push_back(twin);
  };
  options.wrap = wrap;
  return std::make_unique<CanopenRig>(options, has_twin, heartbeats);
}

}  // namespace

CampaignBus canopenCampaign() {
  return {"canopen", makeCanopen, canopenActs, 1500, Shares::kAny, true, 8, 1750};
}

}  // namespace nord_driver::test
