#include "transport/profibus/record_parameter_channel.h"

#include "transport/profibus/record_refusal.h"

namespace nord_driver {

namespace {

constexpr std::uint8_t kFirstIndex = 100;  // 100 module, 101 to 104 inverters (BU 0220 4.2.1)
// "4 bytes" and "four words" stand in one section (BU 0220 8.3.4.4): it is the PKW, eight bytes.
constexpr std::uint8_t kLength = 8;
constexpr unsigned kPnuMask = 0x07FF, kPnuOffset = 1000;

/// Moves the parameter number in a PKE, where the unit counts from 0.
Word shifted(Word pke, bool down) noexcept {
  const unsigned number = pke & kPnuMask;
  const unsigned moved = down ? number - kPnuOffset : number + kPnuOffset;
  return static_cast<Word>((pke & ~kPnuMask) | (moved & kPnuMask));
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
    // once.
    written_ = {};
    pkw_.handleWords({}, now);
    return std::nullopt;
  }
  profibus::RecordRequest request = address();
  request.write = order_ != written_;
  if (request.write) {
    ByteWriter<profibus::kMaxRecordLength> writer{request.data};
    writer.u16be(addressing_.number_offset ? order_[0] : shifted(order_[0], true));
    for (std::size_t i = 1; i < order_.size(); ++i) writer.u16be(order_[i]);
  } else {
    request.length = kLength;
  }
  under_way_ = true;
  forgotten_ = false;
  return request;
}

void RecordParameterChannel::handleRecord(const profibus::RecordResult& result, Instant now,
                                          const Sentence& words) noexcept {
  under_way_ = false;
  if (forgotten_) return;
  switch (result.outcome) {
    case profibus::RecordOutcome::kDone:
      if (result.write) {
        written_ = order_;
      } else {
        handleAnswer(result.data, now);
      }
      return;
    case profibus::RecordOutcome::kRefused:
      if (result.error.isBusy()) {  // not taken: the same once more, until the time for an answer is over
        pkw_.explainWait(refusalText(result.error));
        return;
      }
      pkw_.handleRefusal(reasonOf(result.error), refusalText(result.error));
      break;
    case profibus::RecordOutcome::kTimedOut:
      pkw_.handleFailure(profile::ParameterOutcome::kTimeout,
                         result.error.isBusy() ? refusalText(result.error) : words);
      break;
    case profibus::RecordOutcome::kNoAnswer:
      pkw_.handleFailure(profile::ParameterOutcome::kTimeout, words);
      break;
    case profibus::RecordOutcome::kNotSupported:
      pkw_.handleFailure(profile::ParameterOutcome::kNoChannel, "its bus module takes no acyclic requests (DP-V1)");
      break;
    case profibus::RecordOutcome::kNotActivated:
      if (!words.empty()) {
        pkw_.handleFailure(profile::ParameterOutcome::kNoChannel, words);
        break;
      }
      pkw_.handleFailure(profile::ParameterOutcome::kNoChannel,
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
  written_ = {};
}

void RecordParameterChannel::handleAnswer(ByteView data, Instant now) noexcept {
  if (data.size() != kLength) return;  // no answer: read again
  ByteReader reader{data};
  profile::PkwWords words{};
  for (Word& word : words) word = reader.u16be();
  if (!addressing_.number_offset && words[0] != 0) words[0] = shifted(words[0], false);
  pkw_.handleWords(words, now);
}

void RecordParameterChannel::handleOffline(Instant now) noexcept {
  pkw_.handleOffline(now);
  written_ = {};
  forgotten_ = under_way_;
}

}  // namespace nord_driver
