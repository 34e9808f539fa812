#include "transport/interbus/interbus_parameters.h"

#include <algorithm>

#include "transport/interbus/pcp_refusal.h"

namespace nord_driver {

using interbus::PcpAnswer;
using interbus::PcpInvocation;
using interbus::PcpResult;
using interbus::PcpService;
using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterShape;

namespace {

constexpr unsigned kLastSubIndex = 255;
constexpr unsigned kMostInitiations = 2;  // of one access
// How long after the end of an access the gateway may still confirm its service: its own time-out is in no document, and
// this is meant to be longer.
constexpr std::chrono::seconds kLongestService{30};

// BU 0070 does not say what sub-index sets and elements have; taken from CANopen, whose objects are numbered alike
// (BU 0060 p. 61): counted from 1, sets fastest. Of arrays without sets that manual says two things (p. 54 and p. 61).
unsigned subIndexOf(const ParameterRequest& request, const PcpDrive& drive) noexcept {
  switch (request.shape) {
    case ParameterShape::kPlain:
      return 0;
    case ParameterShape::kPerSet:
      return request.parameter_set;
    case ParameterShape::kArray:
      return drive.array_sub_by_table ? 4u * (request.index - 1u) + 1u : request.index;
    case ParameterShape::kArrayPerSet:
      return 4u * (request.index - 1u) + request.parameter_set;
  }
  return 0;
}

Word turned(Word word, bool swapped) noexcept {
  return swapped ? static_cast<Word>(word << 8 | word >> 8) : word;
}

}  // namespace

InterbusParameters::InterbusParameters(const PcpMap& map, const std::vector<PcpDrive>& drives) : map_(map) {
  for (const PcpDrive& drive : drives) {
    drives_.emplace_back();
    drives_.back().how = drive;
    drives_.back().initiated = !map.initiate;
  }
}

bool InterbusParameters::submit(std::size_t drive, const ParameterRequest& request) noexcept {
  if (!drives_[drive].requests.submit(request)) return false;
  if (running_ != drive) skipUnserved(drives_[drive]);
  return true;
}

// What no device need be asked for is answered here.
void InterbusParameters::skipUnserved(DriveQueue& drive) noexcept {
  while (!drive.requests.empty()) {
    const ParameterRequest& request = drive.requests.front();
    if (request.action == ParameterAction::kWriteRam) {
      drive.requests.refuse(ParameterReason::kNotSupported, "PCP has no write that spares the EEPROM");
    } else if (subIndexOf(request, drive.how) > kLastSubIndex) {
      drive.requests.refuse(ParameterReason::kNoSuchElement, "no sub-index reaches this array element");
    } else {
      return;
    }
  }
}

bool InterbusParameters::startNext(Instant now) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const std::size_t drive = (next_ + i) % drives_.size();
    if (drives_[drive].requests.empty()) continue;
    running_ = drive;
    next_ = drive + 1;
    plain_ = false;
    initiations_ = 0;
    trouble_.clear();
    deadline_ = now + map_.timeout;
    if (under_way_) phase_ = late_ ? Phase::kLate : Phase::kClear;
    leaveOrder();
    return true;
  }
  return false;
}

// An order that belongs to nobody, or hangs in a connection that hangs, is not waited for: the next one takes its place.
// But one that invokes, because its answer tells whether its service can be in the gateway at all.
void InterbusParameters::leaveOrder() noexcept {
  under_way_ = foreign_ = under_way_ && invoking_ && late_;
}

PcpInvocation InterbusParameters::invocation() const noexcept {
  const DriveQueue& drive = drives_[*running_];
  const ParameterRequest& request = drive.requests.front();
  PcpInvocation order;
  order.reference = drive.how.reference;
  order.service = PcpService::kInitiate;
  if (!drive.initiated) return order;
  order.index = static_cast<std::uint16_t>(interbus::kFirstParameterObject + request.number);
  order.sub_index = static_cast<std::uint8_t>(plain_ ? 0 : subIndexOf(request, drive.how));
  order.service = PcpService::kRead;
  if (request.action == ParameterAction::kRead) return order;
  order.service = PcpService::kWrite;
  // Values are 16 bits wide but for positions (BU 0050 p. 42).
  order.length = request.double_word ? 4 : 2;
  order.value = static_cast<std::uint32_t>(request.raw);
  return order;
}

