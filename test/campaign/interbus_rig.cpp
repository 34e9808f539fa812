// The campaign over InterBus: an SK TU3-IBS for each drive, in a ring behind a gateway; parameters by Compact PCP.
#include "campaign/axes.h"
#include "campaign/rig.h"
#include "campaign/wheels.h"
#include "sim/rule_counts.h"
#include "system/interbus_robot.h"

namespace nord_driver::test {
namespace {

class InterbusRig final : public CampaignRig {
 public:
  explicit InterbusRig(const InterbusRobot::Options& options) : robot_(options), pcp_(options.pcp) {}

  InterbusRobot& robot() override { return robot_; }
  sim::SimulatedGateway& link() { return robot_.gateway(); }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  /// The referee of the ring knows no other rule than that of control words of zeros.
  std::string referee(bool undisturbed) override { return undisturbed ? robot_.referee() : sim::kNoRuleBroken; }
  void passWithoutTheDriver(Duration span) override { robot_.gateway().run(span); }
  void endLosses() override {}
  const std::vector<Act>& acts() const override { return interbusCampaign().acts(); }

  bool readsParameters() const override { return pcp_; }
  bool readsScaling() const override { return false; }
  /// Each exchange brings a status word, and its age counts from the question.
  Duration silence() const override { return Duration::zero(); }
  /// The watchdog of the gateway, then P513; and half of the longest latency: a request that was under way.
  Duration driveSideTimeout() const override { return std::chrono::milliseconds{200 + 200 + 150}; }
  /// An exchange of the gateway, and a turn of the ring.
  Duration wireLatency() const override { return std::chrono::milliseconds{20}; }
  Duration backWithin() const override { return std::chrono::seconds{2}; }

 private:
  InterbusRobot robot_;
  bool pcp_;
};

sim::SimulatedGateway& linkOf(CampaignRig& rig) {
  return static_cast<InterbusRig&>(rig).link();
}

template <typename Change>
void changeNetwork(CampaignRig& rig, Change change) {
  sim::NetworkState network = linkOf(rig).network();
  change(network);
  linkOf(rig).setNetwork(network);
}

template <typename Change>
void changeGateway(CampaignRig& rig, Change change) {
  sim::GatewaySwitches switches = linkOf(rig).gateway().switches();
  change(switches);
  linkOf(rig).gateway().setSwitches(switches);
}

void begetWrong(CampaignRig& rig, const Event& event) {
  sim::DriveUnit& unit = rig.unit(event.drive);
  unit.setInverterPower(false);
  letItBeSeen(rig);
  unit.parameters().preset(507, 0, 0, 3 - unit.parameters().value(507));
  unit.setInverterPower(true);
}

const std::vector<Act>& interbusActs() {
  using R = CampaignRig;
  using E = Event;
  constexpr Range kOnce{0, 0}, kNone{0, 0}, kSpan{50, 1500};
  static const std::vector<Act> acts{
      {"port_closed", 3, "port", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { changeNetwork(rig, [](sim::NetworkState& to) { to.port_open = false; }); },
       [](R& rig, const E&) { changeNetwork(rig, [](sim::NetworkState& to) { to.port_open = true; }); }},
      {"cable", 4, "cable", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) {
         changeNetwork(rig, [](sim::NetworkState& to) { to.carries_requests = to.carries_answers = false; });
       },
       [](R& rig, const E&) {
         changeNetwork(rig, [](sim::NetworkState& to) { to.carries_requests = to.carries_answers = true; });
       },
       true},
      {"half_open", 3, "cable", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { changeNetwork(rig, [](sim::NetworkState& to) { to.carries_answers = false; }); },
       [](R& rig, const E&) { changeNetwork(rig, [](sim::NetworkState& to) { to.carries_answers = true; }); }, true},
      // amount: ms of a request and its answer.
      {"latency",
       4,
       "latency",
       Place::kBus,
       Cuts::kNothing,
       kSpan,
       {1, 300},
       kNone,
       [](R& rig, const E& event) {
         changeNetwork(rig, [&](sim::NetworkState& to) { to.latency = std::chrono::milliseconds{event.amount}; });
       },
       [](R& rig, const E&) {
         changeNetwork(rig, [](sim::NetworkState& to) { to.latency = sim::NetworkState{}.latency; });
       }},
      {"reset", 3, "reset", Place::kBus, Cuts::kNothing, kOnce, kNone, kNone,
       [](R& rig, const E&) { linkOf(rig).resetConnection(); }, nullptr, true},
      {"gateway_silent", 3, "gateway", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { changeGateway(rig, [](sim::GatewaySwitches& to) { to.silent = true; }); },
       [](R& rig, const E&) { changeGateway(rig, [](sim::GatewaySwitches& to) { to.silent = false; }); }, true},
      // amount: the exception code.
      {"exceptions",
       3,
       "gateway",
       Place::kBus,
       Cuts::kAll,
       kSpan,
       {1, 11},
       kNone,
       [](R& rig, const E& event) {
         changeGateway(rig, [&](sim::GatewaySwitches& to) { to.exception = static_cast<std::uint8_t>(event.amount); });
       },
       [](R& rig, const E&) { changeGateway(rig, [](sim::GatewaySwitches& to) { to.exception.reset(); }); },
       true},
      {"wrong_transactions", 2, "gateway", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { changeGateway(rig, [](sim::GatewaySwitches& to) { to.wrong_transaction = 1; }); },
       [](R& rig, const E&) { changeGateway(rig, [](sim::GatewaySwitches& to) { to.wrong_transaction = 0; }); }, true},
      // P507 is another one when its mains come: the ring stands for a subscriber of another length (BU 0070 4.2).
      {"wrong_drive", 2, "power", Place::kStation, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E& event) { begetWrong(rig, event); }, [](R& rig, const E& event) { begetWrong(rig, event); }},
      {"ring_cut", 3, "ring", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { linkOf(rig).ring().setCut(true); },
       [](R& rig, const E&) { linkOf(rig).ring().setCut(false); }, true},
  };
  return acts;
}

std::unique_ptr<CampaignRig> makeInterbus(const Layout& layout, const TransportWrap& wrap) {
  InterbusRobot::Options options;
  options.base = layout.wheels != 0;
  options.node = baseSettings(layout);
  options.each = driveSettingsOf(layout);
  for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
    addAxisSettings(layout, i, options.each[i]);
    options.each[i]["ppo_type"] = 2;
  }
  options.modules = layout.drives();
  options.drivecom = layout.otherProfile();
  // All share one PCP channel: with many drives it takes longer than a scenario until each has told its parameters.
  options.pcp = layout.drives() <= 2;
  options.simulate = [layout](sim::SimConfig& config) {
    simulateWheels(layout, config);
    for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
      config.drives[i].bus.as<sim::IbsDriveConfig>().ppo_type = 2;
    }
    simulateAxes(layout, kSk53x, config);
  };
  options.wrap = wrap;
  return std::make_unique<InterbusRig>(options);
}

}  // namespace

CampaignBus interbusCampaign() {
  return {"interbus", makeInterbus, interbusActs, 2500, Shares::kNone, false, 2, 5500};
}

}  // namespace nord_driver::test
