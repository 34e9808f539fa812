#include "transport/profibus/profibus_dp.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/setting_checks.h"
#include "profile/status_word.h"
#include "transport/profibus/profibus_counters.h"
#include "transport/profibus/profibus_line.h"
#include "transport/profibus/profibus_scanner.h"
#include "transport/profibus/profibus_telegram_text.h"
#include "transport/reopen_interval.h"

namespace nord_driver {

namespace {

constexpr Duration kScanSlice = std::chrono::milliseconds{50};  // of one exchange()
constexpr Duration kToldFor = std::chrono::seconds{10};
constexpr int kCyclesToTell = 3;                                 // the one that sees the silence, and two with the word
constexpr unsigned kModuleOutputs = 0x03, kModuleInputs = 0x0F;  // DO1, DO2 and DI1 to DI4: BU 0220 4.2.2.4

// The manual wants an order repeated until it is answered (BU 2700 6.5); a healthy inverter takes a few cycles.
Duration answerTimeout(double cycle_rate) {
  return std::max(seconds(1.0), 20 * seconds(1.0 / cycle_rate));
}

}  // namespace

ProfibusDpTransport::ProfibusDpTransport() : ProfibusDpTransport(openSerialPort) {}

ProfibusDpTransport::ProfibusDpTransport(LinkFactory make_link) : make_link_(std::move(make_link)) {}

void ProfibusDpTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readProfibusDpConfig(bus, drives, cycle_rate);
  if (parameters_only_) endWithoutATrip(config_);
  try {
    master_.emplace(config_.bus, config_.slaves);
    if (config_.scan) scan_.emplace(config_.bus);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(bus.fullName("") + ": " + error.what());
  }
  trace_.emplace(kLinkTypeProfibusDl, ProfibusTelegramText{config_});
  recorder_.emplace(*trace_);
  parameters_.emplace(config_, answerTimeout(cycle_rate));
  text_.emplace(config_);
  drives_.assign(config_.drives.size(), DriveState{});
  presence_.clear();
  for (std::size_t i = 0; i < config_.stations.size(); ++i) {
    const std::vector<std::size_t>& members = config_.stations[i].drives;
    presence_.emplace_back(members.size(), config_.slaves[i].dpv1);
    for (std::size_t place = 0; place < members.size(); ++place) drives_[members[place]].place = place;
  }
  link_ = make_link_(config_.line);
}

// The drive stops by its time-out, and its word has to go out to a station that may hear it: the station is lost some
// cycles later. With the silence of one a cycle may be as long as the worst.
void ProfibusDpTransport::setDriveTimeout(Duration timeout) noexcept {
  const Duration limit = timeout + kCyclesToTell * config_.worst_cycle;
  for (std::size_t station = 0; station < presence_.size(); ++station) master_->setSilenceLimit(station, limit);
}

bool ProfibusDpTransport::serveParametersOnly() noexcept {
  parameters_only_ = true;
  return true;
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
  if (scan_) scan_->start(now);
  return true;
}

void ProfibusDpTransport::exchange(const std::vector<profile::ProcessOutput>& outputs,
                                   std::vector<DriveExchange>& inputs) noexcept {
  if (linkReady() && !scanning()) {
    if (config_.bus.sync_outputs || config_.bus.freeze_inputs) {
      master_->setSynchronised(mayBeSynchronised(outputs, inputs));
    }
    for (std::size_t station = 0; station < presence_.size(); ++station) putOutputs(station, outputs);
    parameters_->submitRecords(*master_, link_->now());
    runMaster();
    parameters_->takeRecords(*master_, link_->now());
  }
  for (std::size_t station = 0; station < presence_.size(); ++station) takeInputs(station, inputs);
  watchLine();
}

template <typename Engine, typename Done>
void ProfibusDpTransport::run(Engine& engine, Done done) noexcept {
  talkOnLine(engine, *link_, *recorder_, Instant::max(), done);
  if (!link_->isOpen()) {
    // Gone in the middle of a cycle: nobody exchanges until it is back.
    master_->restart(link_->now());
    recorder_->flush();
    next_open_ = link_->now() + kReopenInterval;
  }
}

void ProfibusDpTransport::runMaster() noexcept {
  master_->startCycle(link_->now());
  run(*master_, [this] { return master_->cycleDone(); });
}

