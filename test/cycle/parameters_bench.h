// The parameters of one drive without a bus cycle around them: a minimal inverter, and answers when the test gives them.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "cycle/drive_parameters.h"
#include "drive/fake_inverter.h"

namespace nord_driver::cycle {

class ParametersBench {
 public:
  using Request = profile::ParameterRequest;
  using Result = profile::ParameterResult;
  static constexpr DriveIndex kDrive = 3;
  static constexpr Duration kCycle = std::chrono::milliseconds{10};

  explicit ParametersBench(const ParameterChannelUse& channel = {}, const drive::DriveConfig& config = {},
                           profile::Series series = profile::Series::kSk5xxe)
      : drive{config}, parameters{kDrive, "lift", series, std::nullopt, channel} {}

  /// The process data of one cycle; nothing is asked.
  void exchange() {
    now += kCycle;
    profile::ProcessInput input = inverter.exchange(drive.pollOutput(now));
    if (says) input.status_word = *says;
    drive.handleInput(input, !inverter.silent, now);
    parameters.handleState(drive, now);
  }
  /// All that may be asked now goes into `open` and `asked`.
  void poll() {
    while (const auto request = parameters.pollRequest(now)) {
      open.push_back(*request);
      asked.push_back(*request);
    }
  }
  /// What is open, other than what is `held`.
  void answer() {
    const std::vector<Request> all = std::move(open);
    open.clear();
    for (const Request& request : all) {
      if (held.count(request.number) != 0) {
        open.push_back(request);
      } else {
        parameters.handleResult(resultOf(request));
      }
    }
  }
  /// One cycle.
  void step() {
    exchange();
    poll();
    answer();
    poll();
    parameters.endOverdue(now);
    while (const auto completion = parameters.pollCompletion()) completions.push_back(*completion);
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) step();
  }
  /// `values` by number, or number + 1000 * set; without one it is refused.
  Result resultOf(const Request& request) {
    Result result;
    result.id = request.id;
    if (silent.count(request.number) != 0) return result;  // a time-out
    if (not_now.count(request.number) != 0) {
      result.outcome = profile::ParameterOutcome::kRefused;
      result.reason = profile::ParameterReason::kNotNow;
      return result;
    }
    const auto own = values.find(request.number + 1000 * request.parameter_set);
    const auto value = own != values.end() ? own : values.find(request.number);
    if (value == values.end()) {
      result.outcome = profile::ParameterOutcome::kRefused;
      result.reason = profile::ParameterReason::kNoSuchParameter;
      return result;
    }
    result.outcome = profile::ParameterOutcome::kDone;
    if (request.action != profile::ParameterAction::kRead) value->second = request.raw;
    result.raw = value->second;
    return result;
  }
  /// How often P`number` was read since `asked` was emptied.
  auto reads(int number) const {
    return std::count_if(asked.begin(), asked.end(), [number](const Request& request) {
      return request.number == number && request.action == profile::ParameterAction::kRead;
    });
  }
  void submit(cycle::Request request, Duration patience = std::chrono::seconds{3}) {
    request.id = ++last_id;
    request.patience = patience;
    parameters.handleRequest(request, drive, now);
  }

  drive::Drive drive;
  DriveParameters parameters;
  drive::FakeInverter inverter;
  std::optional<Word> says;  ///< the status word instead of the inverter's
  std::map<int, std::int32_t> values{{102, 100}, {105, 500}, {301, 0}, {513, 5}, {560, 1}};
  std::set<int> held;     ///< these stay without an answer
  std::set<int> silent;   ///< these time out
  std::set<int> not_now;  ///< these are refused for the moment
  std::vector<Request> open, asked;
  std::vector<Completion> completions;
  std::uint32_t last_id = 0;
  Instant now{std::chrono::hours{1}};
};

}  // namespace nord_driver::cycle
