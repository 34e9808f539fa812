#include "sim/interbus/simulated_gateway.h"

#include <algorithm>

#include "link/modbus/modbus_acyclic.h"
#include "link/modbus/trouble_counters.h"

namespace nord_driver::sim {

namespace {

using link::ModbusFunction;
using link::ModbusTrouble;

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
      backoff_(settings_.first_pause, settings_.longest_pause) {
  ring_.advance(now_);
}

bool SimulatedGateway::open() noexcept {
  if (doing_ != Doing::kNothing) return true;
  backoff_.succeeded();
  connect();
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
  given_look_ = false;
  return startGiven();
}

std::uint64_t SimulatedGateway::startGiven() noexcept {
  ++given_;
  if (doing_ == Doing::kIdle) startExchange();
  return given_;
}

std::uint64_t SimulatedGateway::order(const link::RegisterOrder& order) noexcept {
  next_order_ = order;
  ++ordered_;
  if (doing_ == Doing::kIdle) startOrder();
  return ordered_;
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
  if (isAsking()) fail(ModbusTrouble::kClosed, "has closed the connection instead of answering");
}

bool SimulatedGateway::isAsking() const noexcept {
  return doing_ == Doing::kSetsWatchdog || doing_ == Doing::kExchanges || doing_ == Doing::kServes;
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
      tell(link::LinkState::kConnected);
      rest();
    }
  } else {
    Sentence what;
    what.format("has not answered %s within %.3f s", describe(request_).c_str(), toSeconds(settings_.response_timeout));
    fail(ModbusTrouble::kSilent, what.c_str());
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
      return fail(ModbusTrouble::kNoConnection, "does not answer an attempt to connect");
    }
    if (!network_.port_open) return fail(ModbusTrouble::kNoConnection, "refuses the connection");
    connected_ = true;
    ++report_.counters.connections;
    ring_.masterBegins();
  }
  written_.clear();
  doing_ = Doing::kSetsWatchdog;
  step_ = 0;
  sendNext();
}

// --- Exchanges, as link::ModbusExchange makes them, and orders behind them ---

// What came meanwhile is next.
void SimulatedGateway::rest() noexcept {
  doing_ = Doing::kIdle;
  if (given_ != last_outputs_) return startExchange();
  if (ordersWait()) startOrder();
}

void SimulatedGateway::startOrder() noexcept {
  running_order_ = next_order_;
  served_ = ordered_;
  doing_ = Doing::kServes;
  if (!connected_) return fail(ModbusTrouble::kClosed, "has closed the connection");
  step_ = 0;
  sendNext();
}

void SimulatedGateway::answerOrder(const link::RegisterAnswer& answer) noexcept {
  order_answer_ = answer;
  order_answer_.number = served_;
}

void SimulatedGateway::startExchange() noexcept {
  report_.counters.skipped_outputs += given_ - last_outputs_ - 1;
  last_outputs_ = given_;
  sent_ = given_image_;
  looks_ = given_look_;
  doing_ = Doing::kExchanges;
  if (!connected_) return fail(ModbusTrouble::kClosed, "has closed the connection");
  part_order_ = looks_ ? link::PartOrder{} : link::stopsFirst(settings_, written_, sent_);
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
  const bool both = doesBoth();
  const std::size_t writes = both ? std::max(part_order_.size(), reads_left) : part_order_.size();
  std::size_t step = step_;
  if (step < writes) {
    const std::size_t part = part_order_[std::min(step, part_order_.size() - 1)];
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
    if (request.function == ModbusFunction::kReadWriteRegisters)
      request.function = ModbusFunction::kReadHoldingRegisters;
    request.read = registersOf(settings_.inputs, step);
    return true;
  }
  if (!both) step -= reads_left;
  if (step > 0 || !settings_.running) return false;
  request.function = settings_.running->function;
  request.read = {settings_.running->address, 1};
  return true;
}

bool SimulatedGateway::makeOrderRequest(link::ModbusRequest& request) noexcept {
  if (step_ > 0) return false;
  request = requestOf(running_order_);
  return true;
}

bool SimulatedGateway::makeRequest(link::ModbusRequest& request) noexcept {
  request = {};
  const bool there = doing_ == Doing::kSetsWatchdog ? makeWatchdogRequest(request)
                     : doing_ == Doing::kServes     ? makeOrderRequest(request)
                                                    : makeImageRequest(request);
  request.unit = settings_.unit;
  request.transaction = ++transaction_;
  return there;
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
  if (!verdict.good()) return handleRefusal(verdict);
  ++report_.counters.requests;
  if (doing_ == Doing::kSetsWatchdog) {
    if (step_ == 1 && link::answerRegister(ByteView{answer_}, 0) != settings_.watchdog->value) {
      return fail(ModbusTrouble::kNone, "does not hold what was written into its watchdog register");
    }
  } else if (doing_ == Doing::kServes) {
    useOrdered(ByteView{answer_});
  } else {
    use(ByteView{answer_});
  }
  ++step_;
  sendNext();
}

// An order the server refuses in due form is answered, and nothing else happens.
void SimulatedGateway::handleRefusal(const link::AnswerVerdict& verdict) noexcept {
  const bool refused = verdict.fault == link::AnswerFault::kException;
  const Sentence what = describe(request_, verdict);
  if (!refused || doing_ != Doing::kServes) {
    return fail(refused ? ModbusTrouble::kException : ModbusTrouble::kBadAnswer, what.c_str());
  }
  countTrouble(ModbusTrouble::kException, report_.counters);
  link::RegisterAnswer answer;
  answer.text.format("%s %s", settings_.server.c_str(), what.c_str());
  answerOrder(answer);
  rest();
}

void SimulatedGateway::useOrdered(ByteView answer) noexcept {
  link::RegisterAnswer good;
  good.good = true;
  for (std::size_t i = 0; i < request_.read.count; ++i) good.values[i] = link::answerRegister(answer, i);
  answerOrder(good);
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
  const std::size_t parts = doesBoth() ? std::max(part_order_.size(), settings_.inputs.parts.size())
                                       : part_order_.size() + settings_.inputs.parts.size();
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
  if (doing_ == Doing::kServes) return rest();
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
  backoff_.succeeded();
  report_.text.clear();
  doing_ = Doing::kIdle;
  tell(link::LinkState::kConnected);
  ordersWait() ? startOrder() : rest();
}

void SimulatedGateway::fail(ModbusTrouble trouble, const char* what) noexcept {
  countTrouble(trouble, report_.counters);
  if (watchdog_set_ && trouble == ModbusTrouble::kException) ++report_.counters.refused_exchanges;
  arrives_.reset();
  answered_.reset();
  report_.text.format("%s %s", settings_.server.c_str(), what);
  if (order_answer_.number != ordered_) {
    served_ = ordered_;
    link::RegisterAnswer given_up;
    given_up.text = report_.text;
    answerOrder(given_up);
  }
  // A server that refuses in due form stays connected.
  const bool is_usable = trouble == ModbusTrouble::kException || trouble == ModbusTrouble::kNone;
  connected_ = connected_ && is_usable;
  watchdog_set_ = watchdog_set_ && is_usable;
  doing_ = Doing::kPauses;
  due_ = backoff_.failed(now_);
  tell(link::LinkState::kPausing);
}

void SimulatedGateway::tell(link::LinkState state) noexcept {
  report_.state = state;
  answers_ = true;
}

}  // namespace nord_driver::sim
