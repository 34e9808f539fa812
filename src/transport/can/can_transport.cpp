#include "transport/can/can_transport.h"

#include <algorithm>
#include <utility>

#include "core/can_trace.h"
#include "link/can/make_can_link.h"
#include "transport/reopen_interval.h"

namespace nord_driver {

namespace {

constexpr Duration kShortestWait = std::chrono::microseconds{50};
constexpr Duration kQueueRetry = std::chrono::microseconds{250};
constexpr int kFramesAtOnce = 1000;
constexpr Duration kLineCountersInterval = std::chrono::milliseconds{500};  // each time is a system call

std::unique_ptr<link::CanLink> openInterface(const link::CanSettings& settings) {
  return link::makeCanLink(settings);
}

std::string rawText(const TraceRecord& record) {
  const auto frame = fromPacket(record.view());
  return frame ? candumpText(*frame) : toHex(record.view());
}

}  // namespace

CanTransport::CanTransport(LinkFactory make_link) : make_link_(make_link ? std::move(make_link) : openInterface) {}

void CanTransport::prepare(const Settings& bus, Setup setup, CanEngine& engine) {
  if (parameters_only_) setup.link.ids.clear();
  Sentence reason;
  if (!link::checkCanSettings(setup.link, reason)) throw ConfigError(bus.fullName("interface") + ": " + reason.str());
  interface_ = setup.link.interface;
  period_ = setup.period;
  answer_window_ = setup.answer_window;
  longest_release_ = setup.longest_release;
  engine_ = &engine;
  listen_first_ = setup.listen;
  trace_.emplace(kLinkTypeCanSocketCan, std::move(setup.describe), TelegramTrace::kCapacity, rawText);
  link_ = make_link_(setup.link);
}

bool CanTransport::serveParametersOnly() noexcept {
  parameters_only_ = true;
  return true;
}

void CanTransport::sleepUntil(Instant when) noexcept {
  if (link_->isOpen()) run(receive(), when, false);
  link_->sleepUntil(when);
}

// An interface that is not there is looked for again and again, whatever happened to it.
bool CanTransport::linkReady() noexcept {
  if (link_->isOpen()) return true;
  const Instant now = link_->now();
  if (now < next_open_) return false;
  next_open_ = now + kReopenInterval;
  if (!link_->open()) return false;
  controller_works_ = true;
  restart();
  return true;
}

void CanTransport::restart() noexcept {
  const Instant now = link_->now();
  engine_->restart(now);
  if (listen_first_) listen_first_->restart(now);
  restartDrives();
}

bool CanTransport::linkWorks() const noexcept {
  return link_->works();
}

void CanTransport::watchController() noexcept {
  const bool works = linkWorks();
  if (works == controller_works_) return;
  controller_works_ = works;
  handleController(works);
}

// Listening is over: the engine begins now, so that none of its times has run meanwhile.
bool CanTransport::mayTalk(Instant now) noexcept {
  if (!listen_first_) return true;
  const bool listened = isSilent();
  if (listened && !linkWorks()) listen_first_->postpone(now);
  if (!listen_first_->mayTalk(now)) return false;
  if (!listened) return true;
  handleListened();
  engine_->restart(now);
  return true;
}

void CanTransport::noteMaster(std::uint32_t id, Instant at) noexcept {
  if (listen_first_) listen_first_->handleMaster(id, at);
}

void CanTransport::exchange(const std::vector<profile::ProcessOutput>& outputs,
                            std::vector<DriveExchange>& inputs) noexcept {
  if (linkReady()) {
    cycle_start_ = link_->now();
    const Instant received = receive();  // what came while nobody looked is older than this cycle's answers
    watchController();
    putOutputs(outputs);
    engine_->startCycle(cycle_start_);
    run(received, cycle_start_ + answer_window_, true);
  }
  takeLineCounters();
  takeInputs(link_->now(), inputs);
}

// The clock may be later than `received` by now, but no time-out may be seen ahead of what has come since.
void CanTransport::run(Instant received, Instant until, bool until_answered) noexcept {
  while (link_->isOpen()) {
    watchController();
    takeEvents();
    const bool talks = mayTalk(received);
    if (talks) {
      engine_->poll(received);
      runRequests(received);
      send(std::max(until, cycle_start_ + period_ / 2));
      takeEvents();
    }
    const Instant now = link_->now();
    if (now >= until || (until_answered && allAnswered())) break;
    const Instant due = (talks ? engine_->nextDeadline() : listen_first_->nextDeadline()).value_or(until);
    // Time must pass, also where something is due that cannot be sent.
    if (!link_->waitReadable(std::min(until, std::max(due, now + kShortestWait))) && link_->now() >= until) break;
    received = receive();
  }
  if (link_->isOpen()) return;
  handleGone();
  next_open_ = link_->now() + kReopenInterval;
}

Instant CanTransport::receive() noexcept {
  link::ReceivedCanFrame received;
  const Instant looked = link_->now();
  for (int count = 0; count < kFramesAtOnce && link_->receive(received); ++count) {
    trace_->record(TraceKind::kReceived, toPacket(received.frame), received.at);
    if (!isSilent()) {
      engine_->handleFrame(received.frame, received.at);
    } else if (parameters_only_) {
      listen_first_->handle(received.frame);
    } else {
      handleWhileListening(received.frame, received.at);
    }
  }
  return looked;
}

// A burst longer than the interface's queue is waited out, but not beyond `until`: the process data of this cycle are
// then dropped, and the next cycle sends newer ones.
void CanTransport::send(Instant until) noexcept {
  CanFrame frame;
  while (engine_->pollTransmit(frame)) {
    link::CanSend sent = link_->send(frame);
    while (sent == link::CanSend::kQueueFull && link_->now() < until && link_->waitWritable(until)) {
      sent = link_->send(frame);
      // A queue further down can be full although this one is not: polling would spin.
      if (sent == link::CanSend::kQueueFull) link_->sleepUntil(std::min(until, link_->now() + kQueueRetry));
    }
    if (sent != link::CanSend::kSent) return engine_->notSent();
    trace_->record(TraceKind::kSent, toPacket(frame), link_->now());
  }
}

void CanTransport::takeLineCounters() noexcept {
  const Instant now = link_->now();
  if (now < next_line_counters_) return;
  next_line_counters_ = now + kLineCountersInterval;
  line_ = link_->counters();
  events_.noteLostFrames(interface_.c_str(), line_.dropped, now);
}

const char* CanTransport::linkNote() const noexcept {
  if (!link_->isOpen()) return "the CAN interface is not open";
  if (isSilent() && !linkWorks()) return "the CAN interface is down or bus-off, so that nobody can be heard yet";
  return isSilent() ? listen_first_->note() : "";
}

Sentence CanTransport::linkText() const noexcept {
  Sentence text;
  if (!link_->isOpen()) {
    text.format("%s", link_->lastError().empty() ? "the CAN interface is not open yet" : link_->lastError().c_str());
    return text;
  }
  text.format("%s", link_->advice());
  return text.empty() && isSilent() ? listen_first_->text() : text;
}

// An exchange that simply ended would be a loss to the nodes, and leave a fault in every inverter.
void CanTransport::release() noexcept {
  const Instant begun = link_->now();
  const Instant until = begun + longest_release_;
  engine_->releaseAll(begun);
  for (;;) {
    send(until);
    const Instant now = link_->now();
    if (engine_->released() || now >= until || !link_->isOpen()) return;
    const Instant due = engine_->nextDeadline().value_or(until);
    link_->waitReadable(std::min(until, std::max(due, now + kShortestWait)));
    engine_->poll(receive());
  }
}

void CanTransport::close() noexcept {
  if (!link_ || !link_->isOpen()) return;
  // Silent: no node was touched, or somebody else has them.
  if (!isSilent()) release();
  link_->close();
}

}  // namespace nord_driver
