#include "cycle/drive_parameters.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "cycle/leaders.h"
#include "cycle/user_messages.h"
#include "drive/parameter_notes.h"
#include "profile/cycle_parameters.h"

namespace nord_driver::cycle {

namespace {

// An id tells the drive, the asker and which question of the asker it is: sequence | asker + 1 | drive. None is 0.
constexpr unsigned kDriveBits = 8, kAskerBits = 4;
constexpr std::uint32_t kDriveMask = (1u << kDriveBits) - 1, kAskerMask = (1u << kAskerBits) - 1;

constexpr Duration kMissingInterval = std::chrono::seconds{2};

// Beside those that are read at start: jog frequency and the fixed frequencies of SK 2xxE (P465), brake, servo mode and
// encoder (the P300 family's, not its controller gains), PPO type, drive profile; and the functions of inputs and outputs:
// what stands at a terminal acts at once, and an output may be a brake's; those of a bus module are told by
// isOfAllBehindModule().
constexpr std::uint16_t kDecideMotion[] = {113, 114, 300, 301, 325, 400, 405, 420, 421, 422, 423, 424,
                                           425, 434, 441, 443, 450, 455, 465, 470, 507, 541, 551};

// What the drive is reached by, and when it trips because it is not: a time-out shorter than the bus cycle, or another
// address, and this motor alone coasts (BU 2700 7.1.1). Monitoring of options, what a leader sends to its followers
// (P502, P503, P552), addresses and baud rates (P508, P511, P512, P514, P515), the telegram time-out. No manual at hand
// describes P523 (factory setting) and P550 (copy of a whole data set).
constexpr std::uint16_t kDecideReach[] = {120, 502, 503, 508, 511, 512, 513, 514, 515, 523, 550, 552};

template <std::size_t kSize>
bool isAmong(const std::uint16_t (&numbers)[kSize], std::uint16_t number) noexcept {
  return std::find(std::begin(numbers), std::end(numbers), number) != std::end(numbers);
}

// Whether and how it positions (P600 to P631), other than the positions themselves (P613).
constexpr bool decidesPosition(std::uint16_t number) noexcept {
  return number >= 600 && number <= 631 && number != 613;
}

bool saysWhatSetpointsMean(std::uint16_t number) noexcept {
  return number == 105 || (number >= 543 && number <= 548);
}

// P600 is 0 where the drive does not position. What else it can be stands in BU 0510, not at hand. One that could not be
// read refuses a drive that is to position, and no other: not every inverter has it.
std::optional<drive::UnexpectedFunction> unexpectedPositionMode(const DeviceData& device, std::uint8_t set,
                                                                const WordNeeds& needs) noexcept {
  const auto raw = [](const std::optional<std::int32_t>& read) {
    return read ? static_cast<std::uint16_t>(*read) : kUnknownFunction;
  };
  drive::UnexpectedFunction wrong;
  // No manual at hand says whether it has sets: where the others could not be read, it has one.
  const auto& own = device.position_control[set - 1u];
  const auto& control = own ? own : device.position_control[0];
  const bool positions = control.value_or(0) != 0;
  if (positions != needs.positions) {
    wrong.number = 600;
    wrong.found = raw(control);
    wrong.surplus = positions;
    return wrong;
  }
  if (!positions || needs.setpoint_mode < 0 || device.setpoint_mode == needs.setpoint_mode) return std::nullopt;
  wrong.number = 610;
  wrong.found = raw(device.setpoint_mode);
  wrong.expected = static_cast<std::uint16_t>(needs.setpoint_mode);
  return wrong;
}

std::optional<drive::UnexpectedFunction> unexpectedFunction(const DeviceData& device, std::uint8_t set,
                                                            profile::Series series, const WordNeeds& needs) noexcept {
  const auto compare = [&](std::uint16_t number, std::uint16_t found) {
    std::optional<drive::UnexpectedFunction> unexpected;
    if (found == kUnknownFunction || firstWordFits(needs, number == 543, found, series)) return unexpected;
    const profile::CycleParameter* info = profile::findCycleParameter(number, series);
    const bool is_array = info != nullptr && info->shape == profile::ParameterShape::kArrayPerSet;
    unexpected = {number, is_array, found, kFrequencyFunction, 1, nullptr};
    return unexpected;
  };
  const WordFunctions& words = device.word_functions[set - 1u];
  const auto actual_value = compare(543, words.actual_values[0]);
  if (actual_value) return actual_value;
  const auto setpoint = compare(546, words.setpoints[0]);
  if (setpoint) return setpoint;
  const auto missing = missingWord(needs, words, series);
  return missing ? missing : unexpectedPositionMode(device, set, needs);
}

bool allKnown(const std::array<std::uint16_t, 3>& functions, std::size_t carried) noexcept {
  for (std::size_t i = 0; i < functions.size() && i < carried; ++i) {
    if (functions[i] == kUnknownFunction) return false;
  }
  return true;
}

// A low word whose high one is not known yet would be taken for 16 bits, 65.536 revolutions away.
profile::PositionWords positionWordsOf(const WordFunctions& functions, profile::Series series,
                                       const ParameterChannelUse& channel) noexcept {
  const std::size_t carried = channel.needs.words;
  if (!allKnown(functions.setpoints, carried) || !allKnown(functions.actual_values, carried)) return {};
  return profile::positionWords(series, functions.setpoints, functions.actual_values, carried, channel.field_order);
}

}  // namespace

bool changesProcessData(const Request& request) noexcept {
  const std::uint16_t number = request.parameter.number;
  return request.kind == RequestKind::kWriteParameter &&
         (saysWhatSetpointsMean(number) || number == 104 || number == 480 || number == 481 || number == 509 ||
          number == 510 || decidesPosition(number));
}

bool decidesMotion(const Request& request) noexcept {
  if (changesProcessData(request)) return true;
  const std::uint16_t number = request.parameter.number;
  return request.kind == RequestKind::kWriteParameter &&
         (isOfAllBehindModule(number) || isAmong(kDecideMotion, number) || isAmong(kDecideReach, number));
}

DriveParameters::DriveParameters(DriveIndex drive, std::string name, profile::Series series,
                                 std::optional<double> typed_max_frequency, const ParameterChannelUse& channel)
    : drive_(drive),
      name_(std::move(name)),
      series_(series),
      typed_max_frequency_(typed_max_frequency),
      channel_(channel),
      reader_(series, channel.timeout_owner, !channel.needs.empty(), channel.needs.positions, channel.needs.out_bit),
      session_(channel.capabilities),
      monitor_(channel.monitor) {}

// P105 as read; as typed where the drive does not tell it. What else could not be read refuses nothing: /diagnostics
// tells it.
void DriveParameters::scale(drive::Drive& drive) const noexcept {
  for (std::uint8_t set = 1; set <= 4; ++set) {
    const auto& read = reader_.data().max_frequency[set - 1u];
    if (read) {
      drive.setMaxFrequency(set, Hertz{*read});
    } else if (typed_max_frequency_ && reader_.maxFrequenciesAsked()) {
      drive.setMaxFrequency(set, Hertz{*typed_max_frequency_});
    }
    drive.setMinimumFrequency(set, Hertz{reader_.data().min_frequency[set - 1u].value_or(0.0)});
    drive.setUnexpectedFunction(set, unexpectedFunction(reader_.data(), set, series_, channel_.needs));
    if (!channel_.needs.positions || !reader_.motionAsked()) continue;
    const WordFunctions& functions = reader_.data().word_functions[set - 1u];
    drive.setPositionWords(set, positionWordsOf(functions, series_, channel_));
  }
  drive.setUnexpectedSource(unexpectedSource(reader_.data(), series_, channel_.follows, channel_.told_by_telegram));
}

Sentence DriveParameters::notWhileEnabled(const Request& request) const noexcept {
  const std::uint16_t number = request.parameter.number;
  Sentence why;
  if (saysWhatSetpointsMean(number)) {
    why.format("P%03u decides what setpoints and actual values mean: disable drive %s first", number, name_.c_str());
    return why;
  }
  const profile::CycleParameter* info = profile::findCycleParameter(number, series_);
  why.format("P%03u%s%s%s decides whether and how the motor turns: disable drive %s first", number,
             info != nullptr ? " (" : "", info != nullptr ? info->name : "", info != nullptr ? ")" : "", name_.c_str());
  return why;
}

bool DriveParameters::writesProcessData() const noexcept {
  for (const Pending& pending : pending_) {
    if (changesProcessData(pending.request)) return true;
  }
  return false;
}

bool DriveParameters::writesMotion() const noexcept {
  return std::any_of(pending_.begin(), pending_.end(),
                     [](const Pending& pending) { return decidesMotion(pending.request); });
}

bool DriveParameters::writesForModule() const noexcept {
  return std::any_of(pending_.begin(), pending_.end(), [](const Pending& pending) {
    return decidesMotion(pending.request) && isOfAllBehindModule(pending.request.parameter.number);
  });
}

void DriveParameters::readAgain(const Request& request) noexcept {
  if (request.kind != RequestKind::kWriteParameter) return;
  reader_.askAgain(request.parameter.number);
  module_written_ = module_written_ || request.parameter.number == DeviceReader::kModuleTimeout;
}

void DriveParameters::readModuleAgain() noexcept {
  reader_.askAgain(DeviceReader::kModuleTimeout);
}

void DriveParameters::readDeviceAgain() noexcept {
  // Its question under way may have been answered before the write.
  open_ids_[static_cast<std::size_t>(Asker::kReader)] = 0;
  reader_.handleOffline();
  scale_due_ = false;
}

void DriveParameters::handleRequest(const Request& request, drive::Drive& drive, Instant now) noexcept {
  const drive::DriveReport& report = drive.report();
  if (!report.online) return refuse(request, profile::ParameterOutcome::kOffline);
  profile::ParameterRequest access = request.parameter;
  access.id = request.id;
  if (request.kind == RequestKind::kReadParameter) access.action = profile::ParameterAction::kRead;
  if (access.parameter_set == 0) access.parameter_set = report.parameter_set;
  if (pending_.full() || !session_.submit(access)) return refuse(request, profile::ParameterOutcome::kBusy);
  Pending pending;
  pending.request = request;
  if (request.patience > Duration::zero()) pending.until = now + request.patience;
  pending_.push_back(pending);
  if (changesProcessData(request)) forgetScale(drive);
  if (decidesMotion(request)) drive.setParametersAwaited(awaitsMotion());
}

// The answer to an earlier question, which the reader does not wait for any more, comes first: asked for beside it, choices
// many times in a second would take the places of all other requests.
void DriveParameters::askElement(std::uint8_t element) noexcept {
  elements_.ask(element);
}

// Told that it failed, its asker must not see it succeed later: what has not begun to be written is not.
void DriveParameters::endOverdue(Instant now) noexcept {
  using Withdrawn = drive::ParameterSession::Withdrawn;
  for (Pending& pending : pending_) {
    if (!pending.until || now < *pending.until) continue;
    pending.until.reset();
    pending.answered = true;
    const bool write = pending.request.kind == RequestKind::kWriteParameter;
    const auto withdrawn = session_.withdraw(pending.request.id);
    profile::ParameterResult overdue;
    overdue.outcome = profile::ParameterOutcome::kTimeout;
    overdue.text = "in the time it was given";
    overdue.eeprom_written = withdrawn == Withdrawn::kMayBeSaved;
    if (write) overdue.note = withdrawn == Withdrawn::kNothing ? drive::kWithdrawn : drive::kWriteUnanswered;
    answer(pending.request, overdue);
  }
}

void DriveParameters::refuse(const Request& request, profile::ParameterOutcome outcome) noexcept {
  profile::ParameterResult result;
  result.outcome = outcome;
  answer(request, result);
}

std::optional<profile::ParameterRequest> DriveParameters::pollRequest(Instant now) noexcept {
  static_assert(kAskers <= kAskerMask, "an id has no room for so many askers: an answer would reach another one");
  for (std::size_t i = 0; i < kAskers; ++i) {
    if (open_ids_[i] != 0) continue;
    const auto asker = static_cast<Asker>(i);
    if (channel_.users_only && !laneOf(asker)) continue;
    auto request = ask(asker, now);
    if (!request) continue;
    sequence_ += 1u << (kDriveBits + kAskerBits);
    request->id = sequence_ | static_cast<std::uint32_t>(i + 1) << kDriveBits | static_cast<std::uint32_t>(drive_);
    open_ids_[i] = request->id;
    return request;
  }
  return std::nullopt;
}

std::optional<unsigned> DriveParameters::laneOf(Asker asker) noexcept {
  if (asker < Asker::kSession || asker >= Asker::kReader) return std::nullopt;
  return static_cast<unsigned>(asker) - static_cast<unsigned>(Asker::kSession);
}

std::optional<profile::ParameterRequest> DriveParameters::ask(Asker asker, Instant now) noexcept {
  if (const auto lane = laneOf(asker)) {
    const auto request = session_.pollRequest(*lane);
    switch_used_ = switch_used_ || session_.owesEepromSwitch();
    return request;
  }
  switch (asker) {
    case Asker::kFaults:
      return faults_.pollRequest(now);
    case Asker::kReader:
      askMissingAgain(now);
      return reader_.pollRequest();
    case Asker::kElement:
      return elements_.pollRequest();
    case Asker::kHistory:
      return nothingUnderWay() ? history_.pollRequest() : std::nullopt;
    case Asker::kMonitor:
      return nothingUnderWay() ? monitor_.pollRequest(parameter_set_, now) : std::nullopt;
    default:
      break;
  }
  return std::nullopt;
}

bool DriveParameters::nothingUnderWay() const noexcept {
  return std::all_of(open_ids_.begin(), open_ids_.end(), [](std::uint32_t id) { return id == 0; });
}

// A parameter channel that was busy elsewhere for a second must not keep the drive from ever being enabled. Where a
// P105 was typed it has taken the place of the missing one, and another scale could be a step of the speed.
void DriveParameters::askMissingAgain(Instant now) noexcept {
  const bool max_frequencies = !typed_max_frequency_;
  if (!reader_.missesMotion(max_frequencies)) {
    missing_since_.reset();
  } else if (!missing_since_) {
    missing_since_ = now;
  } else if (now - *missing_since_ >= kMissingInterval) {
    missing_since_.reset();
    reader_.askMissingAgain(max_frequencies);
  }
}

bool DriveParameters::handleResult(const profile::ParameterResult& result) noexcept {
  if ((result.id & kDriveMask) != drive_) return false;
  const std::size_t asker = (result.id >> kDriveBits & kAskerMask) - 1u;
  // An answer from before a loss must not pass for the answer to the question after it.
  if (asker >= kAskers || open_ids_[asker] != result.id) return true;
  open_ids_[asker] = 0;
  answer(static_cast<Asker>(asker), result);
  return true;
}

void DriveParameters::answer(Asker asker, const profile::ParameterResult& result) noexcept {
  if (const auto lane = laneOf(asker)) {
    session_.handleResult(result, *lane);
    return collect();
  }
  switch (asker) {
    case Asker::kFaults:
      return faults_.handleResult(result);
    case Asker::kReader:
      scale_due_ = true;  // not before: what was read before a loss is not what the drive has now
      return reader_.handleResult(result);
    case Asker::kElement:
      return elements_.handleResult(result, name_.c_str());
    case Asker::kHistory:
      return history_.handleResult(result);
    case Asker::kMonitor:
      return monitor_.handleResult(result, name_.c_str());
    default:
      return;
  }
}

// Parameters are written over a bus while P509 selects it (BU 0020 6.2.2, note); status bit 9 tells whether it does.
// Where the bus has a code for it, its words say so already.
void DriveParameters::answer(const Request& request, const profile::ParameterResult& result) noexcept {
  const bool by_control_source =
      request.kind == RequestKind::kWriteParameter && !bus_control_ && !channel_.capabilities.tells_missing_right;
  Completion completion =
      answerTo(request, result.outcome == profile::ParameterOutcome::kDone,
               parameterMessage(name_.c_str(), request.parameter.number, result, by_control_source));
  completion.parameter = result;
  completions_.add(completion);
}

void DriveParameters::collect() noexcept {
  while (const auto result = session_.pollResult()) {
    const auto finished = pending_.takeFront();  // the session answers in the order it was asked
    if (!finished) continue;
    if (!finished->answered) answer(finished->request, *result);
    // Whatever became of it: a write without an answer may have been carried out.
    if (changesProcessData(finished->request)) readDeviceAgain();
    readAgain(finished->request);
  }
  // A question of the reader may have met the 0 that it was for a moment.
  if (switch_used_ && !session_.owesEepromSwitch()) {
    switch_used_ = false;
    reader_.askAgain(DeviceReader::kEepromSwitch);
  }
}

}  // namespace nord_driver::cycle
