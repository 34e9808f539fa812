#include "campaign/acts.h"
#include "campaign/rig.h"

namespace nord_driver::test {

namespace {

sim::DriveUnit& unitOf(CampaignRig& rig, const Event& event) {
  return rig.unit(event.drive);
}

bool tellsLocalControl(CampaignRig& rig, const Event&) {
  return rig.tellsLocalControl();
}

void setTerminals(CampaignRig& rig, const Event& event, bool coast, bool quick_stop) {
  sim::Terminals terminals;
  terminals.coast = coast;
  terminals.quick_stop = quick_stop;
  unitOf(rig, event).inverter().setTerminals(terminals);
}

}  // namespace

void letItBeSeen(CampaignRig& rig) {
  rig.passWithoutTheDriver(std::chrono::milliseconds{5});
}

void supply(CampaignRig& rig, const Event& event, bool on) {
  sim::BusModule& module = unitOf(rig, event).module();
  if (module.supply() == sim::Supply::kOwn) return module.setPowered(on);
  unitOf(rig, event).setPlugged(on);
}

// amount: P105, 0.1 Hz.
Act otherDrive() {
  return {"other_drive",
          2,
          "power",
          Place::kStation,
          Cuts::kDrive,
          {200, 1500},
          {250, 1000},
          {0, 0},
          [](CampaignRig& rig, const Event& event) { unitOf(rig, event).setPlugged(false); },
          [](CampaignRig& rig, const Event& event) {
            for (unsigned set = 0; set < 4; ++set) unitOf(rig, event).parameters().preset(105, set, 0, event.amount);
            unitOf(rig, event).setPlugged(true);
          }};
}

// Power, links and terminals of a drive: BU 2700 6.4 and 8, BU 0020 2.1.3.
const std::vector<Act>& driveActs() {
  using R = CampaignRig;
  using E = Event;
  constexpr Range kOnce{0, 0}, kShort{20, 400}, kLong{50, 1500}, kNone{0, 0};
  static const std::vector<Act> acts{
      {"mute", 3, "mute", Place::kStation, Cuts::kStation, kLong, kNone, kNone,
       [](R& rig, const E& event) { unitOf(rig, event).setMute(true); },
       [](R& rig, const E& event) { unitOf(rig, event).setMute(false); }},
      {"unplug", 3, "power", Place::kStation, Cuts::kDrive, kLong, kNone, kNone,
       [](R& rig, const E& event) { unitOf(rig, event).setPlugged(false); },
       [](R& rig, const E& event) { unitOf(rig, event).setPlugged(true); }},
      {"inverter_off", 3, "power", Place::kStation, Cuts::kDrive, kLong, kNone, kNone,
       [](R& rig, const E& event) { unitOf(rig, event).setInverterPower(false); },
       [](R& rig, const E& event) { unitOf(rig, event).setInverterPower(true); }},
      {"module_off", 2, "power", Place::kStation, Cuts::kStation, kLong, kNone, kNone,
       [](R& rig, const E& event) { supply(rig, event, false); },
       [](R& rig, const E& event) { supply(rig, event, true); }},
      {"link_cut", 2, "link", Place::kDrive, Cuts::kDrive, kLong, kNone, kNone,
       [](R& rig, const E& event) { unitOf(rig, event).setInverterLink(false); },
       [](R& rig, const E& event) { unitOf(rig, event).setInverterLink(true); }},
      // amount: ms each answer comes later.
      {"late_answers",
       2,
       "delay",
       Place::kStation,
       Cuts::kNothing,
       kShort,
       {1, 30},
       kNone,
       [](R& rig, const E& event) { unitOf(rig, event).setAnswerDelay(std::chrono::milliseconds{event.amount}); },
       [](R& rig, const E& event) { unitOf(rig, event).setAnswerDelay(Duration::zero()); }},
      // amount: P700 raw; its cause stands as long as it lasts, or not at all.
      {"trip",
       4,
       "trip",
       Place::kDrive,
       Cuts::kNothing,
       {0, 1500},
       {10, 209},
       kNone,
       [](R& rig, const E& event) {
         unitOf(rig, event).inverter().trip(static_cast<std::uint16_t>(event.amount), event.span != 0);
       },
       [](R& rig, const E& event) { unitOf(rig, event).inverter().clearCause(); },
       false,
       false},
      // amount: Hz at the terminals, 0: they say OFF1.
      {"local",
       3,
       "terminals",
       Place::kDrive,
       Cuts::kNothing,
       kLong,
       {-20, 20},
       kNone,
       [](R& rig, const E& event) {
         unitOf(rig, event)
             .inverter()
             .setLocalControl(true, event.amount < -10 || event.amount > 10 ? event.amount : 0);
       },
       [](R& rig, const E& event) { unitOf(rig, event).inverter().setLocalControl(false, 0.0); },
       false,
       false,
       tellsLocalControl},
      // Their inputs choose the parameter set, too. amount: as `local`; extra: the set, from 0.
      {"local_set",
       2,
       "terminals",
       Place::kDrive,
       Cuts::kNothing,
       kLong,
       {-20, 20},
       {0, 3},
       [](R& rig, const E& event) {
         sim::Terminals terminals;
         terminals.parameter_set = static_cast<unsigned>(event.extra);
         unitOf(rig, event).inverter().setTerminals(terminals);
         unitOf(rig, event)
             .inverter()
             .setLocalControl(true, event.amount < -10 || event.amount > 10 ? event.amount : 0);
       },
       [](R& rig, const E& event) {
         unitOf(rig, event).inverter().setLocalControl(false, 0.0);
         unitOf(rig, event).inverter().setTerminals({});
       },
       false,
       false,
       tellsLocalControl},
      {"off2", 2, "terminals", Place::kDrive, Cuts::kNothing, kLong, kNone, kNone,
       [](R& rig, const E& event) { setTerminals(rig, event, true, false); },
       [](R& rig, const E& event) { setTerminals(rig, event, false, false); }, false, false},
      {"off3", 2, "terminals", Place::kDrive, Cuts::kNothing, kLong, kNone, kNone,
       [](R& rig, const E& event) { setTerminals(rig, event, false, true); },
       [](R& rig, const E& event) { setTerminals(rig, event, false, false); }, false, false},
      {"mains_dip", 2, "power", Place::kStation, Cuts::kNothing, kOnce, kNone, kNone,
       [](R& rig, const E& event) {
         unitOf(rig, event).inverter().setPowered(false);
         unitOf(rig, event).inverter().setPowered(true);
       },
       nullptr},
      {"silent_parameters", 1, "parameters", Place::kDrive, Cuts::kNothing, kLong, kNone, kNone,
       [](R& rig, const E& event) {
         sim::ParameterSwitches switches;
         switches.silent = true;
         unitOf(rig, event).setParameterSwitches(switches);
       },
       [](R& rig, const E& event) { unitOf(rig, event).setParameterSwitches({}); }, false, false},
  };
  return acts;
}

}  // namespace nord_driver::test
