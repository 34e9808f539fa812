#include "sim/devicenet/dn_stations.h"

#include <algorithm>

#include "sim/devicenet/dn_identifiers.h"
#include "sim/devicenet/dn_layout.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);

/// P509 DeviceNet; on a technology unit P507 the assembly.
Commissioning commissioningOf(const DriveConfig& config) {
  const DnDriveConfig& dn = config.bus.as<DnDriveConfig>();
  Commissioning commissioning;
  commissioning.wiring = dnWiring(config);
  if (commissioning.wiring.source) commissioning.parameters.push_back({509, 0, 0, *commissioning.wiring.source});
  if (dn.kind == DnModuleKind::kOnInverter) {
    commissioning.parameters.push_back({507, 0, 0, dnSelectionOfInstance(dn.assembly)});
  }
  return commissioning;
}

/// Any drive of a module says who it is for those that do not, as the driver has it; what is said of the module counts.
void identify(DnModuleSettings& settings, const std::vector<DriveConfig>& drives) {
  const auto take = [&](const DnGivenIdentity& given) {
    settings.identity.vendor = given.vendor.value_or(settings.identity.vendor);
    settings.identity.device_type = given.device_type.value_or(settings.identity.device_type);
    settings.identity.product = given.product.value_or(settings.identity.product);
  };
  if (settings.kind == DnModuleKind::kGateway) settings.identity.product = 2;
  for (const DriveConfig& drive : drives) {
    if (drive.address == settings.mac) take(drive.bus.as<DnDriveConfig>().identity);
  }
  take(settings.given);
}

/// What the drives behind a module make of it.
void describe(DnModuleSettings& settings, const DriveConfig& drive) {
  const DnDriveConfig& dn = drive.bus.as<DnDriveConfig>();
  if (dn.kind == DnModuleKind::kOnInverter) return;
  // Before what the configuration says of the module itself: the last one counts.
  std::vector<ParameterPreset> presets{{160, 0, 0, dnSelectionOfInstance(dn.assembly)}};
  if (dn.assembly == 120) {
    const auto number = static_cast<std::uint16_t>(162 + (drive.place > 0 ? drive.place - 1 : 0));
    presets.push_back({number, 0, 0, static_cast<std::int32_t>(dn.status_bytes)});
    presets.push_back({number, 0, 1, static_cast<std::int32_t>(dn.control_bytes)});
    presets.push_back({number, 0, 2, static_cast<std::int32_t>(dn.profile)});
    if (dn.module_input_bytes > 0) presets.push_back({161, 0, 0, 1});
    if (dn.module_output_bytes > 0) presets.push_back({161, 0, 1, 1});
  }
  settings.parameters.insert(settings.parameters.begin(), presets.begin(), presets.end());
}

}  // namespace

DnStations::DnStations(RobotSim& robot) : robot_(robot) {
  const DnBusConfig& bus = robot_.config().bus.as<DnBusConfig>();
  std::vector<DnModuleSettings> plan;
  std::vector<std::array<bool, BusModule::kPlaces>> taken;
  for (std::size_t i = 0; i < robot_.drives().size(); ++i) {
    const DriveConfig& config = robot_.drive(i).config();
    const DnDriveConfig& dn = config.bus.as<DnDriveConfig>();
    const std::size_t place = config.place > 0 ? config.place - 1 : 0;
    auto at = std::find_if(plan.begin(), plan.end(),
                           [&](const DnModuleSettings& settings) { return settings.mac == config.address; });
    if (at == plan.end()) {
      const auto said = std::find_if(bus.modules.begin(), bus.modules.end(),
                                     [&](const DnModuleSettings& settings) { return settings.mac == config.address; });
      DnModuleSettings settings = said == bus.modules.end() ? DnModuleSettings{} : *said;
      settings.mac = config.address;
      settings.kind = dn.kind;
      settings.bit_rate = bus.bit_rate;
      if (dn.kind == DnModuleKind::kGateway && said == bus.modules.end()) settings.name = "SK TU4-DEV";
      identify(settings, robot_.config().drives);
      plan.push_back(settings);
      taken.push_back({});
      at = plan.end() - 1;
    } else if (dn.kind != DnModuleKind::kGateway || at->kind != DnModuleKind::kGateway) {
      throw ConfigError("drive " + config.name + ": MAC id " + std::to_string(config.address) +
                        " is taken; expected a module of its own, or an inverter number of its own behind one gateway");
    }
    const auto index = static_cast<std::size_t>(at - plan.begin());
    if (taken[index][place]) {
      throw ConfigError("drive " + config.name + ": inverter " + std::to_string(place + 1) + " behind MAC id " +
                        std::to_string(config.address) + " is taken; expected a number of its own");
    }
    taken[index][place] = true;
    describe(*at, config);
    module_of_.push_back(index);
  }
  for (const DnModuleSettings& settings : plan) {
    modules_.push_back(&robot_.add(std::make_unique<DnModule>(settings, referee_)));
  }
  for (std::size_t i = 0; i < module_of_.size(); ++i) {
    DriveUnit& drive = robot_.drive(i);
    drive.connect(moduleOf(i), commissioningOf(drive.config()));
  }
}

void DnStations::advance(Instant now, CanSink& sink) noexcept {
  if (!started_) {
    started_ = true;
    now_ = now;
    robot_.advance(now);
  }
  while (now_ < now) {
    const Duration span = std::min(kStep, now - now_);
    now_ += span;
    robot_.advance(now_);
    for (DnModule* module : modules_) module->advance(span, sink);
  }
  referee_.advance(now_);
  // Nobody acknowledges: the controller repeats one frame until somebody is there again.
  if (!anyAlive()) referee_.stoodStill();
}

void DnStations::receive(const CanFrame& frame, Judge judge, CanSink& sink) noexcept {
  const bool judged = judge == Judge::kYes;
  judged ? referee_.masterFrame(frame) : referee_.foreignFrame(frame);
  for (DnModule* module : modules_) module->receive(frame, judged, sink);
}

void DnStations::delivered(const CanFrame& frame, bool to_master, CanSink& sink) noexcept {
  if (to_master) referee_.delivered(frame);
  for (DnModule* module : modules_) {
    // A node does not hear its own request for its MAC id.
    if (frame.id != dn::group2(dn::kDuplicateMac, module->mac())) module->receive(frame, false, sink);
  }
}

bool DnStations::isAnswered(const CanFrame& frame) const noexcept {
  return !dn::isGroup2(frame.id) || dn::messageOfGroup2(frame.id) != dn::kAcknowledge;
}

void DnStations::stoodStill() noexcept {
  referee_.stoodStill();
  for (DnModule* module : modules_) module->stoodStill();
}

bool DnStations::anyAlive() const noexcept {
  return std::any_of(modules_.begin(), modules_.end(), [](const DnModule* module) { return module->alive(); });
}

}  // namespace nord_driver::sim
