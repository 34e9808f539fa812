#include "sim/profibus/dp_stations.h"

#include <algorithm>

#include "sim/profibus/dp_slave.h"
#include "sim/profibus/services.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);

// P509, control word and setpoint from PROFIBUS: BU 0020 6.2.2, of the older series 6.1.2.
constexpr std::int32_t kProfibus = 4;
constexpr std::int32_t kProfibusOlderSeries = 10;
// Through a module on the system bus: BU 2700 7.2.
constexpr std::int32_t kSystemBus = 3;
constexpr std::int32_t kCanopen = 6;

std::int32_t controlWordSource(const DriveConfig& config) {
  if (config.place > 0) return config.device.isDecentral() ? kSystemBus : kCanopen;
  return config.device.isOlderSeries() ? kProfibusOlderSeries : kProfibus;
}

/// BU 2700 7.2: P507 the PPO type, P508 the address, P509 PROFIBUS.
Commissioning commissioningOf(const DriveConfig& config) {
  Commissioning commissioning;
  commissioning.wiring.on_system_bus = config.place > 0;
  commissioning.parameters = {{507, 0, 0, config.bus.as<DpDriveConfig>().ppo_type},
                              {508, 0, 0, config.address},
                              {509, 0, 0, controlWordSource(config)}};
  return commissioning;
}

}  // namespace

DpStations::DpStations(RobotSim& robot) : robot_(robot) {
  for (const auto& drive : robot_.drives()) connect(*drive);
}

void DpStations::connect(DriveUnit& drive) {
  const DriveConfig& config = drive.config();
  for (std::size_t i = 0; i < station_of_.size(); ++i) {
    const DriveConfig& other = robot_.drive(i).config();
    if (other.address != config.address) continue;
    if (other.place != config.place && other.place > 0 && config.place > 0) continue;
    throw ConfigError("drives " + other.name + " and " + config.name + " have the same address " +
                      std::to_string(config.address) + "; expected one station each, or two places behind one module");
  }
  if (config.place > 0) {
    ModuleStation& module = moduleAt(config.address);
    station_of_.push_back(&module);
    drive.connect(module, commissioningOf(config));
    return;
  }
  DpSlave& slave = robot_.add(std::make_unique<DpSlave>(drive, &referee_));
  stations_.push_back(&slave);
  station_of_.push_back(&slave);
  drive.connect(slave, commissioningOf(config));
  slave.setPowered(true);
}

ModuleStation& DpStations::moduleAt(std::uint8_t address) {
  for (ModuleStation* module : modules_) {
    if (module->address() == address) return *module;
  }
  const DpBusConfig& bus = robot_.config().bus.as<DpBusConfig>();
  ModuleConfig found;
  found.settings.address = address;
  for (const ModuleConfig& listed : bus.modules) {
    if (listed.settings.address == address) found = listed;
  }
  found.settings.baud_rate = bus.baud_rate;
  ModuleStation& module = robot_.add(std::make_unique<ModuleStation>(found.settings, &referee_));
  modules_.push_back(&module);
  stations_.push_back(&module);
  for (const ParameterPreset& preset : found.parameters) {
    module.parameters().preset(preset.number, preset.set, preset.element, preset.raw);
  }
  module.setPowered(true);
  return module;
}

void DpStations::advance(Instant now) noexcept {
  if (!started_) {
    started_ = true;
    now_ = now;
    step(Duration::zero());
  }
  while (now_ < now) step(std::min(kStep, now - now_));
}

void DpStations::step(Duration span) noexcept {
  for (DpStation* station : stations_) station->advance(span);
  now_ += span;
  robot_.advance(now_);
}

bool DpStations::isAnswered(ByteView request) noexcept {
  Telegram telegram;
  if (parseTelegram(request, telegram).kind != ParseKind::kTelegram) return false;
  return telegram.isRequest() && telegram.destination != kBroadcast && telegram.code() != kSdnLow &&
         telegram.code() != kSdnHigh;
}

void DpStations::receive(ByteView bytes, Instant now, Judge judge, AnswerSink& sink) noexcept {
  advance(now);
  bool garbage = false;
  for (const std::uint8_t byte : bytes) {
    if (!input_.push_back(byte)) {
      input_.eraseFront(1);
      input_.push_back(byte);
      garbage = true;
    }
  }
  while (!input_.empty()) {
    const ParseResult parsed = parseTelegram(input_, telegram_);
    if (parsed.kind == ParseKind::kNeedMore) break;
    if (parsed.kind == ParseKind::kMalformed) {
      garbage = true;
      input_.eraseFront(1);
      continue;
    }
    input_.eraseFront(parsed.length);
    if (judge == Judge::kYes) referee_.request(telegram_);
    for (DpStation* station : stations_) {
      const std::optional<WireBytes> reply = station->handle(telegram_);
      if (reply) sink.answer(*reply, station->answerDelay());
    }
  }
  if (garbage && judge == Judge::kYes) referee_.broken(Rule::kNoTelegram);
}

void DpStations::judgeOnly(ByteView bytes) noexcept {
  Telegram telegram;
  while (!bytes.empty()) {
    const ParseResult parsed = parseTelegram(bytes, telegram);
    if (parsed.kind != ParseKind::kTelegram) {
      referee_.broken(Rule::kNoTelegram);
      return;
    }
    referee_.request(telegram);
    bytes = bytes.sub(parsed.length);
  }
}

void DpStations::delivered(const WireBytes& bytes) noexcept {
  Telegram telegram;
  if (parseTelegram(bytes, telegram).kind == ParseKind::kTelegram) referee_.answer(telegram);
}

}  // namespace nord_driver::sim