link::RegisterOrder InterbusParameters::write(const PcpInvocation& invocation) const noexcept {
  link::RegisterOrder order;
  order.write = true;
  order.registers = {map_.invoke_address, static_cast<std::uint16_t>(blockWords(map_.invoke))};
  order.values = toBlock(invocation, map_.invoke);
  for (Word& word : order.values) word = turned(word, map_.swapped);
  return order;
}

link::RegisterOrder InterbusParameters::read() const noexcept {
  link::RegisterOrder order;
  order.input_registers = map_.result_in_input_registers;
  order.registers = {map_.result_address, static_cast<std::uint16_t>(blockWords(map_.result))};
  return order;
}

std::optional<link::RegisterOrder> InterbusParameters::pollOrder(Instant now) noexcept {
  if (running_ && now >= deadline_) giveUp();
  // Without a request only what was invoked is cleared: who asks nothing writes nothing.
  if (!running_ && !startNext(now) && (!invoked_ || !trouble_.empty())) return std::nullopt;
  if (late_ && now >= late_until_ && (foreign_ || !under_way_)) forgetLate();
  if (under_way_) return std::nullopt;
  under_way_ = true;
  invoking_ = false;
  switch (phase_) {
    case Phase::kClear:
      return write({});
    case Phase::kInvoke:
      if (running_) {
        invocation_ = invocation();
        if (invocation_.service == PcpService::kInitiate) ++initiations_;
        invoked_ = invoking_ = true;
        return write(invocation_);
      }
      [[fallthrough]];
    case Phase::kLate:
    case Phase::kCleared:
    case Phase::kConfirmed:
      break;
  }
  return read();
}

void InterbusParameters::giveUp() noexcept {
  DriveQueue& drive = drives_[*running_];
  Sentence text;
  if (!trouble_.empty()) {
    text = trouble_;
  } else if (phase_ == Phase::kLate) {
    text.format("PCP service %04Xh of the access before was not confirmed yet (communication reference %u)",
                static_cast<unsigned>(late_->service), unsigned{late_->reference});
  } else if (phase_ == Phase::kClear || phase_ == Phase::kCleared) {
    text.format("its gateway goes on showing the PCP result before it (register %u)",
                map_.result_address + map_.result.service);
  } else {
    text.format("PCP service %04Xh was not confirmed within %.1f s (communication reference %u)",
                static_cast<unsigned>(invocation_.service), toSeconds(map_.timeout), drive.how.reference);
  }
  drive.initiated = !map_.initiate;
  drive.requests.fail(ParameterOutcome::kTimeout, text);
  endUnconfirmed();
  leaveOrder();
}

void InterbusParameters::end() noexcept {
  if (running_) skipUnserved(drives_[*running_]);
  running_.reset();
  phase_ = Phase::kClear;
}

// A confirmation names the service and the drive, not the parameter: that of a service the gateway still has would be
// taken for the next one's. A connection that is initiated anew begins behind it.
void InterbusParameters::endUnconfirmed() noexcept {
  const bool invoked = phase_ == Phase::kConfirmed || (phase_ == Phase::kInvoke && under_way_ && invoking_);
  if (invoked && !map_.initiate) {
    late_ = invocation_;
    late_until_ = deadline_ + kLongestService;
  }
  end();
  if (late_) phase_ = Phase::kLate;
}

void InterbusParameters::forgetLate() noexcept {
  late_.reset();
  leaveOrder();
  phase_ = Phase::kClear;
}

void InterbusParameters::handleAnswer(const link::RegisterAnswer& answer) noexcept {
  if (!under_way_) return;
  under_way_ = false;
  if (foreign_) {
    foreign_ = false;
    if (invoking_ && answer.not_taken && late_) forgetLate();  // it never left
    return;
  }
  if (!answer.good) {
    trouble_ = answer.text;
    // Whether a write came through is not known, so it is not repeated: only the deadline ends it. One that a busy gateway
    // has refused, or that never left, did not.
    if (phase_ == Phase::kInvoke && !answer.not_taken) phase_ = Phase::kConfirmed;
    return;
  }
  if (phase_ == Phase::kClear) {
    trouble_.clear();
    phase_ = Phase::kCleared;
  } else if (phase_ == Phase::kInvoke) {
    trouble_.clear();
    if (running_) phase_ = Phase::kConfirmed;
  } else {
    interbus::PcpBlock block = answer.values;
    for (Word& word : block) word = turned(word, map_.swapped);
    handleResult(fromBlock(block, map_.result));
  }
}