// 126 silent addresses take seconds behind a slow adapter: a piece of it per cycle, so that the cycle goes on.
bool ProfibusDpTransport::scanning() noexcept {
  if (!scan_) return false;
  const Instant end = link_->now() + kScanSlice;
  run(*scan_, [&] { return scan_->done() || link_->now() >= end; });
  if (!scan_->done()) return true;
  live_list_ = ProfibusText::liveList(*scan_);
  BusEvent told;
  told.warning = false;
  told.text.format("PROFIBUS scan: %s", live_list_.c_str());
  own_events_.push(told);
  for (unsigned address = 0; address < profibus::BusScan::kAddresses; ++address) {
    const auto number = static_cast<std::uint8_t>(address);
    const auto kind = scan_->station(number).kind;
    if (kind == profibus::ScannedStation::Kind::kSilent || kind == profibus::ScannedStation::Kind::kSelf) continue;
    told.text.format("PROFIBUS station %u %s", address, describe(number, scan_->station(number)).c_str());
    own_events_.push(told);
  }
  scan_.reset();
  master_->restart(link_->now());
  return false;
}

// SYNC keeps outputs, stop words included: it is for drives that all run as they should (BU 2700 6.3).
bool ProfibusDpTransport::mayBeSynchronised(const std::vector<profile::ProcessOutput>& outputs,
                                            const std::vector<DriveExchange>& inputs) const noexcept {
  constexpr unsigned kEnabled = 0x007F;
  for (DriveIndex drive = 0; drive < drives_.size(); ++drive) {
    const profile::StatusWord status{inputs[drive].input.status_word};
    if (!drives_[drive].inverter_answers || status.fault() || !status.operationEnabled()) return false;
    if ((outputs[drive].control_word & kEnabled) != kEnabled) return false;
  }
  return true;
}

void ProfibusDpTransport::putOutputs(std::size_t station, const std::vector<profile::ProcessOutput>& outputs) noexcept {
  FixedBytes<profibus::kMaxIoLength> bytes;
  ByteWriter<profibus::kMaxIoLength> writer{bytes};
  if (config_.stations[station].io_byte) {  // BU 0220 4.2.2.4
    std::uint8_t module_outputs = 0;
    for (const std::size_t drive : config_.stations[station].drives) {
      module_outputs = static_cast<std::uint8_t>(module_outputs | (outputs[drive].module_outputs & kModuleOutputs));
    }
    writer.u8(module_outputs);
  }
  for (const std::size_t drive : config_.stations[station].drives) {
    const profile::PpoLayout& layout = config_.drives[drive].ppo;
    profile::PkwWords pkw{};
    if (layout.has_pkw) pkw = parameters_->pollWords(drive, link_->now());
    for (const Word word : profile::pack(layout, pkw, outputs[drive])) writer.u16be(word);
  }
  master_->setOutputs(station, bytes);
}

void ProfibusDpTransport::takeInputs(std::size_t station, std::vector<DriveExchange>& inputs) noexcept {
  const profibus::SlaveStatus& slave = master_->status(station);
  const std::vector<std::size_t>& members = config_.stations[station].drives;
  InverterPresence& presence = presence_[station];
  const Instant now = link_->now();
  const bool answers = link_->isOpen() && slave.exchanged_this_cycle;
  const bool exchanging = isExchanging(station);

  std::array<profile::PkwWords, InverterPresence::kMaxInverters> pkw{};
  std::array<bool, InverterPresence::kMaxInverters> useful{};
  for (const std::size_t drive : members) {
    const std::size_t place = drives_[drive].place;
    inputs[drive] = {};
    inputs[drive].interruption = takeInterruption(drive);
    inputs[drive].given_way = master_->hasGivenWay();
    if (answers) takeInverter(drive, master_->inputs(station), inputs[drive], pkw[place]);
    const ByteView own = master_->inputs(station);
    if (answers && config_.stations[station].io_byte && !own.empty())
      inputs[drive].module_inputs = own[0] & kModuleInputs;
    // A module with its own 24 V supply answers for an inverter that is off, with zeros (BU 0020 2.1.3).
    useful[place] = answers && profile::StatusWord{inputs[drive].input.status_word}.isUseful();
  }
  if (answers) presence.handleExchange(slave.inverterLinkBroken(), useful, now);
  const Sentence why = master_->hasGivenWay() ? slave.note : "";
  if (!exchanging) {
    presence.handleSilence();
    parameters_->handleStationOffline(station, why, now);
  }
  askModule(station);

  for (const std::size_t drive : members) {
    DriveState& state = drives_[drive];
    state.module_answers = answers;
    state.inverter_answers = answers && presence.answers(state.place);
    if (state.inverter_answers && config_.drives[drive].ppo.has_pkw) {
      parameters_->handleWords(drive, pkw[state.place], now);
    }
    // An inverter that is off has forgotten its order, whether its module answers or not: no answer is waited for.
    if (!exchanging || (answers && !state.inverter_answers)) parameters_->handleInverterOffline(drive, why, now);
    inputs[drive].module_answers = state.module_answers;
    inputs[drive].inverter_answers = state.inverter_answers;
    inputs[drive].inverter_missing = state.module_answers && !state.inverter_answers;
    if (!state.inverter_answers) inputs[drive].input = {};
    explain(drive);
  }
}

