#include "link/modbus/modbus_link.h"

#include <poll.h>

#include <algorithm>
#include <exception>

#include "link/modbus/trouble_counters.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

// How long a word that stops may wait for the second connection.
constexpr std::chrono::milliseconds kStopLook{5};

}  // namespace

ModbusLink::ModbusLink(const ModbusSettings& settings, LookUp look_up)
    : settings_(settings),
      connection_(settings_, look_up),
      exchange_(settings_, connection_),
      acyclic_(settings_, connection_),
      backoff_(settings_.first_pause, settings_.longest_pause) {
  if (!checkModbusSettings(settings_, problem_)) return;
  problem_.clear();
  if (!settings_.diagnosis.empty()) diagnosis_.emplace(settings_, std::move(look_up));
}

ModbusLink::~ModbusLink() {
  close();
}

bool ModbusLink::open() noexcept {
  if (isOpen()) return true;
  report_.text = problem_;
  if (fresh_.descriptor() < 0 || answers_.descriptor() < 0 || stop_.descriptor() < 0)
    report_.text = "no descriptor left for a link to a gateway";
  if (report_.text.empty()) {
    stop_.take();
    fresh_.take();
    ending_ = false;
    backoff_.succeeded();
    try {
      if (diagnosis_) diagnosis_->open();
      thread_ = std::thread([this] { work(); });
      return true;
    } catch (const std::exception& error) {
      if (diagnosis_) diagnosis_->close();
      report_.text.format("no thread for the link to %s: %s", settings_.server.c_str(), error.what());
    }
  }
  reports_.write(report_);
  return false;
}

void ModbusLink::close() noexcept {
  if (!isOpen()) return;
  ending_ = true;
  stop_.signal();
  thread_.join();
  if (diagnosis_) diagnosis_->close();
}

std::uint64_t ModbusLink::give(const RegisterImage& outputs) noexcept {
  outputs_.write({++given_, outputs, false});
  fresh_.signal();
  return given_;
}

std::uint64_t ModbusLink::look() noexcept {
  outputs_.write({++given_, {}, true});
  fresh_.signal();
  return given_;
}

std::uint64_t ModbusLink::order(const RegisterOrder& order) noexcept {
  if (diagnosis_) return diagnosis_->order(order);
  const std::uint64_t number = desk_.place(order);
  fresh_.signal();
  return number;
}

const LinkReport& ModbusLink::report() noexcept {
  if (!diagnosis_) return reports_.read();
  whole_report_ = reports_.read();
  const LinkReport& second = diagnosis_->report();
  addConnection(second.counters, whole_report_.counters);
  if (whole_report_.text.empty() && !second.text.empty()) {
    whole_report_.text.format("diagnosis: %s", second.text.c_str());
  }
  return whole_report_;
}

bool ModbusLink::waitAnswers(Instant until) noexcept {
  pollfd wait{answers_.descriptor(), POLLIN, 0};
  const timespec left = toTimeout(until - now());
  ::ppoll(&wait, 1, &left, nullptr);
  return answers_.take();
}

void ModbusLink::sleepUntil(Instant when) noexcept {
  sleepUntilInstant(when);
}

void ModbusLink::work() noexcept {
  while (!ending()) {
    if (!started_ && !connect()) {
      failed();
    } else {
      waitForOutputs();
      if (ending() || !fresh_.take()) continue;
      // An order goes after the images of its cycle.
      if (exchangeOnce() && !desk_.serve(acyclic_, connection_, stop_, report_.counters)) {
        report_.text = acyclic_.reason();
        failed();
      }
    }
  }
  connection_.close();
  started_ = false;
  report_.text.clear();
  tell(LinkState::kClosed);
}

bool ModbusLink::connect() noexcept {
  tell(LinkState::kConnecting);
  if (!connection_.isOpen()) {
    if (!connection_.open(stop_)) {
      report_.text = connection_.reason();
      return false;
    }
    ++report_.counters.connections;
  }
  if (!writeStop() || !startWatchdog()) return false;
  // What was meant for the time before is not sent.
  fresh_.take();
  last_outputs_ = outputs_.read().number;
  started_ = true;
  tell(LinkState::kConnected);
  return true;
}

// A word that stops does not wait for the watchdog: one that is refused for ever would leave the drives running. False:
// the connection is of no use any more.
bool ModbusLink::writeStop() noexcept {
  const Outputs& outputs = outputs_.read();
  if (!stops(outputs)) return true;
  last_outputs_ = outputs.number;
  if (exchange_.run(outputs.words, unwatched_, stop_)) return true;
  report_.text = exchange_.reason();
  return exchange_.trouble() == ModbusTrouble::kException;
}

bool ModbusLink::startWatchdog() noexcept {
  if (!acyclic_.writeWatchdog(stop_) || (!diagnosis_ && !acyclic_.checkWatchdog(stop_))) {
    report_.text = acyclic_.reason();
    return false;
  }
  return !diagnosis_ || !settings_.watchdog || isWatchdogHeld();
}

