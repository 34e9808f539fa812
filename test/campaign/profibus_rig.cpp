// The campaign over PROFIBUS: single drives SK 5xxE with a module each, or up to four SK 2xxE behind one SK CU4-PBR.
#include <array>

#include "campaign/axes.h"
#include "campaign/rig.h"
#include "campaign/wheels.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

class ProfibusRig final : public CampaignRig {
 public:
  explicit ProfibusRig(const SimulatedRobot::Options& options) : robot_(options) {}

  SimulatedRobot& robot() override { return robot_; }
  sim::SimulatedSegment& segment() { return robot_.segment(); }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee(bool undisturbed) override {
    using Rule = sim::Rule;
    const sim::Referee& referee = robot_.segment().referee();
    if (undisturbed) return referee.report();
    return referee.report({Rule::kZeroControlWord, Rule::kDataExchangeBeforeReady, Rule::kWriteOrderLeftStanding,
                           Rule::kRecordWhileOutstanding});
  }
  void passWithoutTheDriver(Duration span) override { robot_.segment().run(span); }
  void endLosses() override {
    segment().loseAnswers(0);
    segment().loseRequests(0);
    segment().spoilAnswers(0);
  }
  const std::vector<Act>& acts() const override { return profibusCampaign().acts(); }

  /// It has no other profile.
  bool tellsShaft() const override { return false; }
  /// Each answer brings a status word.
  Duration silence() const override { return Duration::zero(); }
  /// The watchdog of the slave, `bus/watchdog`.
  Duration driveSideTimeout() const override { return std::chrono::milliseconds{200}; }
  Duration wireLatency() const override { return std::chrono::milliseconds{10}; }
  /// Slave_Diag, Set_Prm, Chk_Cfg and Slave_Diag again, one a cycle for each station: no second is added.
  Duration backWithin() const override { return std::chrono::seconds{2}; }

 private:
  SimulatedRobot robot_;
};

sim::SimulatedSegment& segmentOf(CampaignRig& rig) {
  return static_cast<ProfibusRig&>(rig).segment();
}

// What another master says (EN 50170, FDL): a token, a request for the FDL status of a station, one for its diagnosis.
void sayForeign(CampaignRig& rig, const Event& event) {
  constexpr std::array<std::uint8_t, 3> kToken{0xDC, 0x02, 0x02};
  constexpr std::array<std::uint8_t, 6> kStatus{0x10, 0x03, 0x02, 0x49, 0x4E, 0x16};
  constexpr std::array<std::uint8_t, 11> kDiagnosis{0x68, 0x05, 0x05, 0x68, 0x83, 0x82, 0x6D, 0x3C, 0x3E, 0xEC, 0x16};
  if (event.amount == 0) segmentOf(rig).foreign(ByteView{kToken.data(), kToken.size()});
  if (event.amount == 1) segmentOf(rig).foreign(ByteView{kStatus.data(), kStatus.size()});
  if (event.amount == 2) segmentOf(rig).foreign(ByteView{kDiagnosis.data(), kDiagnosis.size()});
}

// amount: 0 bytes are lost, 1 a bit of a telegram is turned, 2 bytes come twice; extra: how many of 1000.
void disturb(CampaignRig& rig, const Event& event) {
  sim::Disturbance disturbance;
  const double share = 0.001 * event.extra;
  if (event.amount == 0) disturbance.lose = share;
  if (event.amount == 1) disturbance.flip = share;
  if (event.amount == 2) disturbance.duplicate = share;
  disturbance.one_bit = true;
  disturbance.seed = event.at + 1;
  segmentOf(rig).setDisturbance(disturbance);
}

// Of the module that is meant to stand there: BU 0020 10.2, BU 0220.
std::uint16_t identOf(CampaignRig& rig, const Event& event) {
  return rig.unit(event.drive).config().place > 0 ? 0x0BA8 : 0x7531;
}

void exchange(CampaignRig& rig, const Event& event, std::uint16_t ident) {
  changeWithoutSupply(rig, event, [&] { segmentOf(rig).station(event.drive).setIdent(ident); });
}

const std::vector<Act>& profibusActs() {
  using R = CampaignRig;
  using E = Event;
  constexpr Range kOnce{0, 0}, kNone{0, 0}, kCount{1, 12}, kSpan{50, 1500};
  static const std::vector<Act> acts{
      {"lose_answers", 4, "lose_answers", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { segmentOf(rig).loseAnswers(static_cast<unsigned>(event.amount)); }, nullptr, true},
      {"lose_requests", 4, "lose_requests", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { segmentOf(rig).loseRequests(static_cast<unsigned>(event.amount)); }, nullptr, true},
      {"spoil_answers", 4, "spoil_answers", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { segmentOf(rig).spoilAnswers(static_cast<unsigned>(event.amount)); }, nullptr, true},
      {"disturb",
       6,
       "disturb",
       Place::kBus,
       Cuts::kNothing,
       kSpan,
       {0, 2},
       {1, 20},
       disturb,
       [](R& rig, const E&) { segmentOf(rig).setDisturbance({}); }},
      {"adapter", 4, "adapter", Place::kBus, Cuts::kAll, kSpan, kNone, kNone,
       [](R& rig, const E&) { segmentOf(rig).setDevicePresent(false); },
       [](R& rig, const E&) { segmentOf(rig).setDevicePresent(true); }},
      // amount: the ident number of what stands there meanwhile.
      {"wrong_drive",
       2,
       "power",
       Place::kStation,
       Cuts::kStation,
       kSpan,
       {1, 0x7530},
       kNone,
       [](R& rig, const E& event) { exchange(rig, event, static_cast<std::uint16_t>(event.amount)); },
       [](R& rig, const E& event) { exchange(rig, event, identOf(rig, event)); }},
      otherDrive(),
      {"foreign_master", 3, "foreign", Place::kBus, Cuts::kNothing, kOnce, {0, 2}, kNone, sayForeign, nullptr},
  };
  return acts;
}

std::unique_ptr<CampaignRig> makeProfibus(const Layout& layout, const TransportWrap& wrap) {
  SimulatedRobot::Options options;
  options.node = nodeSettings(layout);
  options.base = layout.wheels != 0;
  options.wheels_a_side = layout.wheels == 4 ? 2 : 1;
  options.one_module = layout.one_module;
  options.singles = layout.singles + layout.axes;
  for (const char* wheel : {"left", "right", "rear_left", "rear_right"})
    options.of_drive[wheel] = wheelSettings(layout);
  for (DriveIndex i = layout.wheels; i < layout.firstAxis(); ++i) {
    options.of_drive["single" + std::to_string(i - layout.wheels)] = singleSettings(layout);
  }
  for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
    Values& own = options.of_drive["single" + std::to_string(i - layout.wheels)];
    addAxisSettings(layout, i, own);
    own["ppo_type"] = 2;
  }
  const LiftWords words = layout.one_module ? kSk2xx : kSk53x;
  options.simulate = [layout, words](sim::SimConfig& config) {
    for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
      config.drives[i].bus.as<sim::DpDriveConfig>().ppo_type = 2;
    }
    simulateAxes(layout, words, config);
  };
  options.wrap = wrap;
  return std::make_unique<ProfibusRig>(options);
}

}  // namespace

CampaignBus profibusCampaign() {
  return {"profibus", makeProfibus, profibusActs, 1500, Shares::kFourOrSingles, true, 6, 2250};
}

}  // namespace nord_driver::test
