#include "link/modbus/diagnosis_connection.h"

#include <poll.h>

#include <optional>
#include <utility>

#include "link/modbus/trouble_counters.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

ModbusSettings withItsServer(ModbusSettings settings) {
  settings.server = settings.diagnosis;
  return settings;
}

/// Until one of them is signalled, or `until`.
void waitFor(const Wakeup& one, const Wakeup& other, std::optional<Instant> until) noexcept {
  pollfd waits[] = {{one.descriptor(), POLLIN, 0}, {other.descriptor(), POLLIN, 0}};
  timespec left{};
  if (until) left = toTimeout(*until - std::chrono::steady_clock::now());
  ::ppoll(waits, 2, until ? &left : nullptr, nullptr);
}

}  // namespace

DiagnosisConnection::DiagnosisConnection(const ModbusSettings& settings, LookUp look_up)
    : settings_(withItsServer(settings)),
      connection_(settings_, std::move(look_up)),
      acyclic_(settings_, connection_),
      backoff_(settings_.first_pause, settings_.longest_pause) {}

DiagnosisConnection::~DiagnosisConnection() {
  close();
}

void DiagnosisConnection::open() {
  if (thread_.joinable()) return;
  stop_.take();
  ending_ = false;
  thread_ = std::thread([this] { work(); });
}

void DiagnosisConnection::close() noexcept {
  if (!thread_.joinable()) return;
  ending_ = true;
  stop_.signal();
  thread_.join();
}

std::uint64_t DiagnosisConnection::order(const RegisterOrder& order) noexcept {
  const std::uint64_t number = desk_.place(order);
  asked_.signal();
  return number;
}

std::uint64_t DiagnosisConnection::askWatchdog() noexcept {
  const std::uint64_t number = ++watchdog_asked_;
  asked_.signal();
  return number;
}

void DiagnosisConnection::waitTold(Instant until, const Wakeup& stop) noexcept {
  waitFor(told_, stop, until);
  told_.take();
}

void DiagnosisConnection::work() noexcept {
  while (!ending()) {
    const bool good = (connection_.isOpen() || connect()) && serve();
    if (!good && pausedAfterFailure()) continue;
    // The images wait for its answer, so that no exchange of theirs asks anew.
    if (!good && state_.watchdog_read != watchdog_asked_) continue;
    waitFor(asked_, stop_, std::nullopt);
    asked_.take();
  }
  connection_.close();
  state_ = {};
  report_.text.clear();
  tell(LinkState::kClosed);
}

bool DiagnosisConnection::connect() noexcept {
  tell(LinkState::kConnecting);
  if (!connection_.open(stop_)) {
    report_.text = connection_.reason();
    return false;
  }
  ++report_.counters.connections;
  return true;
}

bool DiagnosisConnection::serve() noexcept {
  report_.text.clear();
  bool good = acyclic_.readRunning(state_.running, stop_);
  if (!good) report_.text = acyclic_.reason();
  const std::uint64_t asked = watchdog_asked_;
  if (good && state_.watchdog_read != asked) {
    state_.watchdog_held = acyclic_.checkWatchdog(stop_);
    // What the register holds is an answer; that it could not be read is none.
    good = connection_.trouble() == ModbusTrouble::kNone;
    if (good) state_.watchdog_read = asked;
    if (!state_.watchdog_held) state_.watchdog_text = acyclic_.reason();
    if (!good) report_.text = acyclic_.reason();
  }
  if (good) {
    good = desk_.serve(acyclic_, connection_, stop_, report_.counters);
    if (!good) report_.text = acyclic_.reason();
  }
  report_.counters.requests = acyclic_.requests();
  if (!good) return false;
  backoff_.succeeded();
  tell(LinkState::kConnected);
  return true;
}

// A server that refuses in due form stays connected, and is asked anew with the next exchange after one refusal, as on the
// first connection: the inputs are as old as its last answer.
bool DiagnosisConnection::pausedAfterFailure() noexcept {
  if (ending()) return true;
  const ModbusTrouble trouble = connection_.trouble();
  countTrouble(trouble, report_.counters);
  if (trouble != ModbusTrouble::kException) connection_.abandon();
  desk_.refuse(report_.text);
  const bool at_once = trouble == ModbusTrouble::kException && backoff_.fresh();
  const Instant until = backoff_.failed(std::chrono::steady_clock::now());
  tell(at_once ? LinkState::kConnected : LinkState::kPausing);
  if (!at_once) waitFor(stop_, stop_, until);
  return !at_once;
}

void DiagnosisConnection::tell(LinkState link) noexcept {
  report_.state = link;
  state_.text = report_.text;
  states_.write(state_);
  reports_.write(report_);
  told_.signal();
}

}  // namespace nord_driver::link