// Over the second connection, which may have to be made first.
bool ModbusLink::isWatchdogHeld() noexcept {
  const std::uint64_t question = diagnosis_->askWatchdog();
  const Instant until = now() + settings_.connect_timeout + settings_.response_timeout;
  while (!ending() && now() < until) {
    const DiagnosisState& state = diagnosis_->state();
    if (state.watchdog_read == question) {
      if (!state.watchdog_held) report_.text = state.watchdog_text;
      return state.watchdog_held;
    }
    if (!writeStop()) return false;
    diagnosis_->waitTold(std::min(until, now() + kStopLook), stop_);
  }
  report_.text.format("the watchdog of the gateway was not read back: %.200s", diagnosis_->state().text.c_str());
  return false;
}

void ModbusLink::waitForOutputs() noexcept {
  pollfd waits[] = {{fresh_.descriptor(), POLLIN, 0}, {stop_.descriptor(), POLLIN, 0}};
  ::ppoll(waits, 2, nullptr, nullptr);
}

// False: it has failed.
bool ModbusLink::exchangeOnce() noexcept {
  const Outputs& outputs = outputs_.read();
  if (outputs.number == last_outputs_) return true;
  report_.counters.skipped_outputs += outputs.number - last_outputs_ - 1;
  last_outputs_ = outputs.number;
  if (diagnosis_) diagnosis_->ask();
  const bool moved = outputs.only_reads ? exchange_.look(newest_, stop_) : exchange_.run(outputs.words, newest_, stop_);
  if (!moved) {
    const ModbusTrouble trouble = exchange_.trouble();
    report_.text = exchange_.reason();
    // One refusal counts as what the exchange has failed by.
    report_.counters.exceptions += exchange_.refusals() - (trouble == ModbusTrouble::kException ? 1 : 0);
    failed(trouble, exchange_.exception());
    return false;
  }
  // Last: whether the bus ran is to be known of the time in which the inputs were read.
  if (!readRunning()) {
    report_.text = acyclic_.reason();
    failed();
    return false;
  }
  newest_.outputs = outputs.number;
  ++report_.counters.exchanges;
  report_.counters.requests = exchange_.requests() + acyclic_.requests();
  report_.text.clear();
  backoff_.succeeded();
  // Inputs of a bus nobody knows of are none.
  if (newest_.asked != Instant{}) {
    ++newest_.number;
    inputs_.write(newest_);
  }
  tell(LinkState::kConnected);
  return true;
}

bool ModbusLink::readRunning() noexcept {
  if (diagnosis_ && !settings_.running) {
    newest_.bus_runs = true;
    return true;
  }
  RunningState running;
  if (!diagnosis_ && !acyclic_.readRunning(running, stop_)) return false;
  if (diagnosis_) running = diagnosis_->state().running;
  newest_.bus_runs = running.known && running.bus_runs;
  newest_.running = running.value;
  if (diagnosis_) newest_.asked = std::min(newest_.asked, running.asked);
  return true;
}

void ModbusLink::failed(ModbusTrouble trouble, unsigned exception) noexcept {
  if (ending()) return;
  countTrouble(trouble, report_.counters);
  const bool is_refused = trouble == ModbusTrouble::kException && exception != kServerBusy;
  if (started_ && is_refused) ++report_.counters.refused_exchanges;
  desk_.refuse(report_.text);
  // "Busy" (5, 6) asks for a later try, and one is no reason to have the drives wait for their words: the next cycle's
  // are that try.
  const bool at_once = started_ && trouble == ModbusTrouble::kException && backoff_.fresh();
  const Instant until = backoff_.failed(now());
  if (at_once) return tell(LinkState::kConnected);
  tell(LinkState::kPausing);
  if (trouble == ModbusTrouble::kSilent && connection_.isLate(until, stop_)) {
    ++report_.counters.late;
    report_.text = connection_.reason();
    tell(LinkState::kPausing);
  }
  // A server that refuses in due form stays connected: it may have no room for a second connection.
  const bool is_usable = trouble == ModbusTrouble::kException || trouble == ModbusTrouble::kNone;
  pause(until, is_usable);
  if (!is_usable) connection_.abandon();
  started_ = started_ && is_usable;
  if (started_) tell(LinkState::kConnected);
}

// It may refuse to be read, and take what stops a drive: that does not wait. An image that was itself refused is not
// tried again.
void ModbusLink::pause(Instant until, bool is_kept) noexcept {
  bool given = false;
  while (!ending() && now() < until) {
    pollfd waits[] = {{stop_.descriptor(), POLLIN, 0}, {fresh_.descriptor(), POLLIN, 0}};
    const timespec left = toTimeout(until - now());
    ::ppoll(waits, is_kept ? 2 : 1, &left, nullptr);
    if (!is_kept || !fresh_.take()) continue;
    given = true;
    if (stops(outputs_.read())) break;
  }
  if (given) fresh_.signal();
}

void ModbusLink::tell(LinkState state) noexcept {
  report_.state = state;
  reports_.write(report_);
  answers_.signal();
}

}  // namespace nord_driver::link
