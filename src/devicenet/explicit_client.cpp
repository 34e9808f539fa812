#include "devicenet/explicit_client.h"

#include "devicenet/identifier.h"

namespace nord_driver::devicenet {
namespace {

constexpr std::size_t kUnfragmentedBody = 7;
constexpr std::size_t kPerFragment = 6;
constexpr std::uint8_t kAccepted = 0;
constexpr std::uint8_t kTooMuchData = 1;
constexpr Duration kAcknowledgeTime = std::chrono::seconds{1};
/// The device repeats a fragment whose acknowledge was lost after a second.
constexpr Duration kFragmentTime = std::chrono::milliseconds{1200};
/// After a request was given up its answer may come for so long; on the unconnected port, where no inverter is asked for it.
constexpr Duration kLongestLateness = std::chrono::seconds{5};
constexpr Duration kLongestUnconnected = std::chrono::seconds{1};
/// The second answer to a request that was asked twice comes not much later than the first: so many of its time-outs.
constexpr int kSecondAnswer = 4;
/// A keep-alive may share a transaction id with what was given up before: more than the two answers of one request.
constexpr int kMostOwed = 0xFF;

}  // namespace

bool ExplicitClient::start(const ExplicitRequest& request, ExplicitPort port, BodyFormat format, Duration timeout,
                           Instant now) noexcept {
  if (busy()) return false;
  if (!encode(request, port == ExplicitPort::kUnconnected ? BodyFormat::k8Over8 : format, body_)) return false;
  port_ = port;
  id_ = request.id;
  now_ = now;
  if (owes(!xid_, now) && !owes(xid_, now)) {
    receiver_.forget();  // fragments of the same transaction id are of another answer now
  } else {
    xid_ = !xid_;
  }
  shares_xid_ = owes(xid_, now);
  asked_ = 0;
  offset_ = 0;
  count_ = 0;
  repeats_ = 0;
  timeout_ = timeout;
  furthest_ = 0;
  phase_ = Phase::kToSend;
  timers_.set(Timer::kReply, now + timeout);
  return true;
}

bool ExplicitClient::mustWait(Instant now) const noexcept {
  return owes(false, now) && owes(true, now);
}

void ExplicitClient::remember(bool answered, Instant now) noexcept {
  if (phase_ == Phase::kIdle || asked_ == 0) return;
  const int left = asked_ - (answered ? 1 : 0);
  if (left == 0) return;
  Owed& owed = owedOn(port_)[xid_];
  if (now >= owed.until) owed = Owed{};
  owed.answers = static_cast<std::uint8_t>(std::min(owed.answers + left, kMostOwed));
  const Duration longest = port_ == ExplicitPort::kUnconnected ? kLongestUnconnected : kLongestLateness;
  owed.until = std::max(owed.until, now + (answered ? kSecondAnswer * timeout_ : longest));
}

Instant ExplicitClient::owedUntil(bool xid) const noexcept {
  Instant until{};
  for (const OwedByXid& owed : owed_) {
    if (owed[xid].answers > 0) until = std::max(until, owed[xid].until);
  }
  return until;
}

// An error names no service: it may be that of an allocation.
Heard ExplicitClient::late(std::uint8_t code, bool xid) noexcept {
  Owed& connected = owedOn(ExplicitPort::kConnected)[xid];
  Owed& unconnected = owedOn(ExplicitPort::kUnconnected)[xid];
  const bool allocates =
      code == (service::kAllocate | service::kResponse) || code == (service::kRelease | service::kResponse);
  const bool may_allocate =
      code == (service::kError | service::kResponse) && unconnected.answers > 0 && now_ < unconnected.until;
  Owed& owed = allocates || may_allocate || connected.answers == 0 ? unconnected : connected;
  if (owed.answers > 0) --owed.answers;
  return Heard::kStale;
}

void ExplicitClient::cancel() noexcept {
  remember(false, now_);
  phase_ = Phase::kIdle;
  timers_.stopAll();
  receiver_.reset();
  acknowledge_.reset();
  answer_.reset();
}

void ExplicitClient::silence() noexcept {
  cancel();
  receiver_.forget();
}

bool ExplicitClient::fragmented() const noexcept {
  return body_.size() > kUnfragmentedBody;
}

bool ExplicitClient::lastFragmentSent() const noexcept {
  return phase_ == Phase::kAwaitAcknowledge && offset_ + kPerFragment >= body_.size();
}

// An answer says that the request arrived, whether or not its last acknowledge did.
bool ExplicitClient::awaitsAnswer(bool xid) const noexcept {
  const bool waits = phase_ == Phase::kAwaitAnswer || phase_ == Phase::kReceiving || lastFragmentSent() ||
                     (phase_ == Phase::kToSend && repeats_ > 0 && !fragmented());
  return waits && xid == xid_;
}

std::uint8_t ExplicitClient::header(bool fragment, bool xid) const noexcept {
  return static_cast<std::uint8_t>((fragment ? explicit_header::kFragmented : 0u) |
                                   (xid ? explicit_header::kTransaction : 0u) | own_);
}

std::uint32_t ExplicitClient::requestId() const noexcept {
  return identifier(port_ == ExplicitPort::kUnconnected ? Group2::kUnconnected : Group2::kMasterExplicit, device_);
}

Fragment ExplicitClient::fragment() const noexcept {
  if (offset_ == 0) return {FragmentType::kFirst, 0};
  return {offset_ + kPerFragment >= body_.size() ? FragmentType::kLast : FragmentType::kMiddle, count_};
}

CanFrame ExplicitClient::nextPiece() const noexcept {
  FixedBytes<kCanDataLength> bytes;
  ByteWriter<kCanDataLength> writer{bytes};
  writer.u8(header(fragmented(), xid_));
  if (fragmented()) {
    writer.u8(fragment().byte());
    writer.append(ByteView{body_}.sub(offset_, kPerFragment));
  } else {
    writer.append(ByteView{body_});
  }
  return dataFrame(requestId(), bytes);
}

bool ExplicitClient::pollTransmit(CanFrame& frame, Instant now) noexcept {
  gave_acknowledge_ = acknowledge_.has_value();
  if (acknowledge_) {
    frame = *acknowledge_;
    acknowledge_.reset();
    return true;
  }
  if (phase_ != Phase::kToSend) return false;
  frame = nextPiece();
  to_send_until_ = *timers_.at(Timer::kReply);
  now_ = now;
  if (!fragmented() || (offset_ + kPerFragment >= body_.size() && asked_ == 0)) ++asked_;
  phase_ = fragmented() ? Phase::kAwaitAcknowledge : Phase::kAwaitAnswer;
  timers_.set(Timer::kReply, now + (fragmented() ? kAcknowledgeTime : timeout_));
  return true;
}

void ExplicitClient::notSent(const CanFrame& frame) noexcept {
  if (gave_acknowledge_) {
    acknowledge_ = frame;
  } else if (phase_ == Phase::kAwaitAcknowledge || phase_ == Phase::kAwaitAnswer) {
    phase_ = Phase::kToSend;
    timers_.set(Timer::kReply, to_send_until_);
    if (asked_ > 0) --asked_;
  }
}

Heard ExplicitClient::handle(const CanFrame& frame, Instant now) noexcept {
  const ByteView bytes = frame.bytes();
  if (bytes.size() < 2) return Heard::kMalformed;
  if ((bytes[0] & explicit_header::kMac) != own_) return Heard::kForeign;
  const bool xid = (bytes[0] & explicit_header::kTransaction) != 0;
  now_ = now;
  if ((bytes[0] & explicit_header::kFragmented) == 0)
    return awaitsAnswer(xid) ? handleBody(bytes.sub(1), xid) : late(bytes[1], xid);
  // Neither an acknowledge nor a part of a message is empty.
  if (bytes.size() < 3) return Heard::kMalformed;
  const Fragment fragment = Fragment::from(bytes[1]);
  return fragment.type == FragmentType::kAcknowledge ? handleAcknowledge(xid, fragment, bytes.sub(2), now)
                                                     : handleFragment(xid, fragment, bytes.sub(2), now);
}

Heard ExplicitClient::handleAcknowledge(bool xid, Fragment acknowledged, ByteView data, Instant now) noexcept {
  if (data.size() != 1) return Heard::kMalformed;
  const bool repeating = phase_ == Phase::kToSend && repeats_ > 0 && fragmented();
  const bool waits = phase_ == Phase::kAwaitAcknowledge || repeating;
  if (!waits || xid != xid_ || acknowledged.count != fragment().count) return Heard::kStale;
  if (data[0] != kAccepted) {
    finish(ExplicitEnd::kTooLong);
    return Heard::kTaken;
  }
  repeats_ = 0;
  if (offset_ + kPerFragment >= body_.size()) {
    phase_ = Phase::kAwaitAnswer;
  } else {
    offset_ += kPerFragment;
    count_ = acknowledged.nextCount();
    phase_ = Phase::kToSend;
  }
  timers_.set(Timer::kReply, now + timeout_);
  return Heard::kTaken;
}

Heard ExplicitClient::handleFragment(bool xid, Fragment received, ByteView data, Instant now) noexcept {
  // What allocates or releases is answered within one frame: whatever else comes does not prolong the wait for it.
  const bool awaited = awaitsAnswer(xid) && port_ == ExplicitPort::kConnected;
  switch (receiver_.handle(xid, received, data, awaited)) {
    case ExplicitReceiver::Result::kStray:
      return Heard::kStale;
    case ExplicitReceiver::Result::kRepeated:
      acknowledge(xid, received, kAccepted);
      return Heard::kStale;
    case ExplicitReceiver::Result::kTooLong:
      acknowledge(xid, received, kTooMuchData);
      finish(ExplicitEnd::kTooLong);
      return Heard::kTaken;
    case ExplicitReceiver::Result::kAccepted:
      acknowledge(xid, received, kAccepted);
      comeFurther(now);
      return Heard::kTaken;
    case ExplicitReceiver::Result::kComplete:
      break;
  }
  acknowledge(xid, received, kAccepted);
  return handleBody(ByteView{receiver_.body()}, xid);
}

// A device that begins its answer anew gets no new time before it has come further than ever: otherwise one that never
// comes to an end would keep the connection from everybody for ever.
void ExplicitClient::comeFurther(Instant now) noexcept {
  phase_ = Phase::kReceiving;
  if (receiver_.body().size() <= furthest_) return;
  furthest_ = receiver_.body().size();
  timers_.set(Timer::kReply, now + kFragmentTime);
}

/// From the service code on.
Heard ExplicitClient::handleBody(ByteView body, bool xid) noexcept {
  if ((body[0] & service::kResponse) == 0) return Heard::kMalformed;
  ExplicitAnswer answer;
  if (body[0] == (service::kError | service::kResponse)) {
    if (body.size() != 3) return Heard::kMalformed;
    answer.general = body[1];
    answer.additional = body[2];
    answer_ = answer;
    finish(ExplicitEnd::kRefused);
    return Heard::kTaken;
  }
  if (body[0] != (body_[0] | service::kResponse)) return late(body[0], xid);
  for (const std::uint8_t byte : body.sub(1)) {
    if (answer.data.push_back(byte)) continue;
    finish(ExplicitEnd::kTooLong);
    return Heard::kTaken;
  }
  answer_ = answer;
  finish(ExplicitEnd::kDone);
  return Heard::kTaken;
}

void ExplicitClient::acknowledge(bool xid, Fragment received, std::uint8_t status) noexcept {
  const Fragment back{FragmentType::kAcknowledge, received.count};
  const std::array<std::uint8_t, 3> bytes{header(true, xid), back.byte(), status};
  acknowledge_ = dataFrame(requestId(), bytes);
}

void ExplicitClient::poll(Instant now) noexcept {
  now_ = now;
  if (!timers_.takeDue(Timer::kReply, now)) return;
  // A request that the link never took is not repeated. A reset must not be done twice.
  const bool asked = phase_ == Phase::kAwaitAcknowledge || (phase_ == Phase::kAwaitAnswer && !fragmented());
  if (!asked || repeats_ > 0 || body_[0] == service::kReset) return finish(ExplicitEnd::kTimedOut);
  ++repeats_;
  ++repeated_;
  phase_ = Phase::kToSend;
  timers_.set(Timer::kReply, now + timeout_);
}

void ExplicitClient::finish(ExplicitEnd end) noexcept {
  remember(end != ExplicitEnd::kTimedOut, now_);
  phase_ = Phase::kIdle;
  timers_.stopAll();
  receiver_.reset();
  if (!answer_) answer_ = ExplicitAnswer{};
  answer_->id = id_;
  answer_->end = end;
  answer_->may_be_late = shares_xid_ && end != ExplicitEnd::kTimedOut;
}

std::optional<ExplicitAnswer> ExplicitClient::takeAnswer() noexcept {
  const std::optional<ExplicitAnswer> answer = answer_;
  answer_.reset();
  return answer;
}

}  // namespace nord_driver::devicenet