// Silence is the drive's own to judge, by drive_timeout: a station that has left, though, may be set up again within it, and
// its first word would go on with a motion nobody knows the end of.
Interruption ProfibusDpTransport::takeInterruption(DriveIndex drive) noexcept {
  const std::uint64_t departures = master_->status(config_.drives[drive].slave).counters.departures;
  const bool told = std::exchange(drives_[drive].departures_told, departures) == departures;
  return told ? Interruption::kNone : Interruption::kUnasked;
}

void ProfibusDpTransport::takeInverter(DriveIndex drive, ByteView station_inputs, DriveExchange& input,
                                       profile::PkwWords& pkw) const noexcept {
  const ProfibusDrive& config = config_.drives[drive];
  ByteReader reader{station_inputs.sub(config.offset, config.ppo.bytes())};
  profile::PpoWords words;
  while (reader.remaining() >= 2) words.push_back(reader.u16be());
  profile::unpack(config.ppo, words, pkw, input.input);
}

// Where status words, diagnosis and parameter errors contradict each other, the module is asked.
void ProfibusDpTransport::askModule(std::size_t station) noexcept {
  InverterPresence& presence = presence_[station];
  const Instant now = link_->now();
  if (presence.doubtsDiagnosis(now)) master_->requestDiagnosis(station);
  if (presence.wantsModuleStatus(now)) parameters_->requestModuleStatus(station, now);
  const auto status = parameters_->pollModuleStatus(station);
  if (!status) return;
  std::array<std::uint8_t, InverterPresence::kMaxInverters> number{};
  for (const std::size_t drive : config_.stations[station].drives) {
    number[drives_[drive].place] = config_.drives[drive].inverter;
  }
  presence.handleModuleStatus(*status, number);
}

void ProfibusDpTransport::explain(DriveIndex drive) noexcept {
  DriveState& state = drives_[drive];
  const std::size_t station = config_.drives[drive].slave;
  if (!link_->isOpen()) {
    state.note = "the bus device is not open";
  } else if (scan_) {
    state.note = "waits for the scan of the bus to end";
  } else if (!state.module_answers) {
    state.note = text_->note(station, *master_);
  } else if (!state.inverter_answers) {
    state.note.format("the bus module answers, but the inverter behind it does not%s: is its mains supply on?",
                      presence_[station].linkBroken() ? " (diagnosis 02 04)" : "");
  } else {
    state.note.clear();
  }
}

void ProfibusDpTransport::watchLine() noexcept {
  const profibus::Counters& counters = master_->counters();
  const Instant now = link_->now();
  if (counters.foreign_telegrams != foreign_seen_) last_foreign_ = now;
  if (counters.busy != busy_seen_) last_busy_ = now;
  foreign_seen_ = counters.foreign_telegrams;
  busy_seen_ = counters.busy;
}

bool ProfibusDpTransport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  return parameters_->submit(drive, request, link_->now());
}

std::optional<profile::ParameterResult> ProfibusDpTransport::pollResult() noexcept {
  const auto result = parameters_->pollResult();
  while (const auto drive = parameters_->pollAbsence()) {
    presence_[config_.drives[*drive].slave].handleAbsence(drives_[*drive].place, link_->now());
  }
  return result;
}

