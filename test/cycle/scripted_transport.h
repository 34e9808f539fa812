// A transport for tests: minimal inverters instead of a bus, a clock that moves when told, parameters from a table.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drive/fake_inverter.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

class ScriptedTransport final : public Transport {
 public:
  struct Submitted {
    DriveIndex drive = 0;
    profile::ParameterRequest request;
  };

  explicit ScriptedTransport(std::size_t drives)
      : inverters(drives), module_only(drives, false), missing(drives, false), interrupted(drives, false) {}

  void configure(const Settings&, const std::vector<DriveSettings>&, double) override {}
  Instant now() const noexcept override { return time; }
  void setDriveTimeout(Duration timeout) noexcept override { told_drive_timeout = timeout; }
  void setShutdownTimeout(Duration timeout) noexcept override { told_shutdown_timeout = timeout; }
  void sleepUntil(Instant when) noexcept override {
    if (when > time) time = when;
  }
  void exchange(const std::vector<profile::ProcessOutput>& sent, std::vector<DriveExchange>& inputs) noexcept override {
    time += exchange_time;
    outputs = sent;
    for (DriveIndex i = 0; i < inverters.size(); ++i) {
      inputs[i] = {};
      inputs[i].interruption = interrupted[i] ? Interruption::kUnasked : Interruption::kNone;
      interrupted[i] = false;
      const profile::ProcessInput input = inverters[i].exchange(sent[i]);
      if (inverters[i].silent) continue;
      inputs[i].module_answers = true;
      inputs[i].module_inputs = module_inputs;
      inputs[i].inverter_missing = missing[i];
      inputs[i].inverter_answers = !module_only[i] && !missing[i];
      inputs[i].input = input;  // of a module alone it is an old one
    }
  }
  /// Waits in `submitted` while `hold_answers`; otherwise answered in the same cycle, from `parameters` by number (and
  /// set: number + 1000 * set), with "refused" for the rest.
  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override {
    if (queue_full) return false;
    submitted.push_back({drive, request});
    if (!hold_answers) answerFirst();
    return true;
  }
  std::optional<profile::ParameterResult> pollResult() noexcept override {
    if (results.empty()) return std::nullopt;
    const profile::ParameterResult result = results.front();
    results.pop_front();
    return result;
  }
  /// Those that wait, and from now on each at once.
  void answerAll() {
    hold_answers = false;
    while (!submitted.empty()) answerFirst();
  }
  void answerFirst() {
    const DriveIndex drive = submitted.front().drive;
    const profile::ParameterRequest request = submitted.front().request;
    submitted.pop_front();
    profile::ParameterResult result;
    result.id = request.id;
    result.outcome = profile::ParameterOutcome::kRefused;
    result.reason = profile::ParameterReason::kNoSuchParameter;
    result.text = "scripted error 0, the transport's own words";
    auto at = parameters.find(request.number + 1000 * request.parameter_set);
    if (at == parameters.end()) at = parameters.find(request.number);
    const auto own = of_drive[drive].find(request.number);
    auto& refusals = not_now[{drive, request.number + 1000 * request.parameter_set}];
    if (refusals > 0) {
      --refusals;
      result.reason = profile::ParameterReason::kNotNow;
    } else if (own != of_drive[drive].end()) {
      result = done(request.id, own->second);
    } else if (at != parameters.end()) {
      result = done(request.id, at->second);
    }
    results.push_back(result);
  }
  static profile::ParameterResult done(std::uint32_t id, std::int32_t raw) {
    profile::ParameterResult result;
    result.id = id;
    result.outcome = profile::ParameterOutcome::kDone;
    result.raw = raw;
    return result;
  }

  bool connected() const noexcept override { return is_connected; }
  BusCounters counters() const noexcept override { return bus_counters; }
  DriveNote note(DriveIndex) const noexcept override { return {"the note of the bus"}; }
  std::uint32_t identNumber(DriveIndex) const noexcept override { return 0x7531; }
  Sentence busText() const noexcept override { return bus_text; }
  profile::ParameterCapabilities parameterCapabilities(DriveIndex) const noexcept override { return capabilities; }
  std::optional<BusEvent> pollEvent() noexcept override {
    if (events.empty()) return std::nullopt;
    const BusEvent event = events.front();
    events.pop_front();
    return event;
  }
  DriveIdentity identity(DriveIndex drive) const override {
    if (drive >= inverters.size()) throw std::out_of_range("there is no such drive");
    DriveIdentity identity{"nowhere", process_values, "PKW", "nothing"};
    identity.timeout_owner = timeout_owner;
    identity.sources_by_telegram = sources_by_telegram;
    identity.shared_module = shared_module;
    identity.worst_cycle = worst_cycle;
    identity.parameter_sets = parameter_sets;
    identity.has_quick_stop = has_quick_stop;
    identity.reverses = forward_only.count(drive) == 0;
    return identity;
  }
  void close() noexcept override {}

  std::uint8_t process_values = 3;
  std::optional<std::size_t> shared_module;  ///< of all drives
  double worst_cycle = 0.0;                  ///< s
  std::uint8_t parameter_sets = 4;           ///< that its control word can command
  bool has_quick_stop = true;
  std::set<DriveIndex> forward_only;  ///< these have no reverse
  TimeoutOwner timeout_owner = TimeoutOwner::kInverter;
  bool sources_by_telegram = false;
  profile::ParameterCapabilities capabilities;
  std::uint8_t module_inputs = 0;  ///< of each module
  std::deque<BusEvent> events;
  std::optional<Duration> told_drive_timeout;
  std::optional<Duration> told_shutdown_timeout;
  Instant time{std::chrono::hours{1}};
  Duration exchange_time = std::chrono::milliseconds{2};
  std::vector<drive::FakeInverter> inverters;
  std::vector<bool> module_only;  ///< the bus module answers, its inverter is off
  std::vector<bool> missing;      ///< the same, and the module says so
  std::vector<bool> interrupted;  ///< in the next cycle
  std::vector<profile::ProcessOutput> outputs;
  std::map<int, std::int32_t> parameters{{105, 500}};
  std::map<DriveIndex, std::map<int, std::int32_t>> of_drive;  ///< by number, of one drive alone: before `parameters`
  std::map<std::pair<DriveIndex, int>, int> not_now;  ///< by drive and number + 1000 * set: how often it is refused so
  bool hold_answers = false;
  bool queue_full = false;
  std::deque<Submitted> submitted;
  std::deque<profile::ParameterResult> results;
  bool is_connected = true;
  BusCounters bus_counters;
  Sentence bus_text;
};

}  // namespace nord_driver::cycle
