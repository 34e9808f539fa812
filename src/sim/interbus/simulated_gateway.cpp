#include "sim/interbus/simulated_gateway.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

using link::ModbusFunction;

constexpr Duration kStep = std::chrono::milliseconds(1);  // at most so late the gateway's watchdog acts

WordRange registersOf(const link::RegisterBlock& block, std::size_t part) noexcept {
  return {static_cast<std::uint16_t>(block.address + block.parts[part].first), block.parts[part].count};
}

bool reads(ModbusFunction function) noexcept {
  return function != ModbusFunction::kWriteRegisters;
}

}  // namespace

SimulatedGateway::SimulatedGateway(const SimConfig& config, link::ModbusSettings settings)
    : settings_(std::move(settings)),
      robot_(config),
      ring_(robot_),
      gateway_(config.bus.as<IbsBusConfig>(), ring_),
      pause_(settings_.first_pause) {
  ring_.advance(now_);
}

bool SimulatedGateway::open() noexcept {
  if (doing_ == Doing::kNothing) connect();
  return true;
}

void SimulatedGateway::close() noexcept {
  doing_ = Doing::kNothing;
  connected_ = watchdog_set_ = false;
  arrives_.reset();
  answered_.reset();
  report_.text.clear();
  tell(link::LinkState::kClosed);
}

std::uint64_t SimulatedGateway::give(const RegisterImage& outputs) noexcept {
  given_image_ = outputs;
  ++given_;
  if (doing_ == Doing::kIdle) startExchange();
  return given_;
}

bool SimulatedGateway::waitAnswers(Instant until) noexcept {
  if (!answers_) advanceTo(until, true);
  return std::exchange(answers_, false);
}

void SimulatedGateway::sleepUntil(Instant when) noexcept {
  advanceTo(when, false);
}

void SimulatedGateway::setNetwork(const NetworkState& network) noexcept {
  const bool closes = network_.port_open && !network.port_open;
  network_ = network;
  if (closes) resetConnection();
}

void SimulatedGateway::resetConnection() noexcept {
  connected_ = false;
  if (doing_ == Doing::kExchanges || doing_ == Doing::kSetsWatchdog) {
    fail(Failure::kClosed, "has closed the connection instead of answering");
  }
}

// --- Time ---

Instant SimulatedGateway::nextEvent() const noexcept {
  Instant next = Instant::max();
  if (doing_ != Doing::kNothing && doing_ != Doing::kIdle) next = due_;
  if (arrives_) next = std::min(next, *arrives_);
  if (answered_) next = std::min(next, *answered_);
  for (const auto& plan : planned_) next = std::min(next, plan.first);
  return next;
}

void SimulatedGateway::advanceTo(Instant when, bool stop_at_answer) noexcept {
  while (now_ < when && !(stop_at_answer && answers_)) {
    now_ = std::max(now_, std::min({when, now_ + kStep, nextEvent()}));
    ring_.advance(now_);
    gateway_.advance(now_);
    runPlanned();
    while (handleEvent()) {
    }
  }
}

void SimulatedGateway::runPlanned() noexcept {
  for (std::size_t i = 0; i < planned_.size();) {
    if (planned_[i].first > now_) {
      ++i;
      continue;
    }
    const std::function<void()> what = std::move(planned_[i].second);
    planned_.erase(planned_.begin() + static_cast<std::ptrdiff_t>(i));
    what();
  }
}

bool SimulatedGateway::handleEvent() noexcept {
  if (arrives_ && *arrives_ <= now_) {
    arrive();
    return true;
  }
  if (answered_ && *answered_ <= now_) {
    handleAnswer();
    return true;
  }
  if (doing_ == Doing::kNothing || doing_ == Doing::kIdle || due_ > now_) return false;
  if (doing_ == Doing::kConnects) {
    handleConnect();
  } else if (doing_ == Doing::kPauses) {
    if (!connected_ || !watchdog_set_) {
      connect();
    } else {
      doing_ = Doing::kIdle;
      tell(link::LinkState::kConnected);
      if (given_ != last_outputs_) startExchange();
    }
  } else {
    Sentence what;
    what.format("has not answered %s within %.3f s", describe(request_).c_str(), toSeconds(settings_.response_timeout));
    fail(Failure::kSilent, what.c_str());
  }
  return true;
}

