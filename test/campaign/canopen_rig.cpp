// The campaign over CANopen: an SK TU3-CAO for each drive, or up to four inverters behind one SK CU4-CAO.
#include "campaign/rig.h"
#include "campaign/wheels.h"
#include "core/can_frame.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

class CanopenRig final : public CampaignRig {
 public:
  explicit CanopenRig(const CanRobot::Options& options) : robot_(options) {}

  CanRobot& robot() override { return robot_; }
  sim::SimulatedCanBus& bus() { return robot_.bus(); }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee() override { return robot_.bus().referee().report(); }
  void passWithoutTheDriver(Duration span) override { robot_.bus().run(span); }
  void endLosses() override {
    bus().loseAnswers(0);
    bus().loseRequests(0);
    bus().overflow(0);
  }
  const std::vector<Act>& acts() const override { return canopenCampaign().acts(); }

  /// Status words come when they change or with the event timer, 50 ms; two and a half of these.
  Duration silence() const override { return std::chrono::milliseconds{125}; }
  /// Node guarding, 100 ms times 3.
  Duration driveSideTimeout() const override { return std::chrono::milliseconds{300}; }
  Duration wireLatency() const override { return std::chrono::milliseconds{10}; }
  // A node that somebody stops unheard is only asked for 15 s, then reset (NodeBoot): its come-back bounds all others, too.
  Duration backWithin() const override { return std::chrono::seconds{20}; }

 private:
  CanRobot robot_;
};

sim::SimulatedCanBus& busOf(CampaignRig& rig) {
  return static_cast<CanopenRig&>(rig).bus();
}

// amount: 0 frames are lost, 1 spoilt by an error frame, 2 received twice; extra: how many of 1000.
void disturb(CampaignRig& rig, const Event& event) {
  sim::CanDisturbance disturbance;
  const double share = 0.001 * event.extra;
  if (event.amount == 0) disturbance.lose = share;
  if (event.amount == 1) disturbance.error = share;
  if (event.amount == 2) disturbance.duplicate = share;
  disturbance.seed = event.at + 1;
  busOf(rig).setDisturbance(disturbance);
}

// Another master commands all nodes (CiA 301 7.2.8.2): start, stop, pre-operational, reset node, reset communication.
void sayNmt(CampaignRig& rig, const Event& event) {
  constexpr std::uint8_t kCommands[] = {0x01, 0x02, 0x80, 0x81, 0x82};
  const std::uint8_t data[] = {kCommands[event.amount], 0};
  busOf(rig).inject(dataFrame(0x000, ByteView{data, 2}));
}

// Another master's words for the nodes: SYNC, an SDO request, an SDO answer, a boot-up of a node nobody knows.
void sayForeign(CampaignRig& rig, const Event& event) {
  constexpr std::uint32_t kIds[] = {0x080, 0x603, 0x583, 0x77F};
  const std::uint8_t data[] = {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0};
  const std::size_t lengths[] = {0, 8, 8, 1};
  busOf(rig).inject(dataFrame(kIds[event.amount], ByteView{data, lengths[event.amount]}));
}

const std::vector<Act>& canopenActs() {
  using R = CampaignRig;
  using E = Event;
  constexpr Range kOnce{0, 0}, kNone{0, 0}, kCount{1, 8}, kSpan{50, 1500};
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
       {0, 2},
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
      {"foreign_nmt", 3, "foreign", Place::kBus, Cuts::kNothing, kOnce, {0, 4}, kNone, sayNmt, nullptr},
      {"foreign_master", 3, "foreign", Place::kBus, Cuts::kNothing, kOnce, {0, 3}, kNone, sayForeign, nullptr},
  };
  return acts;
}

std::unique_ptr<CampaignRig> makeCanopen(const Layout& layout, const TransportWrap& wrap) {
  CanRobot::Options options;
  options.base = layout.wheels != 0;
  options.node = wheelSettings(layout);
  options.each = driveSettingsOf(layout);
  options.nodes = layout.drives();
  if (layout.one_module) options.gateway_inverters = layout.drives();
  options.simulate = [layout](sim::SimConfig& config) { simulateWheels(layout, config); };
  options.wrap = wrap;
  return std::make_unique<CanopenRig>(options);
}

}  // namespace

CampaignBus canopenCampaign() {
  return {"canopen", makeCanopen, canopenActs, 1500, Shares::kAny};
}

}  // namespace nord_driver::test
