#include "profibus/class2_connection.h"

#include <algorithm>

namespace nord_driver::profibus {

namespace {

// A busy read is repeated for so long at least, however short the time for one response is (as on MS1).
constexpr Duration kBusyTime = std::chrono::seconds{1};
constexpr int kIdlesPerTimeout = 3;  // two signs of life may be lost

}  // namespace

bool Class2Connection::submit(const RecordRequest& request) noexcept {
  if (record_ != Record::kNone || !encodeRecord(request, pdu_)) return false;
  request_ = request;
  result_ = RecordResult{};
  result_.slave = slave_;
  result_.slot = request.slot;
  result_.index = request.index;
  result_.write = request.write;
  record_ = Record::kWaiting;
  reopened_ = false;
  timers_.stop(Timer::kBusy);
  trouble_.clear();
  if (step_ == Step::kClosed) open();
  return true;
}

std::optional<RecordResult> Class2Connection::pollResult() noexcept {
  if (record_ != Record::kEnded) return std::nullopt;
  record_ = Record::kNone;
  return result_;
}

void Class2Connection::open() noexcept {
  step_ = Step::kToInitiate;
  timers_.stop(Timer::kResponse);
  idle_to_send_ = idle_sent_ = request_under_way_ = false;
}

void Class2Connection::close() noexcept {
  finishRecord(RecordOutcome::kOffline);
  switch (step_) {
    case Step::kAwaitInitiate:
    case Step::kOpen:
      return abort(userAbortPdu());
    case Step::kToAbort:
      return;
    case Step::kClosed:
    case Step::kToInitiate:
    case Step::kAwaitGrant:  // what the resource manager grants nobody fetches: the slave ends it by its time-out
      step_ = Step::kClosed;
      return;
  }
}

bool Class2Connection::wantsTelegram(Instant now) noexcept {
  expire(now);
  if (step_ != Step::kOpen) return step_ != Step::kClosed;
  if (!recordUnderWay() && !idle_sent_ && timers_.takeDue(Timer::kIdle, now)) idle_to_send_ = true;
  return recordUnderWay() || idle_to_send_ || idle_sent_;
}

void Class2Connection::expire(Instant now) noexcept {
  if (!timers_.isOver(Timer::kResponse, now)) return;
  timers_.stop(Timer::kResponse);
  const bool opened = step_ == Step::kOpen;
  trouble_.format(opened ? "its connection of class 2 (MS2) brought no response in %.1f s, and was ended"
                         : "it opened no connection of class 2 (MS2) in %.1f s",
                  toSeconds(times_.response_timeout));
  finishRecord(RecordOutcome::kTimedOut);
  if (opened || step_ == Step::kAwaitInitiate) return abort(abortPdu(Class2Reason::kTimeOut));
  closed();
}

Class2Connection::Outgoing Class2Connection::pollTelegram(Instant now) noexcept {
  if (!timers_.isSet(Timer::kResponse) && step_ != Step::kToAbort) {
    timers_.set(Timer::kResponse, now + times_.response_timeout);
  }
  request_under_way_ = true;
  switch (step_) {
    case Step::kToInitiate:
      control_ = initiatePdu(times_.send_timeout);
      return {kResourceManagerSap, control_, false};
    case Step::kAwaitGrant:
      request_under_way_ = false;
      return {kResourceManagerSap, {}, false};
    case Step::kToAbort:
      return {server_sap_, control_, true};
    case Step::kOpen:
      if (idle_to_send_) {
        control_ = idlePdu();
        return {server_sap_, control_, false};
      }
      // An Idle that was sent is answered before a record goes out.
      if (idle_sent_ || record_ != Record::kWaiting) break;
      if (!timers_.isSet(Timer::kBusy)) timers_.set(Timer::kBusy, now + std::max(kBusyTime, times_.response_timeout));
      return {server_sap_, pdu_, false};
    case Step::kAwaitInitiate:
    case Step::kClosed:
      break;
  }
  request_under_way_ = false;
  return {server_sap_, {}, false};
}

std::optional<Instant> Class2Connection::nextDeadline() const noexcept {
  return step_ == Step::kOpen ? timers_.at(Timer::kIdle) : std::nullopt;
}

void Class2Connection::handleAnswer(const FdlAnswer& answer, Instant now) noexcept {
  if (step_ == Step::kClosed) return;  // to what was on its way when the connection was given up
  if (step_ == Step::kToAbort) return closed();
  // Every PDU it gets is a sign of life to the slave.
  if (step_ == Step::kOpen && request_under_way_)
    timers_.set(Timer::kIdle, now + times_.send_timeout / kIdlesPerTimeout);
  switch (answer.kind) {
    case FdlAnswer::Kind::kAcknowledge:
      return taken();  // to a poll: nothing yet
    case FdlAnswer::Kind::kData:
      taken();
      return handleData(answer.data, now);
    case FdlAnswer::Kind::kRefusal:
      return handleRefusal(answer.code);
  }
}

// The slave has the PDU; what it says to it is polled for.
void Class2Connection::taken() noexcept {
  if (!request_under_way_) return;
  request_under_way_ = false;
  if (step_ == Step::kToInitiate) {
    step_ = Step::kAwaitGrant;
  } else if (step_ == Step::kOpen && idle_to_send_) {
    idle_to_send_ = false;
    idle_sent_ = true;
  } else if (step_ == Step::kOpen && record_ == Record::kWaiting) {
    record_ = Record::kSent;
  }
}

void Class2Connection::handleData(ByteView pdu, Instant now) noexcept {
  if (const auto aborted = parseAbort(pdu)) {
    trouble_.format("it ended the connection of class 2 (MS2): %s", describe(*aborted).c_str());
    finishRecord(RecordOutcome::kOffline);
    return closed();
  }
  switch (step_) {
    case Step::kAwaitGrant:
      return handleGrant(pdu);
    case Step::kAwaitInitiate:
      return handleInitiated(pdu, now);
    case Step::kOpen:
      return handleOnConnection(pdu, now);
    case Step::kClosed:
    case Step::kToInitiate:
    case Step::kToAbort:
      return;
  }
}

void Class2Connection::handleGrant(ByteView pdu) noexcept {
  const auto grant = parseGrant(pdu);
  if (!grant) return;
  server_sap_ = grant->server_sap;
  step_ = Step::kAwaitInitiate;
  if (grant->min_send_timeout <= times_.send_timeout || raised_) return;
  // It would be refused with ABT_STO: once more, with the time the slave wants.
  raised_ = true;
  times_.send_timeout = grant->min_send_timeout;
  abort(abortPdu(Class2Reason::kSendTimeout));
}

void Class2Connection::handleInitiated(ByteView pdu, Instant now) noexcept {
  RecordError error;
  switch (parseInitiateAnswer(pdu, peer_, error)) {
    case InitiateAnswer::kAccepted:
      step_ = Step::kOpen;
      timers_.stop(Timer::kResponse);
      timers_.set(Timer::kIdle, now + times_.send_timeout / kIdlesPerTimeout);
      return;
    case InitiateAnswer::kRefused:
      trouble_.format("it refused a connection of class 2 (MS2): DP-V1 error %02X, %s", unsigned{error.code1},
                      meaningOf(error));
      finishRecord(RecordOutcome::kNotActivated);
      return closed();
    case InitiateAnswer::kOther:
      return;
  }
}

void Class2Connection::handleOnConnection(ByteView pdu, Instant now) noexcept {
  if (!isIdle(pdu)) {
    if (record_ == Record::kSent && !idle_sent_) handleRecord(pdu, now);
    return;
  }
  // While a record is under way: the slave is still at it.
  if (!idle_sent_) return;
  idle_sent_ = false;
  timers_.stop(Timer::kResponse);
}

void Class2Connection::handleRecord(ByteView pdu, Instant now) noexcept {
  switch (parseRecordAnswer(pdu, request_, result_)) {
    case RecordAnswer::kOther:
      return;
    case RecordAnswer::kPositive:
      return finishRecord(RecordOutcome::kDone);
    case RecordAnswer::kNegative:
      break;
  }
  if (request_.write || !result_.error.isBusy()) return finishRecord(RecordOutcome::kRefused);
  if (timers_.isOver(Timer::kBusy, now)) return finishRecord(RecordOutcome::kTimedOut);
  record_ = Record::kWaiting;
  timers_.stop(Timer::kResponse);
}

void Class2Connection::handleRefusal(ResponseCode code) noexcept {
  if (code != ResponseCode::kNotActivated) return;  // no resource for the moment: once more, until the time is over
  const bool opening = step_ == Step::kToInitiate || step_ == Step::kAwaitGrant;
  // The slave had ended the connection before it got the record: that was not carried out.
  if (step_ == Step::kOpen && request_under_way_ && record_ == Record::kWaiting && !reopened_) {
    reopened_ = true;
    return open();
  }
  if (opening) {
    trouble_ =
        "it answers RS, not activated, at access point 49: it has no acyclic connection of class 2 (MS2), or all are "
        "taken";
  } else {
    trouble_.format("it has ended the connection of class 2 (MS2): RS, not activated, at access point %u", server_sap_);
  }
  finishRecord(opening ? RecordOutcome::kNotActivated : RecordOutcome::kOffline);
  closed();
}

void Class2Connection::handleNoAnswer(Mismatch mismatch) noexcept {
  if (step_ == Step::kClosed) return;
  if (step_ == Step::kToAbort) return closed();
  drop(RecordOutcome::kNoAnswer, mismatch == Mismatch::kNone
                                     ? "it does not answer"
                                     : "its answer is garbled: two stations with this address, or a bad line");
}

void Class2Connection::drop(RecordOutcome outcome, const char* why) noexcept {
  trouble_ = why;
  finishRecord(outcome);
  step_ = Step::kClosed;
}

void Class2Connection::finishRecord(RecordOutcome outcome) noexcept {
  if (!recordUnderWay()) return;
  result_.outcome = outcome;
  record_ = Record::kEnded;
  if (step_ == Step::kOpen) timers_.stop(Timer::kResponse);
}

void Class2Connection::abort(const RecordPdu& pdu) noexcept {
  control_ = pdu;
  timers_.stop(Timer::kResponse);
  step_ = Step::kToAbort;
}

void Class2Connection::closed() noexcept {
  step_ = Step::kClosed;
  if (recordUnderWay()) open();
}

}  // namespace nord_driver::profibus