// --- Connecting ---

void SimulatedGateway::connect() noexcept {
  doing_ = Doing::kConnects;
  due_ = now_ + (network_.carries_requests && network_.carries_answers ? network_.latency : settings_.connect_timeout);
  tell(link::LinkState::kConnecting);
}

void SimulatedGateway::handleConnect() noexcept {
  if (!connected_) {
    if (!network_.carries_requests || !network_.carries_answers) {
      return fail(Failure::kConnect, "does not answer an attempt to connect");
    }
    if (!network_.port_open) return fail(Failure::kConnect, "refuses the connection");
    connected_ = true;
    ++report_.counters.connections;
    ring_.masterBegins();
  }
  written_.clear();
  doing_ = Doing::kSetsWatchdog;
  step_ = 0;
  sendNext();
}

// --- Exchanges, as link::ModbusExchange makes them ---

void SimulatedGateway::startExchange() noexcept {
  report_.counters.skipped_outputs += given_ - last_outputs_ - 1;
  last_outputs_ = given_;
  sent_ = given_image_;
  doing_ = Doing::kExchanges;
  if (!connected_) return fail(Failure::kClosed, "has closed the connection");
  order_ = link::stopsFirst(settings_, written_, sent_);
  coming_.words.clear();
  coming_.bus_runs = true;
  coming_.asked = now_;
  step_ = 0;
  sendNext();
}

bool SimulatedGateway::makeWatchdogRequest(link::ModbusRequest& request) noexcept {
  if (!settings_.watchdog || step_ > 1) return false;
  const WordRange place{settings_.watchdog->address, 1};
  request.function = step_ == 0 ? ModbusFunction::kWriteRegisters : ModbusFunction::kReadHoldingRegisters;
  (step_ == 0 ? request.write : request.read) = place;
  request.values = &settings_.watchdog->value;
  return true;
}

bool SimulatedGateway::makeImageRequest(link::ModbusRequest& request) noexcept {
  const std::size_t reads_left = settings_.inputs.parts.size();
  const bool both = settings_.inputs.function == ModbusFunction::kReadWriteRegisters;
  const std::size_t writes = both ? std::max(order_.size(), reads_left) : order_.size();
  std::size_t step = step_;
  if (step < writes) {
    const std::size_t part = order_[std::min(step, order_.size() - 1)];
    request.function = settings_.outputs.function;
    request.write = registersOf(settings_.outputs, part);
    request.values = sent_.data() + settings_.outputs.parts[part].first;
    if (both) request.read = registersOf(settings_.inputs, std::min(step, reads_left - 1));
    return true;
  }
  step -= writes;
  if (!both && step < reads_left) {
    if (step == 0) coming_.asked = now_;
    request.function = settings_.inputs.function;
    request.read = registersOf(settings_.inputs, step);
    return true;
  }
  if (!both) step -= reads_left;
  if (step > 0 || !settings_.running) return false;
  request.function = settings_.running->function;
  request.read = {settings_.running->address, 1};
  return true;
}

bool SimulatedGateway::makeRequest(link::ModbusRequest& request) noexcept {
  request = {};
  request.unit = settings_.unit;
  request.transaction = ++transaction_;
  return doing_ == Doing::kSetsWatchdog ? makeWatchdogRequest(request) : makeImageRequest(request);
}

void SimulatedGateway::sendNext() noexcept {
  if (!makeRequest(request_)) return finish();
  due_ = now_ + settings_.response_timeout;
  arrives_.reset();
  answered_.reset();
  if (network_.carries_requests) arrives_ = now_ + network_.latency / 2;
}

void SimulatedGateway::arrive() noexcept {
  arrives_.reset();
  const link::ModbusAdu bytes = toBytes(request_);
  if (tap_) tap_(ByteView{bytes}, Sender::kDriver, now_);
  answer_ = gateway_.handle(ByteView{bytes}, now_);
  if (answer_.empty() || !network_.carries_answers) return;
  answered_ = now_ + network_.latency / 2 + gateway_.switches().delay;
}

