#include "transport/profibus/profibus_ms2.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/setting_checks.h"
#include "profile/status_word.h"
#include "transport/profibus/profibus_counters.h"
#include "transport/profibus/profibus_line.h"
#include "transport/profibus/profibus_scanner.h"
#include "transport/profibus/profibus_telegram_text.h"
#include "transport/profibus/profibus_text.h"
#include "transport/reopen_interval.h"

namespace nord_driver {

namespace {

constexpr Duration kStatusInterval = std::chrono::milliseconds{500};
constexpr Duration kAnswerTimeout = std::chrono::seconds{1};
constexpr Duration kTimeToEnd = std::chrono::milliseconds{200};  // for an Abort to each station
constexpr const char* kOnlyParameters =
    "~transport: nord_driver/profibus_ms2 reads and writes parameters only (nord_param), expected "
    "nord_driver/profibus_dp for a driver";

}  // namespace

ProfibusMs2Transport::ProfibusMs2Transport() : ProfibusMs2Transport(openSerialPort) {}

ProfibusMs2Transport::ProfibusMs2Transport(LinkFactory make_link) : make_link_(std::move(make_link)) {}

bool ProfibusMs2Transport::serveParametersOnly() noexcept {
  parameters_only_ = true;
  return true;
}

void ProfibusMs2Transport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  // A driver would wait for ever, or worse, believe that it moves something.
  if (!parameters_only_) throw ConfigError(kOnlyParameters);
  config_ = readProfibusDpConfig(bus, drives, cycle_rate, ProfibusUse::kRecordsOnly);
  period_ = seconds(1.0 / cycle_rate);
  std::vector<profibus::StationAddress> stations;
  for (const profibus::SlaveConfig& slave : config_.slaves) stations.push_back(slave.address);
  profibus::Class2Times times;
  times.response_timeout = kAnswerTimeout;
  for (const profibus::SlaveConfig& slave : config_.slaves) {
    if (slave.dpv1) times.response_timeout = std::max(times.response_timeout, slave.record_timeout);
  }
  try {
    master_.emplace(config_.bus, stations, times);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(bus.fullName("") + ": " + error.what());
  }
  trace_.emplace(kLinkTypeProfibusDl, ProfibusTelegramText{config_});
  recorder_.emplace(*trace_);
  parameters_.emplace(config_, kAnswerTimeout);
  drives_.assign(config_.drives.size(), DriveState{});
  link_ = make_link_(config_.line);
}

Instant ProfibusMs2Transport::now() const noexcept {
  return link_->now();
}

void ProfibusMs2Transport::sleepUntil(Instant when) noexcept {
  link_->sleepUntil(when);
}

bool ProfibusMs2Transport::linkReady() noexcept {
  if (link_->isOpen()) return true;
  const Instant now = link_->now();
  if (now < next_open_) return false;
  next_open_ = now + kReopenInterval;
  if (!link_->open()) return false;
  master_->restart(now);
  return true;
}

void ProfibusMs2Transport::exchange(const std::vector<profile::ProcessOutput>& /*outputs*/,
                                    std::vector<DriveExchange>& inputs) noexcept {
  if (linkReady()) {
    for (DriveIndex drive = 0; drive < drives_.size(); ++drive) askStatus(drive);
    talk(link_->now() + period_);
  }
  for (DriveIndex drive = 0; drive < drives_.size(); ++drive) {
    takeStatus(drive, inputs[drive]);
    explain(drive);
  }
}

// Record after record for as long as a cycle is: nothing else waits for the bus.
void ProfibusMs2Transport::talk(Instant until) noexcept {
  bool busy = true;
  while (busy && link_->isOpen() && link_->now() < until) {
    parameters_->submitRecords(*master_, link_->now());
    busy = master_->wantsBus(link_->now());
    if (busy) {
      talkOnLine(*master_, *link_, *recorder_, until,
                 [&] { return link_->now() >= until || !master_->wantsBus(link_->now()); });
    }
    if (!link_->isOpen()) handleClosedLink();
    parameters_->takeRecords(*master_, link_->now());
  }
}

void ProfibusMs2Transport::handleClosedLink() noexcept {
  master_->restart(link_->now());
  recorder_->flush();
  next_open_ = link_->now() + kReopenInterval;
}

void ProfibusMs2Transport::askStatus(DriveIndex drive) noexcept {
  DriveState& state = drives_[drive];
  const Instant now = link_->now();
  if (now < state.next_status) return;
  state.next_status = now + kStatusInterval;
  parameters_->requestStatusWord(drive, now);
}