bool ProfibusDpTransport::isExchanging(std::size_t station) const noexcept {
  return link_->isOpen() && master_->status(station).phase == profibus::SlavePhase::kDataExchange;
}

bool ProfibusDpTransport::connected() const noexcept {
  for (std::size_t station = 0; station < presence_.size(); ++station) {
    if (isExchanging(station)) return true;
  }
  return false;
}

BusCounters ProfibusDpTransport::counters() const noexcept {
  return profibusCounters(master_->counters(), link_->lineCounters(), parameters_->stale());
}

DriveNote ProfibusDpTransport::note(DriveIndex drive) const noexcept {
  return {drives_[drive].note.c_str()};
}

std::uint32_t ProfibusDpTransport::identNumber(DriveIndex drive) const noexcept {
  return master_->status(config_.drives[drive].slave).ident.value_or(0);
}

std::optional<BusEvent> ProfibusDpTransport::pollEvent() noexcept {
  if (auto event = own_events_.pop()) return event;
  if (const auto event = master_->pollEvent()) return text_->event(*event, *master_);
  return std::nullopt;
}

// No station is in data exchange. One that answers all the same says why, and that is no matter of wires.
Sentence ProfibusDpTransport::silenceText() const noexcept {
  for (std::size_t station = 0; station < presence_.size(); ++station) {
    if (master_->status(station).heard) return text_->named(station, text_->note(station, *master_).c_str());
  }
  return text_->silence(live_list_);
}

Sentence ProfibusDpTransport::busText() const noexcept {
  Sentence text;
  const Instant now = link_->now();
  if (!link_->isOpen()) {
    text.format("%s", link_->lastError().empty() ? "the bus device is not open yet" : link_->lastError().c_str());
  } else if (scan_) {
    text = "every address is asked (scan) before data are exchanged";
  } else if (last_foreign_ && now - *last_foreign_ < kToldFor) {
    text.format("another master is on this segment%s: this driver must be the only one",
                master_->isListening() ? ", and nothing is sent for as long as it is heard" : "");
  } else if (master_->isListening()) {
    text = "listens for other masters before it sends anything (listen_first)";
  } else if (last_busy_ && now - *last_busy_ < kToldFor) {
    text =
        "the line never falls silent, so that nothing can be sent: check polarity, termination and biasing, or another "
        "station babbles";
  } else if (!connected()) {
    text = silenceText();
  } else if (std::all_of(drives_.begin(), drives_.end(), [](const DriveState& d) { return d.inverter_answers; })) {
    text.format("%s", link_->warning());  // a silent drive is worse, and told by its note
  } else {
    text = live_list_;
  }
  return text;
}

DriveIdentity ProfibusDpTransport::identity(DriveIndex drive) const {
  const ProfibusDrive& config = config_.drives[drive];
  const bool modular = config_.stations[config.slave].module == ProfibusModule::kSkCu4;
  DriveIdentity identity;
  identity.address = addressText(config_, drive);
  if (modular) {
    identity.shared_module = config.slave;
    identity.timeout_owner = TimeoutOwner::kModule;
  }
  identity.inverter = config.inverter;
  identity.process_values = config.ppo.process_values;
  identity.module_io = config_.stations[config.slave].io_byte;
  identity.parameter_channel = config.ppo.has_pkw                  ? "PKW"
                               : config_.slaves[config.slave].dpv1 ? "DP-V1 records"
                                                                   : "none";
  identity.worst_cycle = toSeconds(config_.worst_cycle);
  if (parameters_only_) {  // endWithoutATrip() has switched it off
    identity.protection_time = toSeconds(config_.bus.listen_first);
  } else {
    identity.protection_time = toSeconds(config_.watchdog);
    identity.protected_by = "PROFIBUS watchdog of " + shortNumber(toSeconds(config_.watchdog)) +
                            " s: the inverter trips E10.2 and the motor coasts";
  }
  return identity;
}

void ProfibusDpTransport::close() noexcept {
  if (link_) link_->close();
}

ScanReport ProfibusDpTransport::scan(const Settings& bus, const std::atomic<bool>& end_asked) {
  return scanProfibus(bus, make_link_, end_asked);
}

std::string ProfibusDpTransport::quiet(const Settings& bus) const {
  return profibusScanIsQuiet(bus);
}

}  // namespace nord_driver