void SimulatedGateway::handleAnswer() noexcept {
  answered_.reset();
  if (tap_) tap_(ByteView{answer_}, Sender::kGateway, now_);
  const link::AnswerVerdict verdict = judge(request_, ByteView{answer_});
  if (!verdict.good()) {
    const bool refused = verdict.fault == link::AnswerFault::kException;
    return fail(refused ? Failure::kException : Failure::kBadAnswer, describe(request_, verdict).c_str());
  }
  ++report_.counters.requests;
  if (doing_ == Doing::kSetsWatchdog) {
    if (step_ == 1 && link::answerRegister(ByteView{answer_}, 0) != settings_.watchdog->value) {
      return fail(Failure::kWatchdog, "does not hold what was written into its watchdog register");
    }
  } else {
    use(ByteView{answer_});
  }
  ++step_;
  sendNext();
}

void SimulatedGateway::use(ByteView answer) noexcept {
  const auto& outputs = settings_.outputs;
  const bool writes = request_.write.count > 0;
  if (writes) {
    const std::size_t first = request_.write.first - std::size_t{outputs.address};
    written_.resize(std::max(written_.size(), first + request_.write.count));
    for (std::size_t i = first; i < first + request_.write.count; ++i) written_[i] = sent_[i];
  }
  if (!reads(request_.function)) return;
  const std::size_t writes_and_reads = step_ + 1;
  const std::size_t parts = settings_.inputs.function == ModbusFunction::kReadWriteRegisters
                                ? std::max(order_.size(), settings_.inputs.parts.size())
                                : order_.size() + settings_.inputs.parts.size();
  if (writes_and_reads > parts) {
    coming_.running = link::answerRegister(answer, 0);
    coming_.bus_runs = (coming_.running & settings_.running->mask) == settings_.running->value;
    return;
  }
  const std::size_t first = request_.read.first - std::size_t{settings_.inputs.address};
  coming_.words.resize(std::max(coming_.words.size(), first + request_.read.count));
  for (std::size_t i = 0; i < request_.read.count; ++i) coming_.words[first + i] = link::answerRegister(answer, i);
}

void SimulatedGateway::finish() noexcept {
  if (doing_ == Doing::kSetsWatchdog) {
    watchdog_set_ = true;
    last_outputs_ = given_;  // what was meant for the time before is not sent
    doing_ = Doing::kIdle;
    return tell(link::LinkState::kConnected);
  }
  coming_.outputs = last_outputs_;
  coming_.received = now_;
  coming_.number = newest_.number + 1;
  newest_ = coming_;
  ++report_.counters.exchanges;
  pause_ = settings_.first_pause;
  report_.text.clear();
  doing_ = Doing::kIdle;
  tell(link::LinkState::kConnected);
  if (given_ != last_outputs_) startExchange();
}

void SimulatedGateway::fail(Failure failure, const char* what) noexcept {
  link::LinkCounters& counters = report_.counters;
  switch (failure) {
    case Failure::kConnect:
      ++counters.connect_failures;
      break;
    case Failure::kClosed:
      ++counters.closed;
      break;
    case Failure::kSilent:
      ++counters.timeouts;
      break;
    case Failure::kBadAnswer:
      ++counters.bad_answers;
      break;
    case Failure::kException:
      ++counters.exceptions;
      break;
    case Failure::kWatchdog:
      break;
  }
  arrives_.reset();
  answered_.reset();
  report_.text.format("%s %s", settings_.server.c_str(), what);
  const bool usable = failure == Failure::kException || failure == Failure::kWatchdog;
  connected_ = connected_ && usable;
  watchdog_set_ = watchdog_set_ && usable;
  doing_ = Doing::kPauses;
  due_ = now_ + pause_;
  pause_ = std::min(2 * pause_, settings_.longest_pause);
  tell(link::LinkState::kPausing);
}

void SimulatedGateway::tell(link::LinkState state) noexcept {
  report_.state = state;
  answers_ = true;
}

}  // namespace nord_driver::sim