void ProfibusMs2Transport::takeStatus(DriveIndex drive, DriveExchange& input) noexcept {
  DriveState& state = drives_[drive];
  if (const auto told = parameters_->pollStatusWord(drive)) {
    state.status = told->word;
    state.why = told->why;
  }
  input = {};
  if (!link_->isOpen()) {
    state.status = 0;  // whatever is there when it is open again
    return;
  }
  input.module_answers = master_->isConnected(config_.drives[drive].slave);
  input.inverter_answers = profile::StatusWord{state.status}.isUseful();
  input.inverter_missing = input.module_answers && !input.inverter_answers;
  input.input.status_word = state.status;
}

void ProfibusMs2Transport::explain(DriveIndex drive) noexcept {
  DriveState& state = drives_[drive];
  const std::size_t station = config_.drives[drive].slave;
  const Sentence& trouble = master_->trouble(station);
  if (!link_->isOpen()) {
    state.note = "the bus device is not open";
  } else if (!config_.slaves[station].dpv1) {
    state.note = "its bus module takes no acyclic requests (DP-V1): SK CU4/TU4-PBR do";
  } else if (profile::StatusWord{state.status}.isUseful()) {
    state.note.clear();
  } else if (!trouble.empty()) {
    state.note = trouble;
  } else if (!state.why.empty()) {
    state.note.format("its status word (P741) cannot be read, so that it is not known whether it runs: %s",
                      state.why.c_str());
  } else {
    state.note = "its status word (P741) has not been read yet";
  }
}

bool ProfibusMs2Transport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  return parameters_->submit(drive, request, link_->now());
}

std::optional<profile::ParameterResult> ProfibusMs2Transport::pollResult() noexcept {
  auto result = parameters_->pollResult();
  while (parameters_->pollAbsence()) {  // the status word tells it, too
  }
  return result;
}

bool ProfibusMs2Transport::connected() const noexcept {
  for (std::size_t station = 0; link_->isOpen() && station < config_.stations.size(); ++station) {
    if (master_->isConnected(station)) return true;
  }
  return false;
}

BusCounters ProfibusMs2Transport::counters() const noexcept {
  return profibusCounters(master_->counters(), link_->lineCounters(), parameters_->stale());
}

DriveNote ProfibusMs2Transport::note(DriveIndex drive) const noexcept {
  return {drives_[drive].note.c_str()};
}

Sentence ProfibusMs2Transport::busText() const noexcept {
  if (!link_->isOpen()) {
    Sentence text;
    text.format("%s", link_->lastError().empty() ? "the bus device is not open yet" : link_->lastError().c_str());
    return text;
  }
  if (master_->refusedBy()) return master_->refusal();
  if (master_->isListening()) return "listens for other masters before it sends anything (listen_first)";
  return {};
}

DriveIdentity ProfibusMs2Transport::identity(DriveIndex drive) const {
  const ProfibusDrive& config = config_.drives[drive];
  const bool modular = config_.stations[config.slave].module == ProfibusModule::kSkCu4;
  DriveIdentity identity;
  identity.address = addressText(config_, drive);
  identity.inverter = config.inverter;
  identity.process_values = 0;
  identity.protection_time = toSeconds(config_.bus.listen_first);
  if (modular) {
    identity.shared_module = config.slave;
    identity.timeout_owner = TimeoutOwner::kModule;
  }
  identity.parameter_channel = config_.slaves[config.slave].dpv1 ? "DP-V1 records, MS2" : "none";
  return identity;
}

std::vector<std::string> ProfibusMs2Transport::warnings() const {
  return config_.warnings;
}

// The modules need not wait for their time-out.
void ProfibusMs2Transport::close() noexcept {
  if (!link_) return;
  if (link_->isOpen() && master_) {
    master_->close();
    const Instant end = link_->now() + kTimeToEnd;
    talkOnLine(*master_, *link_, *recorder_, end,
               [&] { return link_->now() >= end || !master_->wantsBus(link_->now()); });
  }
  link_->close();
}

ScanReport ProfibusMs2Transport::scan(const Settings& bus, const std::atomic<bool>& end_asked) {
  return scanProfibus(bus, make_link_, end_asked);
}

std::string ProfibusMs2Transport::quiet(const Settings& bus) const {
  return profibusScanIsQuiet(bus);
}

}  // namespace nord_driver
