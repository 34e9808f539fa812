// The campaign over DeviceNet: an SK CU4-DEV for each drive, or one for up to four inverters.
#include "campaign/axes.h"
#include "campaign/rig.h"
#include "campaign/wheels.h"
#include "core/can_frame.h"
#include "system/devicenet_robot.h"

namespace nord_driver::test {
namespace {

// Every other system of single drives has none, in the AC drive profile: assembly 20 has "run forward" alone.
bool hasReverse(const Layout& layout) {
  return !layout.otherProfile() || layout.wheels != 0 || layout.exchange() % 2 == 1;
}

class DevicenetRig final : public CampaignRig {
 public:
  DevicenetRig(const DevicenetRobot::Options& options, const Layout& layout) : robot_(options), layout_(layout) {}

  DevicenetRobot& robot() override { return robot_; }
  sim::SimulatedDnBus& bus() { return robot_.bus(); }
  sim::DriveUnit& unit(DriveIndex drive) override { return robot_.unit(drive); }
  std::string referee(bool undisturbed) override {
    using Rule = sim::DnRule;
    const sim::DnReferee& referee = robot_.bus().referee();
    if (undisturbed) return referee.report();
    return referee.report({Rule::kZeroControlWord, Rule::kDuplicateMacUnanswered, Rule::kBeforeDuplicateCheck,
                           Rule::kReleaseChoice, Rule::kAllocateWithoutExplicit, Rule::kExplicitBeforeAllocation,
                           Rule::kIoBeforeAllocation, Rule::kIoAfterTimeout, Rule::kChangeUnacknowledged});
  }
  void passWithoutTheDriver(Duration span) override { robot_.bus().run(span); }
  void endLosses() override {
    bus().loseAnswers(0);
    bus().loseRequests(0);
    bus().overflow(0);
  }
  const std::vector<Act>& acts() const override { return devicenetCampaign().acts(); }

  /// Change of state and cyclic data, which we acknowledge (ODVA Vol. 3, 2-3).
  bool answersAreRepeated() const override { return byChange(); }
  bool reverses() const override { return hasReverse(layout_); }
  /// "Ctrl From Net" is NetCtrl, sent back: P509 and P510 are not queried (BU 0280 4.2.3.1).
  bool tellsLocalControl() const override { return !layout_.otherProfile(); }
  /// A poll is answered in its cycle, what has not changed comes with the rate of the module; two and a half of these.
  Duration silence() const override { return (byChange() ? rate() : robot_.config().period()) * 5 / 2; }
  /// With the next of its data, where these are cyclic.
  Duration toldLate() const override { return isCyclic() ? rate() : Duration::zero(); }
  /// Four times the expected packet rate (ODVA Vol. 3, 2-3.4).
  Duration driveSideTimeout() const override { return 4 * rate(); }
  Duration wireLatency() const override { return std::chrono::milliseconds{10}; }
  /// And two checks for a double MAC id of 2 s each, ours and that of the module (ODVA Vol. 3, 2-3.1).
  Duration backWithin() const override { return std::chrono::seconds{6}; }

 private:
  bool isCyclic() const { return layout_.exchange() == 2; }  // ioOf
  bool byChange() const { return layout_.exchange() == 1 || isCyclic(); }
  /// Two cycles and at least 25 ms, in the steps of 10 ms of the module.
  Duration rate() const {
    constexpr Duration kStep = std::chrono::milliseconds{10}, kLeast = std::chrono::milliseconds{25};
    return (std::max(2 * robot_.config().period(), kLeast) + kStep - Duration{1}) / kStep * kStep;
  }