void InterbusParameters::handleResult(const PcpResult& result) noexcept {
  if (phase_ == Phase::kLate) {
    if (answerTo(*late_, result) != PcpAnswer::kNotYet) forgetLate();
    return;
  }
  if (phase_ == Phase::kCleared) {
    if (result.service != 0) return;
    phase_ = Phase::kInvoke;
    invoked_ = false;
    return;
  }
  if (!running_) return;
  switch (answerTo(invocation_, result)) {
    case PcpAnswer::kNotYet:
      return;
    case PcpAnswer::kAborted:
      return handleAbort();
    case PcpAnswer::kHere:
      return handleConfirmation(result);
  }
}

void InterbusParameters::handleConfirmation(const PcpResult& result) noexcept {
  DriveQueue& drive = drives_[*running_];
  phase_ = Phase::kClear;  // whatever comes next
  if (invocation_.service == PcpService::kInitiate) {
    drive.initiated = result.good();
    if (result.good() || initiations_ < kMostInitiations) return;
    refuseConnection(result.error);
  } else if (result.good()) {
    takeValue(result);
  } else if (fallBack(result.error) || repeat(result.error)) {
    return;
  } else if (isLost(result.error) && drive.requests.front().action != ParameterAction::kRead) {
    // It may have been lost behind the write.
    drive.requests.fail(ParameterOutcome::kTimeout, pcpSentence(result.error));
  } else {
    drive.requests.refuse(reasonOfPcp(result.error, drive.requests.front()), pcpSentence(result.error));
  }
  end();
}

void InterbusParameters::handleAbort() noexcept {
  DriveQueue& drive = drives_[*running_];
  drive.initiated = !map_.initiate;
  const Sentence text = "its PCP connection was aborted";
  if (invocation_.service == PcpService::kWrite) {
    drive.requests.fail(ParameterOutcome::kTimeout, text);  // the write may have been done before
  } else {
    drive.requests.refuse(ParameterReason::kNotNow, text);
  }
  end();
}

// Another attempt may be granted: the device, or the gateway, may hold an earlier connection still. It is a refusal, not
// silence: what decides motion may be told later, and is waited for. A write has surely not been done.
void InterbusParameters::refuseConnection(const interbus::PcpError& error) noexcept {
  DriveQueue& drive = drives_[*running_];
  Sentence text;
  text.format("its PCP connection (communication reference %u) was refused: %s", drive.how.reference,
              pcpSentence(error).c_str());
  drive.requests.refuse(ParameterReason::kNotNow, text);
}

// A connection that is gone is initiated again, and a read asked for again behind that.
bool InterbusParameters::repeat(const interbus::PcpError& error) noexcept {
  if (!isLost(error)) return false;
  DriveQueue& drive = drives_[*running_];
  drive.initiated = !map_.initiate;
  const bool read = drive.requests.front().action == ParameterAction::kRead;
  return read && map_.initiate && initiations_ < kMostInitiations;
}

// As on PKW: a parameter without sets may be read without one, and so may the first element of what older firmware has
// as a plain parameter (P700: BU 0020 8).
bool InterbusParameters::fallBack(const interbus::PcpError& error) noexcept {
  const ParameterRequest& request = drives_[*running_].requests.front();
  const bool wrong_sub_index = error.error_class == 6 && error.code == 5 && error.additional == 0x11;
  if (plain_ || !wrong_sub_index || request.action != ParameterAction::kRead) return false;
  const bool first = request.shape == ParameterShape::kPerSet || request.index == 1;
  if (request.shape == ParameterShape::kPlain || !first) return false;
  plain_ = true;
  return true;
}

void InterbusParameters::takeValue(const PcpResult& result) noexcept {
  profile::ParameterQueue& requests = drives_[*running_].requests;
  if (requests.front().action != ParameterAction::kRead) return requests.done(requests.front().raw);
  if (result.length == 1 || result.length == 2 || result.length == 4) {
    // Whether a 16 bit word is signed only the parameter's own description knows.
    return requests.done(static_cast<std::int32_t>(result.value));
  }
  Sentence text;
  text.format("the PCP result is %u bytes long, which no parameter's value is", result.length);
  requests.refuse(ParameterReason::kUnreadable, text);
}

void InterbusParameters::handleOffline(std::size_t drive) noexcept {
  drives_[drive].initiated = !map_.initiate;
  drives_[drive].requests.failAll(ParameterOutcome::kOffline);
  if (running_ != drive) return;
  foreign_ = under_way_;
  endUnconfirmed();
}

}  // namespace nord_driver
