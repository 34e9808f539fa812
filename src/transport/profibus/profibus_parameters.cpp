#include "transport/profibus/profibus_parameters.h"

namespace nord_driver {

namespace {

constexpr std::uint16_t kFirstModuleNumber = 150, kLastModuleNumber = 199;  // BU 2700 7.1, BU 0220 5.2
constexpr std::uint16_t kModuleStatus = 173;
constexpr std::uint16_t kBusOut = 741;  // [-01]: status word (BU 0220 5.1)
constexpr std::uint32_t kOwnId = 0;     // no asker outside has it
// An answer that takes several telegrams, and still before a service gives up.
constexpr Duration kRecordAnswerTimeout = std::chrono::milliseconds{2500};

bool isOfModule(std::uint16_t number) noexcept {
  return number >= kFirstModuleNumber && number <= kLastModuleNumber;
}

bool tellsAbsence(const profile::ParameterResult& result) noexcept {
  return result.outcome == profile::ParameterOutcome::kRefused &&
         result.reason == profile::ParameterReason::kNoInverter;
}

}  // namespace

ProfibusParameters::ProfibusParameters(const ProfibusDpConfig& config, Duration answer_timeout)
    : config_(config), stations_(config.stations.size()) {
  for (const ProfibusDrive& drive : config.drives) {
    drives_.emplace_back(answer_timeout);
    if ((recordsOnly() || !drive.ppo.has_pkw) && config.slaves[drive.slave].dpv1) {
      drives_.back().records.emplace(drive.inverter, config.records, kRecordAnswerTimeout);
    }
  }
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!config.slaves[i].dpv1) continue;
    stations_[i].module.emplace(RecordParameterChannel::kModule, config.records, kRecordAnswerTimeout);
    stations_[i].users.push_back(&*stations_[i].module);
    for (const std::size_t drive : config.stations[i].drives) {
      if (drives_[drive].records) stations_[i].users.push_back(&*drives_[drive].records);
    }
  }
}

bool ProfibusParameters::submit(DriveIndex drive, const profile::ParameterRequest& request, Instant now) noexcept {
  StationChannels& station = stations_[config_.drives[drive].slave];
  if (station.module && isOfModule(request.number)) return station.module->submit(request, now);
  if (drives_[drive].records) return drives_[drive].records->submit(request, now);
  if (config_.drives[drive].ppo.has_pkw && !recordsOnly()) return drives_[drive].pkw.submit(request, now);
  profile::ParameterResult result;
  result.id = request.id;
  result.outcome = profile::ParameterOutcome::kNoChannel;
  // BU 0020 7.2.
  result.text = recordsOnly()
                    ? "its bus module takes no acyclic requests (DP-V1)"
                    : "PPO types 3 and 4 carry process data only, and its bus module takes no acyclic requests (DP-V1)";
  return refused_.push_back(result);
}

std::optional<profile::ParameterResult> ProfibusParameters::pollResult() noexcept {
  if (const auto refused = refused_.takeFront()) return refused;
  const std::size_t all = drives_.size() + stations_.size();
  for (std::size_t i = 0; i < all; ++i) {
    const auto result = cursor_ < drives_.size() ? pollDrive(cursor_) : pollModule(stations_[cursor_ - drives_.size()]);
    if (result) return result;
    cursor_ = (cursor_ + 1) % all;
  }
  return std::nullopt;
}

std::optional<profile::ParameterResult> ProfibusParameters::pollDrive(DriveIndex drive) noexcept {
  DriveChannel& channel = drives_[drive];
  auto result = channel.pkw.pollResult();
  while (!result && channel.records) {
    result = channel.records->pollResult();
    if (!result || result->id != kOwnId) break;
    takeStatusWord(channel, *result);
    result.reset();
  }
  if (result && tellsAbsence(*result)) absent_.push_back(drive);
  return result;
}

std::optional<profile::ParameterResult> ProfibusParameters::pollModule(StationChannels& station) noexcept {
  while (station.module) {
    const auto result = station.module->pollResult();
    if (!result || result->id != kOwnId) return result;
    station.status_asked = false;
    if (result->outcome == profile::ParameterOutcome::kDone) station.status = static_cast<Word>(result->raw & 0xFFFF);
  }
  return std::nullopt;
}

