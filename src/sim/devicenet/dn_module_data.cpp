// Process data of a module, and what it watches: BU 0280 4.1.3, 4.2 and 6.

#include <algorithm>

#include "sim/devicenet/dn_module.h"
#include "sim/drive_unit.h"

namespace nord_driver::sim {

namespace {

// P170: BU 0280 6.2.2.
constexpr std::int32_t kBusTimeout = 1020;
constexpr std::int32_t kDeviceNetTimeout = 5220;
constexpr std::int32_t kAddressTaken = 5211;

// P173.
constexpr unsigned kNotConnected = 1u << 0;
constexpr unsigned kConnected = 1u << 1;
constexpr unsigned kTimeout = 1u << 2;
constexpr unsigned kFaultySwitches = 1u << 3;
constexpr unsigned kOnline = 2;
constexpr unsigned kLost = 3;

constexpr std::uint8_t kOutputs = 0x03;  // DO1 and DO2
// Between two messages of a value that keeps changing; the simulator's.
constexpr Duration kInhibit = std::chrono::milliseconds(2);

}  // namespace

// "The parameters are adopted when the I/O message connection is set up" (BU 0280 4.2.1). On a technology unit without
// parameters of its own P507 of the inverter selects the assembly; its manual is BU 0080, which is not at hand.
DnLayout DnModule::layout() const noexcept {
  if (inDataExchange()) return running_layout_;
  if (isGateway()) return DnLayout::ofInstance(dnInstanceOfSelection(parameters_.value(160)), parameters_);
  const std::int32_t type = driveAt(0) == nullptr ? 3 : driveAt(0)->parameters().value(507);
  return DnLayout::ofInstance(dnInstanceOfSelection(type), parameters_);
}

void DnModule::poll(const CanFrame& frame, bool judged, CanSink& sink) noexcept {
  const bool polled = connections_.has(dn::kChoicePoll);
  const DnConnectionKind kind = connections_.taking();
  const DnConnection& connection = connections_[kind];
  if (!connection.established()) return;
  connections_.feed(kind);
  const auto message = io_in_.receive(frame.bytes(), connection.consumed);
  if (!message) return;
  // No data at all: the scanner is idle, which is answered and commands nothing.
  if (!message->empty() && message->size() != connection.consumed) return;
  ++counters_.polls;
  if (!message->empty()) take(*message, judged);
  if (polled) return sendInputs(dn::kPollResponse, sink);
  if (!connections_.has(dn::kChoiceNoAcknowledge)) send(dn::group1(dn::kPollResponse, mac()), ByteView{}, sink);
}

// The own bit must be 0 for the process data to reach the inverters; 1: the last values stay. Either way P151 is fed,
// "although no new process values have been sent" (BU 0280 4.1.3, 4.2.1). There are none in a strobe: what was written
// to the assembly counts.
void DnModule::strobe(const CanFrame& frame, bool judged, CanSink& sink) noexcept {
  if (!connections_[DnConnectionKind::kStrobe].established() || frame.size != 8) return;
  connections_.feed(DnConnectionKind::kStrobe);
  ++counters_.strobes;
  const bool hold = (frame.data[mac() / 8u] >> (mac() % 8u) & 1u) != 0;
  if (!hold && !process_.outputs().empty()) {
    const DnProcessBytes outputs = process_.outputs();
    take(outputs, judged);
  }
  since_valid_ = Duration::zero();
  sendInputs(dn::kStrobeResponse, sink);
}

void DnModule::take(ByteView outputs, bool judged) noexcept {
  const DnProcess::Taken taken = process_.take(outputs, running_layout_, timed_out_);
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (running_layout_.areas[place].control_length == 0) continue;
    ExchangeCounters& counters = exchanged_[place];
    ++counters.data_exchanges;
    counters.last_control = process_.lastControl(place);
    parameters_.show(176, 1 + 4 * place, toSigned(counters.last_control));
    for (unsigned n = 0; n < 3; ++n) {
      parameters_.show(176, 2 + 4 * place + n, toSigned(process_.lastData(place).setpoints[n]));
    }
  }
  parameters_.show(176, 0, process_.outputByte());
  if (taken.zero && master_may_look_ <= Duration::zero()) {
    ++counters_.zero_control_words;
    if (judged) referee_.broken(DnRule::kZeroControlWord);
  }
  if (taken.valid) {
    valid_data_seen_ = true;
    since_valid_ = Duration::zero();
    cause_stands_ = false;
  }
  endTimeOut();
}

void DnModule::sendInputs(unsigned message, CanSink& sink) noexcept {
  const DnProcessBytes inputs = process_.inputs(running_layout_);
  sendMessage(message, inputs, sink);
}

void DnModule::sendMessage(unsigned message, ByteView data, CanSink& sink) noexcept {
  DnIoSender frames{data};
  while (const auto frame = frames.next()) send(dn::group1(message, mac()), *frame, sink);
}

