#include "sim/profibus/simulated_segment.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr std::uint64_t kSynBits = 33;                     // idle before every request (EN 50170)
constexpr std::uint64_t kMinTsdrBits = 11;                 // no answer earlier
constexpr Duration kLongestWait = std::chrono::hours(24);  // a wait without end would never return

}  // namespace

SimulatedSegment::SimulatedSegment(const SimConfig& config, const SegmentSettings& settings)
    : robot_(config),
      stations_(robot_),
      baud_rate_(config.bus.as<DpBusConfig>().baud_rate),
      tsdr_bits_(settings.tsdr_bits),
      now_(settings.start) {
  stations_.advance(now_);
}

bool SimulatedSegment::open() noexcept {
  if (!device_present_) {
    last_error_ = "simulated segment: no such device";
    return false;
  }
  last_error_.clear();
  arriving_.clear();
  open_ = true;
  return true;
}

void SimulatedSegment::close() noexcept {
  open_ = false;
  arriving_.clear();
}

void SimulatedSegment::setDevicePresent(bool present) noexcept {
  device_present_ = present;
  if (present || !open_) return;
  close();
  last_error_ = "simulated segment: the device is gone";
}

bool SimulatedSegment::write(ByteView telegram) noexcept {
  if (!open_) return false;
  const Duration length = baud_rate_.characters(telegram.size());
  const bool answering = now_ < answer_end_;  // an answer is on the line, or will be
  if (answering && answer_start_ < now_ + length) {
    if (answer_start_ <= now_) referee().broken(Rule::kCollision);
    arriving_.clear();  // both are lost
    answer_end_ = request_end_ = std::max(answer_end_, now_ + length);
    return true;
  }
  const Instant last_activity = answering ? request_end_ : std::max(answer_end_, request_end_);
  if (line_used_ && now_ - last_activity < baud_rate_.bits(kSynBits)) referee().broken(Rule::kShortPause);
  line_used_ = true;
  if (!request_pending_) request_.clear();
  for (const std::uint8_t byte : telegram) request_.push_back(byte);
  request_end_ = std::max(now_, request_pending_ ? request_end_ : now_) + length;
  request_pending_ = true;
  return true;
}

std::size_t SimulatedSegment::read(std::uint8_t* buffer, std::size_t capacity) noexcept {
  std::size_t count = 0;
  while (count < capacity && count < arriving_.size() && arriving_[count].at <= now_) {
    buffer[count] = arriving_[count].value;
    ++count;
  }
  arriving_.eraseFront(count);
  return count;
}

void SimulatedSegment::discardInput() noexcept {
  std::size_t arrived = 0;
  while (arrived < arriving_.size() && arriving_[arrived].at <= now_) ++arrived;
  arriving_.eraseFront(arrived);
}

bool SimulatedSegment::waitReadable(Instant until) noexcept {
  until = std::min(until, now_ + kLongestWait);
  for (;;) {
    if (!arriving_.empty() && arriving_[0].at <= now_) return true;
    if (now_ >= until) return false;
    Instant next = until;
    if (request_pending_) next = std::min(next, request_end_);
    if (!arriving_.empty()) next = std::min(next, arriving_[0].at);
    advanceTo(next);
  }
}

void SimulatedSegment::advanceTo(Instant when) noexcept {
  if (request_pending_ && request_end_ <= when) {
    now_ = request_end_;
    deliverRequest();
  }
  now_ = std::max(now_, when);
  stations_.advance(now_);
}

void SimulatedSegment::deliverRequest() noexcept {
  request_pending_ = false;
  stations_.advance(now_);
  if (lose_requests_ > 0 && DpStations::isAnswered(request_)) {
    --lose_requests_;
    stations_.judgeOnly(request_);
    return;
  }
  const FixedBytes<512> received = disturbed(request_, disturbance_.requests);
  if (received == request_) {
    stations_.receive(received, now_, Judge::kYes, *this);
    if (stations_.hasPartial()) referee().broken(Rule::kNoTelegram);
  } else {
    stations_.judgeOnly(request_);
    stations_.receive(received, now_, Judge::kNo, *this);
  }
  stations_.forgetPartial();  // the pause after it ends a telegram
}

void SimulatedSegment::answer(const WireBytes& bytes, Duration delay) noexcept {
  if (lose_answers_ > 0) {
    --lose_answers_;
    return;
  }
  FixedBytes<512> sent = disturbed(bytes, disturbance_.answers);
  if (spoil_answers_ > 0 && !sent.empty()) {
    --spoil_answers_;
    sent[0] = static_cast<std::uint8_t>(sent[0] ^ 0x04u);
  }
  if (tsdr_bits_ < kMinTsdrBits) referee().broken(Rule::kEarlyAnswer);
  answer_start_ = std::max(answer_end_, now_ + baud_rate_.bits(tsdr_bits_) + delay);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    arriving_.push_back({answer_start_ + baud_rate_.characters(i + 1), sent[i]});
  }
  answer_end_ = answer_start_ + baud_rate_.characters(bytes.size());  // noise is no activity of the station
  // A byte that came twice before or behind it is left out by who waits for a telegram.
  if (std::search(sent.begin(), sent.end(), bytes.begin(), bytes.end()) != sent.end()) stations_.delivered(bytes);
}

void SimulatedSegment::foreign(ByteView telegram) noexcept {
  if (!open_) return;
  const Instant start = std::max(answer_end_, now_);
  for (std::size_t i = 0; i < telegram.size(); ++i) {
    arriving_.push_back({start + baud_rate_.characters(i + 1), telegram[i]});
  }
}

bool SimulatedSegment::happens(double probability) noexcept {
  return probability > 0.0 && static_cast<double>(random_()) < probability * 4294967296.0;
}

void SimulatedSegment::setDisturbance(const Disturbance& disturbance) noexcept {
  disturbance_ = disturbance;
  random_.seed(disturbance.seed);
}

FixedBytes<512> SimulatedSegment::disturbed(ByteView bytes, bool enabled) noexcept {
  FixedBytes<512> result;
  bool turned = false;
  for (const std::uint8_t byte : bytes) {
    if (!enabled) {
      result.push_back(byte);
      continue;
    }
    if (happens(disturbance_.lose)) continue;
    const bool flip = happens(disturbance_.flip) && !(turned && disturbance_.one_bit);
    turned = turned || flip;
    result.push_back(flip ? static_cast<std::uint8_t>(byte ^ (1u << (random_() % 8u))) : byte);
    if (happens(disturbance_.duplicate)) result.push_back(result[result.size() - 1]);
  }
  return result;
}

}  // namespace nord_driver::sim
