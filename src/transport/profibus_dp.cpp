#include "nord_driver/transport/profibus_dp.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "nord_driver/profile/status_word.h"
#include "nord_driver/transport/profibus_telegram_text.h"
#include "nord_driver/transport/setting_checks.h"

namespace nord_driver {

namespace {

constexpr Duration kReopenInterval = std::chrono::milliseconds{500};

// The manual wants an order repeated until it is answered (BU 2700 6.5); a healthy inverter takes a few cycles.
Duration answerTimeout(double cycle_rate) {
  return std::max(seconds(1.0), 20 * seconds(1.0 / cycle_rate));
}

std::unique_ptr<link::ByteLink> openSerialPort(const link::SerialSettings& settings) {
  return std::make_unique<link::SerialPort>(settings);
}

}  // namespace

ProfibusDpTransport::ProfibusDpTransport() : ProfibusDpTransport(openSerialPort) {}

ProfibusDpTransport::ProfibusDpTransport(LinkFactory make_link) : make_link_(std::move(make_link)) {}

void ProfibusDpTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readProfibusDpConfig(bus, drives, cycle_rate);
  try {
    master_.emplace(config_.bus, config_.slaves);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(bus.fullName("") + ": " + error.what());
  }
  trace_.emplace(kLinkTypeProfibusDl, ProfibusTelegramText{config_});
  recorder_.emplace(*trace_);
  drives_.assign(config_.drives.size(), DriveState{answerTimeout(cycle_rate)});
  link_ = make_link_(config_.line);
}

Instant ProfibusDpTransport::now() const noexcept {
  return link_->now();
}

void ProfibusDpTransport::sleepUntil(Instant when) noexcept {
  link_->sleepUntil(when);
}

// A device that is not there is looked for again and again, whatever happened to it.
bool ProfibusDpTransport::linkReady() noexcept {
  if (link_->isOpen()) return true;
  const Instant now = link_->now();
  if (now < next_open_) return false;
  next_open_ = now + kReopenInterval;
  if (!link_->open()) return false;
  master_->restart(now);
  return true;
}

void ProfibusDpTransport::exchange(const std::vector<profile::ProcessOutput>& outputs,
                                   std::vector<DriveExchange>& inputs) noexcept {
  const bool ready = linkReady();
  if (ready) {
    for (DriveIndex drive = 0; drive < drives_.size(); ++drive) putOutput(drive, outputs[drive]);
    runMaster();
  }
  for (DriveIndex drive = 0; drive < drives_.size(); ++drive) takeInput(drive, inputs[drive]);
}

void ProfibusDpTransport::runMaster() noexcept {
  std::uint8_t buffer[512];
  profibus::DpMaster& master = *master_;
  master.startCycle(link_->now());
  while (!master.cycleDone() && link_->isOpen()) {
    const Instant start = link_->now();
    const ByteView telegram = master.pollTransmit(start);
    if (!telegram.empty()) {
      recorder_->handleSent(telegram, start);
      link_->write(telegram);
      continue;
    }
    const auto deadline = master.nextDeadline();
    if (!deadline) break;
    if (link_->waitReadable(*deadline)) {
      const std::size_t count = link_->read(buffer, sizeof buffer);
      const Instant read = link_->now();
      recorder_->handleReceived({buffer, count}, read);
      master.handleBytes({buffer, count}, read);
    }
    if (link_->now() >= *deadline) master.handleTimeout(link_->now());
  }
  while (master.pollEvent()) {
  }
  if (!link_->isOpen()) {
    // Gone in the middle of a cycle: nobody exchanges until it is back.
    master.restart(link_->now());
    recorder_->flush();
    next_open_ = link_->now() + kReopenInterval;
  }
}

void ProfibusDpTransport::putOutput(DriveIndex drive, const profile::ProcessOutput& output) noexcept {
  const ProfibusDrive& config = config_.drives[drive];
  profile::PkwWords pkw{};
  if (config.ppo.has_pkw) pkw = drives_[drive].pkw.pollWords(link_->now());
  const profile::PpoWords words = profile::pack(config.ppo, pkw, output);
  FixedBytes<2 * profile::PpoWords::capacity()> bytes;
  ByteWriter writer{bytes};
  for (const Word word : words) writer.u16be(word);
  master_->setOutputs(config.slave, bytes);
}