// Change of state: when a value has changed, and when the packet rate is over; cyclic: the latter only. What is not
// acknowledged is sent again, up to the limit of class 43.
void DnModule::produce(Duration span, CanSink& sink) noexcept {
  const DnConnection& connection = connections_[DnConnectionKind::kChangeOfState];
  if (!connection.established()) return;
  production_.since += span;
  const bool wants = !connections_.has(dn::kChoiceNoAcknowledge);
  if (production_.waits) {
    production_.waited += span;
    if (production_.waited >= std::chrono::milliseconds(acknowledge_time_)) {
      production_.waited = Duration::zero();
      if (production_.retries >= retry_limit_) {
        production_.waits = false;
      } else {
        ++production_.retries;
        sendMessage(dn::kChangeOfState, production_.last, sink);
      }
    }
  }
  const std::chrono::milliseconds rate{connection.packet_rate};
  bool due = !production_.sent || (connection.packet_rate > 0 && production_.since >= rate);
  const DnProcessBytes inputs = process_.inputs(running_layout_);
  const bool changes = connections_.has(dn::kChoiceChangeOfState) && production_.since >= kInhibit;
  due = due || (changes && inputs != production_.last);
  if (!due) return;
  ++counters_.productions;
  production_ = {inputs, true, Duration::zero(), wants, Duration::zero(), 0};
  sendMessage(dn::kChangeOfState, inputs, sink);
}

// P151 > 0: no valid control word for that long is E10.3 in every inverter (BU 0280 6.2.1). A technology unit on an
// inverter has no such parameter, its inverter watches by P513.
void DnModule::watch(Duration span) noexcept {
  for (unsigned place = 0; place < kPlaces; ++place) seen_[place] = seen_[place] || present(place);
  const std::int32_t limit = isGateway() ? parameters_.value(151) : 0;
  if (limit > 0 && valid_data_seen_) {
    since_valid_ += span;
    if (since_valid_ >= std::chrono::milliseconds(limit)) {
      valid_data_seen_ = false;  // watched again from the next valid word on
      timeOut(kBusTimeout);
    }
  }
  endTimeOut();
}

// An I/O connection is over: E10.2 (BU 0280 6.2.1).
void DnModule::masterLost() noexcept {
  ++counters_.timeouts;
  io_in_.reset();
  process_.beginExchange();
  process_.clearOutputByte();
  valid_data_seen_ = false;
  for (unsigned place = 0; place < kPlaces; ++place) {
    ExchangeCounters& counters = exchanged_[place];
    counters.control_before_loss = counters.last_control;
    if (driveAt(place) != nullptr) counters.status_at_loss = driveAt(place)->inverter().statusWord();
  }
  timeOut(kDeviceNetTimeout);
}

void DnModule::timeOut(std::int32_t error) noexcept {
  if (isGateway()) {
    timed_out_ = cause_stands_ = true;
    error_ = error;
  }
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (!present(place)) continue;
    if (error == kDeviceNetTimeout) {
      driveAt(place)->inverter().masterLost();
    } else {
      driveAt(place)->inverter().moduleTimeout();
    }
  }
}

void DnModule::endTimeOut() noexcept {
  if (!timed_out_ || cause_stands_) return;
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (present(place) && driveAt(place)->inverter().faultNumber() != 0) return;
  }
  timed_out_ = false;
  parameters_.preset(170, 0, 1, error_);
  error_ = 0;
}

std::uint8_t DnModule::outputs() const noexcept {
  if (!alive()) return 0;
  switch (parameters_.value(150)) {
    case 1:
      return 0;
    case 2:
      return 1;
    case 3:
      return 2;
    case 4:
      return 3;
    default:
      return timed_out_ ? std::uint8_t{0} : static_cast<std::uint8_t>(process_.outputByte() & kOutputs);
  }
}

std::int32_t DnModule::moduleStatus() const noexcept {
  unsigned status = connections_.owner() == dn::kNoMac ? kNotConnected : kConnected;
  if (error_ == kBusTimeout || error_ == kDeviceNetTimeout) status |= kTimeout;
  if (error_ == kAddressTaken) status |= kFaultySwitches;
  for (unsigned place = 0; place < kPlaces; ++place) {
    const unsigned code = present(place) ? kOnline : seen_[place] ? kLost : 0u;
    status |= code << (8 + 2 * place);
  }
  return static_cast<std::int32_t>(status);
}

void DnModule::showStatus() noexcept {
  parameters_.show(170, 0, error_);
  parameters_.show(173, 0, moduleStatus());
  parameters_.show(174, 0, process_.moduleInputs());
  parameters_.show(175, 0, outputs());
  parameters_.show(177, 0, process_.moduleInputs());
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (!present(place)) continue;
    const InverterModel& inverter = driveAt(place)->inverter();
    ParameterStore& parameters = driveAt(place)->parameters();
    parameters_.show(177, 1 + 4 * place, toSigned(inverter.statusWord()));
    parameters.show(741, 0, inverter.statusWord());
    for (unsigned n = 0; n < 3; ++n) {
      const Word value = inverter.actualValue(n);
      parameters_.show(177, 2 + 4 * place + n, toSigned(value));
      parameters.show(741, 1 + n, value);
    }
  }
}

ExchangeCounters DnModule::countersOf(unsigned place) const noexcept {
  ExchangeCounters counters = exchanged_[place];
  counters.telegrams = counters_.polls + counters_.strobes + counters_.explicit_requests;
  counters.watchdog_trips = counters_.timeouts;
  counters.zero_control_words = counters_.zero_control_words;
  return counters;
}

}  // namespace nord_driver::sim
