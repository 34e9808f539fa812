#include "link/modbus/modbus_link.h"

#include <poll.h>

#include <algorithm>
#include <exception>

#include "link/waiting.h"

namespace nord_driver::link {

ModbusLink::ModbusLink(const ModbusSettings& settings, LookUp look_up)
    : settings_(settings), connection_(settings_, std::move(look_up)), exchange_(settings_, connection_) {
  if (checkModbusSettings(settings_, problem_)) problem_.clear();
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
    pause_ = settings_.first_pause;
    try {
      thread_ = std::thread([this] { work(); });
      return true;
    } catch (const std::exception& error) {
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
}

std::uint64_t ModbusLink::give(const RegisterImage& outputs) noexcept {
  outputs_.write({++given_, outputs});
  fresh_.signal();
  return given_;
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
      if (!ending() && fresh_.take()) exchangeOnce();
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
  if (!exchange_.start(stop_)) {
    report_.text = exchange_.reason();
    return false;
  }
  // What was meant for the time before is not sent.
  fresh_.take();
  last_outputs_ = outputs_.read().number;
  started_ = true;
  tell(LinkState::kConnected);
  return true;
}

void ModbusLink::waitForOutputs() noexcept {
  pollfd waits[] = {{fresh_.descriptor(), POLLIN, 0}, {stop_.descriptor(), POLLIN, 0}};
  ::ppoll(waits, 2, nullptr, nullptr);
}

void ModbusLink::exchangeOnce() noexcept {
  const Outputs& outputs = outputs_.read();
  if (outputs.number == last_outputs_) return;
  report_.counters.skipped_outputs += outputs.number - last_outputs_ - 1;
  last_outputs_ = outputs.number;
  if (!exchange_.run(outputs.words, newest_, stop_)) {
    report_.text = exchange_.reason();
    failed();
    return;
  }
  newest_.outputs = outputs.number;
  ++newest_.number;
  inputs_.write(newest_);
  pause_ = settings_.first_pause;
  ++report_.counters.exchanges;
  report_.counters.requests = exchange_.requests();
  report_.text.clear();
  tell(LinkState::kConnected);
}

void ModbusLink::failed() noexcept {
  if (ending()) return;
  const ModbusTrouble trouble = connection_.trouble();
  count(trouble);
  tell(LinkState::kPausing);
  const Instant until = now() + pause_;
  pause_ = std::min(2 * pause_, settings_.longest_pause);
  if (trouble == ModbusTrouble::kSilent && connection_.isLate(until, stop_)) {
    ++report_.counters.late;
    report_.text = connection_.reason();
    tell(LinkState::kPausing);
  }
  pause(until);
  // A server that refuses in due form stays connected: it may have no room for a second connection.
  const bool is_usable = trouble == ModbusTrouble::kException || trouble == ModbusTrouble::kNone;
  if (!is_usable) connection_.abandon();
  started_ = started_ && is_usable;
  if (started_) tell(LinkState::kConnected);
}

void ModbusLink::pause(Instant until) noexcept {
  pollfd wait{stop_.descriptor(), POLLIN, 0};
  const timespec left = toTimeout(until - now());
  ::ppoll(&wait, 1, &left, nullptr);
}

void ModbusLink::count(ModbusTrouble trouble) noexcept {
  LinkCounters& counters = report_.counters;
  switch (trouble) {
    case ModbusTrouble::kNoConnection:
      ++counters.connect_failures;
      break;
    case ModbusTrouble::kClosed:
      ++counters.closed;
      break;
    case ModbusTrouble::kSilent:
      ++counters.timeouts;
      break;
    case ModbusTrouble::kPartial:
      ++counters.partial;
      break;
    case ModbusTrouble::kUnasked:
      ++counters.unasked;
      break;
    case ModbusTrouble::kBadAnswer:
      ++counters.bad_answers;
      break;
    case ModbusTrouble::kException:
      ++counters.exceptions;
      break;
    case ModbusTrouble::kNone:
    case ModbusTrouble::kCancelled:
      break;
  }
}

void ModbusLink::tell(LinkState state) noexcept {
  report_.state = state;
  reports_.write(report_);
  answers_.signal();
}

}  // namespace nord_driver::link