  DevicenetRobot robot_;
  Layout layout_;
};

constexpr std::uint16_t kProduct = 2;  // of SK TU4-DEV in the simulator

sim::SimulatedDnBus& busOf(CampaignRig& rig) {
  return static_cast<DevicenetRig&>(rig).bus();
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

// Another scanner: polls, an explicit request, a release, an answer nobody waits for, one of another length than a module's.
void sayForeign(CampaignRig& rig, const Event& event) {
  constexpr std::uint32_t kIds[] = {0x42D, 0x435, 0x42C, 0x436, 0x42B, 0x3C5};
  const std::uint8_t data[] = {0x11, 0x4C, 0x03, 0x01, static_cast<std::uint8_t>(event.extra)};
  busOf(rig).inject(dataFrame(kIds[event.amount], ByteView{data, event.amount == 5 ? 3u : 5u}));
}

void exchange(CampaignRig& rig, const Event& event, std::uint16_t product) {
  sim::DnModule& module = static_cast<DevicenetRig&>(rig).bus().module(event.drive);
  changeWithoutSupply(rig, event, [&] { module.identity().product = product; });
}

// The check for a double MAC id (ODVA Vol. 3, 2-3.1): physical port, vendor, serial number of somebody else.
void checkMac(CampaignRig& rig, unsigned mac, bool response) {
  const std::uint8_t port = response ? 0x80 : 0x00;
  const std::uint8_t data[] = {port, 0x0C, 0x00, 0x78, 0x56, 0x34, 0x12};
  busOf(rig).inject(dataFrame(0x400u | mac << 3 | 7u, ByteView{data, sizeof data}));
}

unsigned macOf(CampaignRig& rig, const Event& event) {
  return static_cast<DevicenetRig&>(rig).bus().module(event.drive).mac();
}

// One that asks itself at the time stays off: that is the next act. A scanner that hears nothing cannot answer.
bool mayBeAsked(CampaignRig& rig, const Event& event) {
  if (event.amount != 0) return busOf(rig).works();
  const sim::DnModule& module = static_cast<DevicenetRig&>(rig).bus().module(event.drive);
  return module.phase() == sim::DnModule::Phase::kOnline;
}

// What is said once may be lost: then the module goes on as if nobody had its id.
bool mayBeTold(CampaignRig& rig, const Event&) {
  return busOf(rig).disturbance().lose == 0.0;
}

const std::vector<Act>& devicenetActs() {
  using R = CampaignRig;
  using E = Event;
  constexpr Range kOnce{0, 0}, kNone{0, 0}, kCount{1, 8}, kSpan{50, 1500};
  static const std::vector<Act> acts{
      {"lose_answers", 4, "lose_answers", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { busOf(rig).loseAnswers(static_cast<unsigned>(event.amount)); }, nullptr, true},
      {"lose_requests", 4, "lose_requests", Place::kBus, Cuts::kNothing, kOnce, kCount, kNone,
       [](R& rig, const E& event) { busOf(rig).loseRequests(static_cast<unsigned>(event.amount)); }, nullptr, true},
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
       {3, 99},
       kNone,
       [](R& rig, const E& event) { exchange(rig, event, static_cast<std::uint16_t>(event.amount)); },
       [](R& rig, const E& event) { exchange(rig, event, kProduct); }},
      otherDrive(),
      // Somebody comes online. amount: he asks for the id of the module, or for the scanner's.
      {"mac_asked",
       2,
       "foreign",
       Place::kBus,
       Cuts::kNothing,
       kOnce,
       {0, 1},
       kNone,
       [](R& rig, const E& event) { checkMac(rig, event.amount == 0 ? macOf(rig, event) : 0, false); },
       nullptr,
       false,
       true,
       mayBeAsked},
      // He has the id of the module, which is off until its supply has been.
      {"mac_taken", 2, "power", Place::kStation, Cuts::kStation, kSpan, kNone, kNone,
       [](R& rig, const E& event) { checkMac(rig, macOf(rig, event), true); },
       [](R& rig, const E& event) { changeWithoutSupply(rig, event, [] {}); }, false, true, mayBeTold},
      {"foreign_master", 4, "foreign", Place::kBus, Cuts::kNothing, kOnce, {0, 5}, {0, 3}, sayForeign, nullptr},
  };
  return acts;
}

// The four kinds of I/O connection; a bit strobe brings back 8 bytes at most, which four inverters behind a module exceed.
const char* ioOf(const Layout& layout) {
  static constexpr const char* kKinds[] = {"poll", "cos", "cyclic", "strobe"};
  const char* const kind = kKinds[layout.exchange()];
  return layout.one_module && kind == kKinds[3] ? kKinds[0] : kind;
}

std::unique_ptr<CampaignRig> makeDevicenet(const Layout& layout, const TransportWrap& wrap) {
  DevicenetRobot::Options options;
  options.base = layout.wheels != 0;
  options.node = baseSettings(layout);
  options.each = driveSettingsOf(layout);
  for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
    addAxisSettings(layout, i, options.each[i]);
    options.each[i]["assembly"] = 101;
  }
  for (Values& values : options.each) {
    values["vendor_id"] = static_cast<int>(sim::DnIdentity{}.vendor);
    values["product_code"] = static_cast<int>(kProduct);
    values["io"] = std::string{ioOf(layout)};
  }
  options.modules = layout.drives();
  if (layout.one_module) options.gateway_inverters = layout.drives();
  if (layout.one_module) options.assembly = 102;  // four inverters, two bytes each and the control byte
  if (layout.otherProfile()) options.assembly = hasReverse(layout) ? 21 : 20;
  options.simulate = [layout](sim::SimConfig& config) {
    simulateWheels(layout, config);
    for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
      config.drives[i].bus.as<sim::DnDriveConfig>().assembly = 101;
    }
    simulateAxes(layout, kSk2xx, config);
  };
  options.wrap = wrap;
  return std::make_unique<DevicenetRig>(options, layout);
}

}  // namespace

CampaignBus devicenetCampaign() {
  return {"devicenet", makeDevicenet, devicenetActs, 4500, Shares::kAny, false, 8, 4500};
}

}  // namespace nord_driver::test
