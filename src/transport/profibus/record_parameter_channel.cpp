#include "transport/profibus/record_parameter_channel.h"

#include "transport/profibus/record_refusal.h"

namespace nord_driver {

namespace {

constexpr std::uint8_t kFirstIndex = 100;  // 100 module, 101 to 104 inverters (BU 0220 4.2.1)
// "4 bytes" and "four words" stand in one section (BU 0220 8.3.4.4): it is the PKW, eight bytes.
constexpr std::uint8_t kLength = 8;
constexpr unsigned kPnuMask = 0x07FF, kPnuOffset = 1000;
constexpr Word kReadWithoutOrder = 9;  // PKW error: a READ came without a WRITE before it (BU 0220 7.2.3.1)
// A unit may be busy with "no order" for so long; the rest of the time for an answer is left to the order.
constexpr Duration kBusyTime = std::chrono::seconds{1};

/// Moves the parameter number in a PKE, where the unit counts from 0.
Word shifted(Word pke, bool down) noexcept {
  const unsigned number = pke & kPnuMask;
  const unsigned moved = down ? number - kPnuOffset : number + kPnuOffset;
  return static_cast<Word>((pke & ~kPnuMask) | (moved & kPnuMask));
}

unsigned numberIn(const profile::PkwWords& words) noexcept {
  return words[0] & kPnuMask;
}
unsigned labelIn(const profile::PkwWords& words) noexcept {
  return unsigned{words[0]} >> 12;
}

/// An error by its parameter alone: no manual says whether it carries the index of its order.
bool mayAnswer(const profile::PkwWords& order, const profile::PkwWords& answer) noexcept {
  if (numberIn(order) != numberIn(answer)) return false;
  return labelIn(answer) == static_cast<unsigned>(profile::AnswerLabel::kError) || order[1] == answer[1];
}

std::optional<profile::PkwWords> recordWords(ByteView data) noexcept {
  if (data.size() != kLength) return std::nullopt;
  ByteReader reader{data};
  profile::PkwWords words{};
  for (Word& word : words) word = reader.u16be();
  return words;
}

}  // namespace

RecordParameterChannel::RecordParameterChannel(std::uint8_t unit, RecordAddressing addressing, Duration answer_timeout)
    : unit_(unit), addressing_(addressing), pkw_(answer_timeout) {}

profibus::RecordRequest RecordParameterChannel::address() const noexcept {
  profibus::RecordRequest request;
  request.slot = addressing_.by_slot ? static_cast<std::uint8_t>(unit_ + 1) : std::uint8_t{0};
  request.index = static_cast<std::uint8_t>(kFirstIndex + unit_);
  return request;
}

std::optional<profibus::RecordRequest> RecordParameterChannel::pollRecord(Instant now) noexcept {
  if (under_way_) return std::nullopt;
  order_ = pkw_.pollWords(now);
  if (order_ == profile::PkwWords{}) {
    // Between two orders: the others' turn. Nothing stands in a unit that is written to once: the pause is over at
    // once, and where the next order needs one, takes its own.
    step_ = Step::kPause;
    pkw_.handleWords({}, now);
    return std::nullopt;
  }
  if (step_ == Step::kPause) {
    step_ = mayBeMistaken() ? Step::kTakeBack : Step::kWrite;
    busy_end_ = now + kBusyTime;
  }
  under_way_ = true;
  forgotten_ = false;
  return nextRecord();
}

profibus::RecordRequest RecordParameterChannel::nextRecord() noexcept {
  profibus::RecordRequest request = address();
  request.write = step_ == Step::kTakeBack || step_ == Step::kWrite;
  if (step_ == Step::kWrite) {
    unanswered_ = order_;
    ByteWriter<profibus::kMaxRecordLength> writer{request.data};
    writer.u16be(addressing_.number_offset ? order_[0] : shifted(order_[0], true));
    for (std::size_t i = 1; i < order_.size(); ++i) writer.u16be(order_[i]);
  } else if (request.write) {
    request.data.resize(kLength);
  } else {
    request.length = kLength;
  }
  return request;
}

// Equal orders, a read of what was written, and every order for a parameter whose last answer was an error; the answer
// to an order that was given up may come still.
bool RecordParameterChannel::mayBeMistaken() const noexcept {
  const bool awaited = unanswered_ != profile::PkwWords{} && numberIn(unanswered_) == numberIn(order_);
  return awaited || mayAnswer(order_, last_answer_);
}

void RecordParameterChannel::handleRecord(const profibus::RecordResult& result, Instant now,
                                          const Sentence& words) noexcept {
  under_way_ = false;
  if (forgotten_) return;
  switch (result.outcome) {
    case profibus::RecordOutcome::kDone:
      return handleDone(result.data, now);
    case profibus::RecordOutcome::kRefused:
      if (handleRefusal(result.error, now)) return;
      break;
    case profibus::RecordOutcome::kTimedOut:
      if (result.error.isBusy() && goOnToWrite(refusalText(result.error))) return;
      pkw_.handleFailure(profile::ParameterOutcome::kTimeout,
                         result.error.isBusy() ? refusalText(result.error) : words);
      break;
    case profibus::RecordOutcome::kNoAnswer:
      pkw_.handleFailure(profile::ParameterOutcome::kTimeout, words);
      break;
    case profibus::RecordOutcome::kNotSupported:
      fail(profile::ParameterOutcome::kNoChannel, "its bus module takes no acyclic requests (DP-V1)");
      break;
    case profibus::RecordOutcome::kNotActivated:
      if (!words.empty()) {
        fail(profile::ParameterOutcome::kNoChannel, words);
        break;
      }
      fail(profile::ParameterOutcome::kNoChannel,
           "its bus module refuses acyclic requests (DP-V1): it answers RS, not activated, at access "
           "point 51; PPO types 1 and 2 reach the inverter's parameters without them");
      break;
    case profibus::RecordOutcome::kOffline:
      if (words.empty()) {
        pkw_.handleOffline(now);
      } else {  // a connection that ended, not the station: the requests behind this one open another
        pkw_.handleFailure(profile::ParameterOutcome::kOffline, words);
      }
      break;
  }
  step_ = Step::kPause;
}

/// True when it goes on all the same.
bool RecordParameterChannel::handleRefusal(const profibus::RecordError& error, Instant now) noexcept {
  if (step_ == Step::kWrite) unanswered_ = {};
  if ((!error.isBusy() || now >= busy_end_) && goOnToWrite({})) return true;
  if (error.isBusy()) {  // not taken: the same once more, until the time for an answer is over
    pkw_.explainWait(refusalText(error));
    return true;
  }
  if (mayBeCarriedOut()) {
    fail(profile::ParameterOutcome::kTimeout, refusalText(error));
  } else {
    pkw_.handleRefusal(reasonOf(error), refusalText(error));
  }
  return false;
}

/// While an answer is taken back: "no order" is not taken, or no answer is shown that could be mistaken. The order itself
/// is next. `why`: told if the time for an answer is over by now.
bool RecordParameterChannel::goOnToWrite(const Sentence& why) noexcept {
  if (step_ != Step::kTakeBack && step_ != Step::kAwaitNone) return false;
  forgetAnswers();
  pkw_.explainWait(why);
  step_ = Step::kWrite;
  return true;
}

/// The order was taken, and what is refused is to tell what became of it.
bool RecordParameterChannel::mayBeCarriedOut() const noexcept {
  return step_ == Step::kRead && profile::isWrite(static_cast<profile::OrderLabel>(labelIn(order_)));
}

void RecordParameterChannel::fail(profile::ParameterOutcome outcome, const Sentence& words) noexcept {
  pkw_.handleFailure(mayBeCarriedOut() ? profile::ParameterOutcome::kTimeout : outcome, words);
}

void RecordParameterChannel::handleDone(ByteView data, Instant now) noexcept {
  switch (step_) {
    case Step::kPause:
      break;
    case Step::kTakeBack:
      step_ = Step::kAwaitNone;
      pkw_.explainWait("DP-V1: the answer to the order before is repeated, though there is no order any more (AK 0)");
      break;
    case Step::kAwaitNone:
      handleNone(data);
      break;
    case Step::kWrite:
      step_ = Step::kRead;
      pkw_.explainWait({});
      break;
    case Step::kRead:
      handleAnswer(data, now);
      break;
  }
}

// "No answer", or an error that names no parameter: it is the one to "no order". A read without an order may name the last
// one's parameter; where the last answer was just that, nobody could tell whether it is repeated.
void RecordParameterChannel::handleNone(ByteView data) noexcept {
  const auto words = recordWords(data);
  if (!words) return;  // read again
  const bool none = labelIn(*words) == static_cast<unsigned>(profile::AnswerLabel::kNone);
  const bool error = labelIn(*words) == static_cast<unsigned>(profile::AnswerLabel::kError);
  const bool no_order = error && (*words)[3] == kReadWithoutOrder && inOurNumbers(*words) != last_answer_;
  if (none || no_order || numberIn(*words) == 0) goOnToWrite({});
}

profile::PkwWords RecordParameterChannel::inOurNumbers(profile::PkwWords words) const noexcept {
  if (!addressing_.number_offset && words[0] != 0) words[0] = shifted(words[0], false);
  return words;
}

void RecordParameterChannel::handleAnswer(ByteView data, Instant now) noexcept {
  const auto words = recordWords(data);
  if (!words) return;  // no answer: read again
  last_answer_ = inOurNumbers(*words);
  if (mayAnswer(unanswered_, last_answer_)) unanswered_ = {};
  pkw_.handleWords(last_answer_, now);
}

void RecordParameterChannel::forgetAnswers() noexcept {
  last_answer_ = {};
  unanswered_ = {};
}

void RecordParameterChannel::handleOffline(Instant now, const Sentence& why) noexcept {
  pkw_.handleOffline(now, why);
  step_ = Step::kPause;
  forgotten_ = under_way_;
}

}  // namespace nord_driver