std::uint64_t ProfibusParameters::stale() const noexcept {
  std::uint64_t stale = 0;
  for (const DriveChannel& drive : drives_) stale += drive.pkw.stale() + (drive.records ? drive.records->stale() : 0);
  for (const StationChannels& station : stations_) stale += station.module ? station.module->stale() : 0;
  return stale;
}

void ProfibusParameters::handleInverterOffline(DriveIndex drive, const Sentence& why, Instant now) noexcept {
  drives_[drive].pkw.handleOffline(now, why);
  if (drives_[drive].records) drives_[drive].records->handleOffline(now, why);
}

void ProfibusParameters::handleStationOffline(std::size_t station, const Sentence& why, Instant now) noexcept {
  if (stations_[station].module) stations_[station].module->handleOffline(now, why);
  stations_[station].status.reset();
}

void ProfibusParameters::takeStatusWord(DriveChannel& channel, const profile::ParameterResult& result) noexcept {
  channel.status_asked = false;
  StatusAnswer answer;
  if (result.outcome == profile::ParameterOutcome::kDone) {
    answer.word = static_cast<Word>(result.raw & 0xFFFF);
  } else {
    answer.why = result.text;
  }
  channel.status = answer;
}

void ProfibusParameters::requestStatusWord(DriveIndex drive, Instant now) noexcept {
  DriveChannel& channel = drives_[drive];
  if (!channel.records || channel.status_asked) return;
  profile::ParameterRequest request;
  request.id = kOwnId;
  request.number = kBusOut;
  request.shape = profile::ParameterShape::kArray;
  request.index = 1;
  channel.status_asked = channel.records->submit(request, now);
}

std::optional<ProfibusParameters::StatusAnswer> ProfibusParameters::pollStatusWord(DriveIndex drive) noexcept {
  const auto status = drives_[drive].status;
  drives_[drive].status.reset();
  return status;
}

void ProfibusParameters::submitRecords(profibus::DpMaster& master, Instant now) noexcept {
  submitTo(master, now);
}

void ProfibusParameters::submitRecords(profibus::Class2Master& master, Instant now) noexcept {
  submitTo(master, now);
}

template <typename Master>
void ProfibusParameters::submitTo(Master& master, Instant now) noexcept {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    StationChannels& station = stations_[i];
    // One that only pauses between two orders has another turn behind the others, in the same cycle.
    const std::size_t turns = station.users.empty() ? 0 : station.users.size() + 1;
    for (std::size_t turn = 0; turn < turns; ++turn) {
      RecordParameterChannel& user = *station.users[station.user];
      if (const auto request = user.pollRecord(now)) {
        // Another one's record cannot be under way: its user would hold the station.
        if (!master.submitRecord(i, *request)) {
          profibus::RecordResult busy;
          busy.outcome = profibus::RecordOutcome::kTimedOut;
          user.handleRecord(busy, now);
        }
      }
      if (user.holdsStation()) break;
      station.user = (station.user + 1) % station.users.size();
    }
  }
}

void ProfibusParameters::takeRecords(profibus::DpMaster& master, Instant now) noexcept {
  while (const auto result = master.pollRecord()) {
    StationChannels& station = stations_[result->slave];
    const Sentence why = master.hasGivenWay() ? master.status(result->slave).note : "";
    if (!station.users.empty()) station.users[station.user]->handleRecord(*result, now, why);
  }
}

void ProfibusParameters::takeRecords(profibus::Class2Master& master, Instant now) noexcept {
  while (const auto result = master.pollRecord()) {
    StationChannels& station = stations_[result->slave];
    if (!station.users.empty()) station.users[station.user]->handleRecord(*result, now, master.trouble(result->slave));
  }
}

void ProfibusParameters::requestModuleStatus(std::size_t station, Instant now) noexcept {
  StationChannels& channels = stations_[station];
  if (!channels.module || channels.status_asked) return;
  profile::ParameterRequest request;
  request.id = kOwnId;
  request.number = kModuleStatus;
  channels.status_asked = channels.module->submit(request, now);
}

std::optional<Word> ProfibusParameters::pollModuleStatus(std::size_t station) noexcept {
  const auto status = stations_[station].status;
  stations_[station].status.reset();
  return status;
}

std::optional<DriveIndex> ProfibusParameters::pollAbsence() noexcept {
  return absent_.takeFront();
}

}  // namespace nord_driver