void ProfibusDpTransport::takeInput(DriveIndex drive, DriveExchange& input) noexcept {
  const ProfibusDrive& config = config_.drives[drive];
  const profibus::SlaveStatus& slave = master_->status(config.slave);
  DriveState& state = drives_[drive];

  input = {};
  state.module_answers = link_->isOpen() && slave.exchanged_this_cycle;
  state.inverter_answers = false;
  if (state.module_answers) {
    ByteReader reader{master_->inputs(config.slave)};
    profile::PpoWords words;
    while (reader.remaining() >= 2) words.push_back(reader.u16be());
    profile::PkwWords pkw{};
    if (profile::unpack(config.ppo, words, pkw, input.input)) {
      // A module with its own 24 V supply answers for an inverter that is off, with zeros (BU 0020 2.1.3).
      state.inverter_answers = profile::StatusWord{input.input.status_word}.isUseful();
      if (config.ppo.has_pkw && state.inverter_answers) state.pkw.handleWords(pkw, link_->now());
    }
  }
  // An inverter that is off has forgotten its order, whether its module answers or not: no answer is waited for.
  const bool exchanging = link_->isOpen() && slave.phase == profibus::SlavePhase::kDataExchange;
  if (!exchanging || (state.module_answers && !state.inverter_answers)) state.pkw.handleOffline(link_->now());
  input.module_answers = state.module_answers;
  input.inverter_answers = state.inverter_answers;
}

bool ProfibusDpTransport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  if (config_.drives[drive].ppo.has_pkw) return drives_[drive].pkw.submit(request, link_->now());
  profile::ParameterResult result;
  result.id = request.id;
  result.outcome = profile::ParameterOutcome::kNoChannel;  // PPO 3 and 4 carry process data only (BU 0020 7.2)
  return refused_.push_back(result);
}

std::optional<profile::ParameterResult> ProfibusDpTransport::pollResult() noexcept {
  if (!refused_.empty()) {
    const profile::ParameterResult result = refused_[0];
    refused_.eraseFront(1);
    return result;
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const auto result = drives_[result_cursor_].pkw.pollResult();
    if (result) return result;
    result_cursor_ = (result_cursor_ + 1) % drives_.size();
  }
  return std::nullopt;
}

bool ProfibusDpTransport::connected() const noexcept {
  return link_->isOpen() &&
         std::any_of(drives_.begin(), drives_.end(), [](const DriveState& drive) { return drive.module_answers; });
}

BusCounters ProfibusDpTransport::counters() const noexcept {
  const profibus::Counters& from = master_->counters();
  BusCounters to;
  to.cycles = from.cycles;
  to.telegrams_sent = from.telegrams_sent;
  to.telegrams_received = from.telegrams_received;
  to.retries = from.retries;
  to.timeouts = from.timeouts;
  to.checksum_errors = from.checksum_errors;
  const link::LineCounters line = link_->lineCounters();
  to.parity_errors = line.parity_errors;
  to.discarded_bytes = from.discarded_bytes;
  to.unexpected = from.unexpected + line.collisions;
  for (const DriveState& drive : drives_) to.stale += drive.pkw.stale();
  return to;
}

DriveNote ProfibusDpTransport::note(DriveIndex drive) const noexcept {
  if (!link_->isOpen()) return {"the bus device is not open"};
  const DriveState& state = drives_[drive];
  if (state.module_answers && !state.inverter_answers) {
    return {"the bus module answers, but the inverter behind it does not: is its mains supply on?"};
  }
  return {master_->status(config_.drives[drive].slave).note};
}

std::uint32_t ProfibusDpTransport::identNumber(DriveIndex drive) const noexcept {
  return master_->status(config_.drives[drive].slave).ident.value_or(0);
}

Sentence ProfibusDpTransport::busText() const noexcept {
  Sentence text;
  if (!link_->isOpen()) {
    text.format("%s", link_->lastError().empty() ? "the bus device is not open yet" : link_->lastError().c_str());
  } else if (!connected()) {
    text.format(
        "%s is open, but no station answers: are the modules powered, is the baud rate right, are the wires A "
        "and B the right way round and terminated?",
        config_.device.c_str());
  } else if (std::all_of(drives_.begin(), drives_.end(), [](const DriveState& d) { return d.inverter_answers; })) {
    text.format("%s", link_->warning());  // a silent drive is worse news, told by its note
  }
  return text;
}

DriveIdentity ProfibusDpTransport::identity(DriveIndex drive) const {
  const ProfibusDrive& config = config_.drives[drive];
  DriveIdentity identity;
  identity.address = "PROFIBUS station " + std::to_string(config_.slaves[config.slave].address.value());
  identity.process_values = config.ppo.process_values;
  identity.parameter_channel = config.ppo.has_pkw ? "PKW" : "none";
  identity.protected_by = "PROFIBUS watchdog of " + shortNumber(toSeconds(config_.watchdog)) +
                          " s: the inverter trips E10.2 and the motor coasts";
  identity.protection_time = toSeconds(config_.watchdog);
  return identity;
}

void ProfibusDpTransport::close() noexcept {
  if (link_) link_->close();
}

}  // namespace nord_driver
