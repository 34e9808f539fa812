#include "devicenet/duplicate_mac.h"

#include "devicenet/identifier.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::devicenet {
namespace {

constexpr std::size_t kLength = 7;
constexpr std::uint8_t kResponse = 0x80;
constexpr Duration kSilence = std::chrono::seconds{1};

}  // namespace

std::optional<DuplicateMacMessage> readDuplicateMac(const CanFrame& frame) noexcept {
  if (frame.remote || frame.size != kLength) return std::nullopt;
  ByteReader reader{frame.bytes()};
  DuplicateMacMessage message;
  message.response = (reader.u8() & kResponse) != 0;
  message.sender.vendor_id = reader.u16le();
  message.sender.serial_number = reader.u32le();
  return message;
}

CanFrame duplicateMacFrame(std::uint8_t mac, const DuplicateMacMessage& message) noexcept {
  FixedBytes<kLength> bytes;
  ByteWriter<kLength> writer{bytes};
  writer.u8(message.response ? kResponse : 0);
  writer.u16le(message.sender.vendor_id);
  writer.u32le(message.sender.serial_number);
  return dataFrame(identifier(Group2::kDuplicateMac, mac), bytes);
}

void DuplicateMacCheck::restart() noexcept {
  timers_.stopAll();
  request(State::kFirst);
}

void DuplicateMacCheck::stop() noexcept {
  timers_.stopAll();
  due_.reset();
  state_ = State::kOff;
}

void DuplicateMacCheck::request(State state) noexcept {
  state_ = state;
  due_ = duplicateMacFrame(mac_, {false, own_});
}

void DuplicateMacCheck::handle(const DuplicateMacMessage& message, Instant now) noexcept {
  if (state_ == State::kOff || state_ == State::kCommFault) return;
  if (state_ == State::kOnline && !message.response) {
    due_ = duplicateMacFrame(mac_, {true, own_});
    return;
  }
  rival_ = message.sender;
  due_.reset();
  timers_.stopAll();
  timers_.set(Timer::kAgain, now + pause_);
  state_ = State::kCommFault;
}

void DuplicateMacCheck::poll(Instant now) noexcept {
  if (timers_.takeDue(Timer::kAgain, now)) restart();
  if (!timers_.takeDue(Timer::kSilence, now)) return;
  if (state_ == State::kFirst) {
    request(State::kSecond);
  } else {
    state_ = State::kOnline;
  }
}

bool DuplicateMacCheck::pollTransmit(CanFrame& frame, Instant now) noexcept {
  if (!due_) return false;
  frame = *due_;
  due_.reset();
  if (state_ != State::kOnline) timers_.set(Timer::kSilence, now + kSilence);
  return true;
}

void DuplicateMacCheck::notSent(const CanFrame& frame) noexcept {
  due_ = frame;
  timers_.stop(Timer::kSilence);
}

}  // namespace nord_driver::devicenet
