#include "sim/robot/robot_sim.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);

}  // namespace

RobotSim::RobotSim(const SimConfig& config) : config_(config) {
  for (const DriveConfig& drive : config_.drives) addDrive(drive);
  if (!config_.body) return;
  const BodyConfig& body = *config_.body;
  if (body.kind == BodyKind::kMecanum) {
    body_ = std::make_unique<MecanumBody>(body.wheel_radius, body.wheel_separation, body.wheel_base);
  } else {
    body_ = std::make_unique<DiffDriveBody>(body.wheel_radius, body.wheel_separation);
  }
}

void RobotSim::addDrive(const DriveConfig& config) {
  for (const std::unique_ptr<DriveUnit>& other : drives_) {
    if (config_.can || other->config().slave.address != config.slave.address) continue;  // CanStations checks its own
    if (other->config().place != config.place && other->config().place > 0 && config.place > 0) continue;
    throw ConfigError("drives " + other->name() + " and " + config.name + " have the same address " +
                      std::to_string(config.slave.address) +
                      "; expected one station each, or two places behind one module");
  }
  if (config.place > 0) {
    drives_.push_back(std::make_unique<DriveUnit>(config, moduleAt(config.slave.address)));
  } else {
    drives_.push_back(std::make_unique<DriveUnit>(config, referee_));
    stations_.push_back(&drives_.back()->slave());
  }
}

ModuleStation& RobotSim::moduleAt(std::uint8_t address) {
  for (const std::unique_ptr<ModuleStation>& module : modules_) {
    if (module->address() == address) return *module;
  }
  ModuleConfig found;
  found.settings.address = address;
  for (const ModuleConfig& listed : config_.modules) {
    if (listed.settings.address == address) found = listed;
  }
  found.settings.baud_rate = config_.baud_rate;
  modules_.push_back(std::make_unique<ModuleStation>(found.settings, &referee_));
  ModuleStation& module = *modules_.back();
  for (const ParameterPreset& preset : found.parameters) {
    module.parameters().preset(preset.number, preset.set, preset.element, preset.raw);
  }
  module.setPowered(true);
  stations_.push_back(&module);
  return module;
}

void RobotSim::advance(Instant now) noexcept {
  if (!now_) {
    now_ = now;
    step(Duration::zero());
  }
  while (*now_ < now) {
    const Duration span = std::min(kStep, now - *now_);
    step(span);
    *now_ += span;
  }
}

void RobotSim::step(Duration span) noexcept {
  for (const std::unique_ptr<ModuleStation>& module : modules_) module->advance(span);
  for (const std::unique_ptr<DriveUnit>& drive : drives_) drive->advance(span);
  if (body_ == nullptr) return;
  body_->moveTo(wheels(&DriveUnit::wheelAngle));
  body_->setSpeeds(wheels(&DriveUnit::wheelSpeed));
}

// Of a side that turns as one the mean counts.
Wheels RobotSim::wheels(double (DriveUnit::*of)() const noexcept) const noexcept {
  const auto wheel = [&](std::size_t drive) { return (*drives_[drive].*of)(); };
  const auto mean = [&](const std::vector<std::size_t>& side) {
    double sum = 0.0;
    for (const std::size_t drive : side) sum += wheel(drive);
    return sum / static_cast<double>(side.size());
  };
  const BodyConfig& body = *config_.body;
  if (body.kind == BodyKind::kMecanum) {
    return {wheel(body.left[0]), wheel(body.left[1]), wheel(body.right[0]), wheel(body.right[1])};
  }
  const double left = mean(body.left);
  const double right = mean(body.right);
  return {left, left, right, right};
}

void RobotSim::receive(ByteView bytes, Instant now, Judge judge, AnswerSink& sink) noexcept {
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

void RobotSim::judgeOnly(ByteView bytes) noexcept {
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

void RobotSim::delivered(const WireBytes& bytes) noexcept {
  Telegram telegram;
  if (parseTelegram(bytes, telegram).kind == ParseKind::kTelegram) referee_.answer(telegram);
}

DriveUnit* RobotSim::find(const std::string& name) noexcept {
  for (const std::unique_ptr<DriveUnit>& drive : drives_) {
    if (drive->name() == name) return drive.get();
  }
  return nullptr;
}

}  // namespace nord_driver::sim
