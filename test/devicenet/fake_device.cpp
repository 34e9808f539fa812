#include "devicenet/fake_device.h"

#include <algorithm>

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

FakeDevice::Bytes word(unsigned value) {
  return {static_cast<std::uint8_t>(value & 0xFFu), static_cast<std::uint8_t>(value >> 8u)};
}

}  // namespace

FakeDevice::FakeDevice(std::uint8_t at) : mac(at) {
  attributes[{1, 1, 4}] = {1, 4};
}

void FakeDevice::belongsTo(std::uint8_t whom, std::uint8_t choice, Instant now) {
  master = whom;
  held = choice;
  explicit_at_ = now;
}

void FakeDevice::wasPolledBy(std::uint8_t whom, unsigned packet_rate, Instant now) {
  belongsTo(whom, 0x03, now);
  rate = packet_rate;
  established = true;
  io_at_ = now;
}

void FakeDevice::powerOff() {
  powered = false;
  out_.clear();
}

void FakeDevice::powerOn() {
  powered = true;
  held = 0;
  master = 0xFF;
  established = timed_out = false;
  answer_.clear();
  request_count_ = io_count_ = -1;
}

void FakeDevice::put(std::uint32_t id, const Bytes& bytes) {
  out_.push_back(dataFrame(id, bytes));
}

bool FakeDevice::next(CanFrame& frame) {
  if (unheard) out_.clear();
  if (out_.empty()) return false;
  frame = out_.front();
  out_.pop_front();
  return true;
}

void FakeDevice::receive(const CanFrame& frame, Instant now) {
  now_ = now;
  if (!powered || frame.extended || frame.remote) return;
  if (frame.id == (0x400u | mac * 8u | 6u)) return unconnected(frame, now);
  if (frame.id == (0x400u | mac * 8u | 4u)) return explicitRequest(frame, now);
  if (frame.id == (0x400u | mac * 8u | 5u)) return ioCommand(frame, now);
  if (frame.id == (0x400u | mac * 8u | 2u)) {
    if (!byChange()) violation("acknowledges what was not allocated");
    acknowledge_awaited_ = false;
  }
  if (frame.id == (0x400u | master * 8u) && (held & 4) != 0 && established) {
    if (frame.size != 8) violation("a strobe command of another length than 8");
    const bool own_bit = (frame.data[mac / 8u] >> mac % 8u & 1u) != 0;
    if (own_bit && (held & 2) != 0) violation("told to keep its last outputs, which are polled");
    strobe_at_ = now;
    ++polls;
    if (!deaf_to_io) produce(0xE);
  }
}

void FakeDevice::unconnected(const CanFrame& frame, Instant now) {
  if (deaf_to_explicit || frame.size < 4) return;
  const std::uint8_t xid = frame.data[0] & 0x40u;
  const std::uint8_t from = frame.data[0] & 0x3Fu;
  const auto reply = [&](Bytes body) {
    body.insert(body.begin(), static_cast<std::uint8_t>(xid | from));
    put(0x400u | mac * 8u | 3u, body);
  };
  const std::uint8_t service = frame.data[1];
  if (frame.data[2] != 3 || frame.data[3] != 1) return reply({0x94, 0x16, 0xFF});
  if (service == 0x0E && frame.size == 5 && frame.data[4] == 5 && tells_owner) {
    return reply({0x8E, tells_choice ? held : std::uint8_t{0}, master});
  }
  if (service == 0x4B && frame.size == 6) {
    const std::uint8_t choice = frame.data[4];
    if (frame.data[5] != from) violation("the MAC id in an allocation is not that of its header");
    if ((choice & 0x30) == 0x30) violation("change of state and cyclic together");
    if ((choice & 0x40) != 0 && (choice & 0x30) == 0) violation("acknowledge suppression alone");
    if (held != 0 && master != from) return reply({0x94, 0x02, 0x01});
    if ((held & choice & 0x3F) != 0) return reply({0x94, 0x0B, 0x02});
    if ((choice & 1) == 0 && (held & 1) == 0) {
      ++io_before_explicit;
      return reply({0x94, 0x0C, 0x02});
    }
    held = static_cast<std::uint8_t>(held | choice);
    master = from;
    allocated_last = choice;
    if ((choice & 1) != 0) explicit_at_ = now;
    if ((choice & 0x3E) != 0) {
      established = timed_out = false;
      rated_ = {};
    }
    return reply({0xCB, 0x00});
  }
  if (service == 0x4C && frame.size == 5) {
    if (held != 0 && master != from && !obeys_anybody) return reply({0x94, 0x02, 0x01});
    if ((held & frame.data[4]) == 0) return reply({0x94, 0x0B, 0x02});
    released_last = frame.data[4];
    held = static_cast<std::uint8_t>(held & ~frame.data[4]);
    if ((held & 0x3E) == 0) {
      established = timed_out = false;
      held &= 1;
    }
    if (held == 0) master = 0xFF;
    return reply({0xCC});
  }
  reply({0x94, 0x08, 0x03});
}

void FakeDevice::explicitRequest(const CanFrame& frame, Instant now) {
  if (deaf_to_explicit || (held & 1) == 0 || frame.size < 2 || (frame.data[0] & 0x3Fu) != master) return;
  explicit_at_ = now;
  const bool xid = (frame.data[0] & 0x40u) != 0;
  if ((frame.data[0] & 0x80u) == 0) {
    ++explicit_requests;
    return answer(serve({frame.data.begin() + 1, frame.data.begin() + frame.size}), xid, now);
  }
  if (frame.size < 3) return;
  const unsigned kind = frame.data[1] >> 6u, count = frame.data[1] & 0x3Fu;
  if (kind == 3) {
    if (answer_.empty() || count != (answer_count_ & 0x3Fu)) return;
    answer_offset_ += 6;
    ++answer_count_;
    answer_tries_ = 0;
    if (answer_offset_ >= answer_.size() || frame.data[2] != 0) {
      answer_.clear();
      return;
    }
    return nextAnswerFragment(now);
  }
  if (mute_acknowledges) return;
  const Bytes acknowledge{static_cast<std::uint8_t>(frame.data[0]), static_cast<std::uint8_t>(0xC0u | count), 0};
  put(0x400u | mac * 8u | 3u, acknowledge);
  if (kind == 0) {
    request_.clear();
    request_count_ = 0;
  } else if (request_count_ < 0 || count != static_cast<unsigned>(request_count_ + 1) % 64) {
    return;
  } else {
    request_count_ = static_cast<int>(count);
  }
  request_.insert(request_.end(), frame.data.begin() + 2, frame.data.begin() + frame.size);
  if (kind != 2) return;
  request_count_ = -1;
  ++explicit_requests;
  answer(serve(request_), xid, now);
}

void FakeDevice::answer(const Bytes& body, bool xid, Instant now) {
  const auto header = static_cast<std::uint8_t>((xid ? 0x40u : 0u) | master);
  if (body.size() > 7) {
    now_ = now;
    return sendFragmented(body, xid);
  }
  Bytes bytes{header};
  bytes.insert(bytes.end(), body.begin(), body.end());
  put(0x400u | mac * 8u | 3u, bytes);
}

void FakeDevice::sendFragmented(const Bytes& body, bool xid) {
  answer_ = body;
  answer_offset_ = answer_count_ = answer_tries_ = 0;
  answer_xid_ = xid;
  nextAnswerFragment(now_);
}

void FakeDevice::nextAnswerFragment(Instant now) {
  const bool last = answer_offset_ + 6 >= answer_.size();
  const unsigned kind = answer_offset_ == 0 ? 0u : last ? 2u : 1u;
  Bytes bytes{static_cast<std::uint8_t>(0x80u | (answer_xid_ ? 0x40u : 0u) | master),
              static_cast<std::uint8_t>(kind << 6u | (answer_count_ & 0x3Fu))};
  for (std::size_t i = answer_offset_; i < std::min(answer_offset_ + 6, answer_.size()); ++i)
    bytes.push_back(answer_[i]);
  put(0x400u | mac * 8u | 3u, bytes);
  answer_at_ = now;
}

FakeDevice::Bytes FakeDevice::serve(const Bytes& body) {
  if (body.size() < 4) return {0x94, 0x13, 0xFF};
  const Address address{body[1], body[2], body[3]};
  if (body[0] == 0x0E) return getAttribute(address);
  if (body[0] == 0x10) return setAttribute(address, {body.begin() + 4, body.end()});
  return {0x94, 0x08, 0xFF};
}

FakeDevice::Bytes FakeDevice::getAttribute(const Address& address) const {
  const auto found = [](const Bytes& value) {
    Bytes reply{0x8E};
    reply.insert(reply.end(), value.begin(), value.end());
    return reply;
  };
  if (address == Address{1, 1, 1}) return found(word(vendor));
  if (address == Address{1, 1, 2}) return found(word(type));
  if (address == Address{1, 1, 3}) return found(word(product));
  if (address == Address{3, 1, 5}) return found({held, master});
  if (address == Address{5, 1, 1}) return found({3});
  if (address == Address{5, 1, 9}) return found(word(explicit_rate));
  const auto [object_class, instance, attribute] = address;
  if (object_class == 5 && has(instance)) {
    if (attribute == 1) return found({static_cast<std::uint8_t>(established ? 3 : timed_out ? 4 : 1)});
    if ((attribute == 7 || attribute == 8) && !tells_sizes) return {0x94, 0x14, 0xFF};
    if (attribute == 7) return found(word(producedBy(instance)));
    if (attribute == 8) return found(word(consumedBy(instance)));
    if (attribute == 9) return found(word(rate));
  }
  const auto place = attributes.find(address);
  if (place != attributes.end()) return found(place->second);
  return {0x94, object_class == 5 ? std::uint8_t{0x16} : error, 0xFF};
}

// For change of state and cyclic, instance 2 produces the acknowledge of our data, which is of no bytes.
unsigned FakeDevice::producedBy(unsigned instance) const {
  return instance == 2 && (held & 2) == 0 ? 0 : static_cast<unsigned>(produced);
}

unsigned FakeDevice::consumedBy(unsigned instance) const {
  const std::size_t of_the_fourth = consumes_at_2 ? acknowledge_size : consumed;
  return static_cast<unsigned>(instance == 3 ? 8 : instance == 4 ? of_the_fourth : consumed);
}

FakeDevice::Bytes FakeDevice::setAttribute(const Address& address, const Bytes& data) {
  const unsigned instance = std::get<1>(address);
  if (std::get<0>(address) == 5 && has(instance) && std::get<2>(address) == 9) {
    if (data.size() != 2) return {0x94, data.size() < 2 ? std::uint8_t{0x13} : std::uint8_t{0x15}, 0xFF};
    if (keeps_rate && established) return {0x94, 0x0C, 0xFF};
    const unsigned asked = data[0] | static_cast<unsigned>(data[1]) << 8u;
    rate = (asked + rate_step - 1) / rate_step * rate_step;
    rated_[instance] = true;
    established = true;
    for (const unsigned one : {2u, 3u, 4u}) established = established && (rated_[one] || !has(one));
    timed_out = false;
    io_at_ = strobe_at_ = produced_at_ = now_;
    io_count_ = -1;
    if (!answers_rate) return {0x90};
    const Bytes told = word(rate);
    return {0x90, told[0], told[1]};
  }
  const auto place = attributes.find(address);
  if (place == attributes.end()) return {0x94, 0x0E, 0xFF};
  place->second = data;
  return {0x90};
}

void FakeDevice::ioCommand(const CanFrame& frame, Instant now) {
  if (!established) {
    if (!timed_out && powered && (held & 0x3E) == 0) violation("process data that were not allocated");
    return;
  }
  if (deaf_to_io) return;
  const Bytes bytes{frame.data.begin(), frame.data.begin() + frame.size};
  if (consumed <= 8) {
    io_ = bytes;
  } else {
    if (bytes.empty()) return violation("a fragmented message without a fragment byte");
    const unsigned kind = bytes[0] >> 6u, count = bytes[0] & 0x3Fu;
    if (kind == 0) {
      io_.clear();
      io_count_ = 0;
    } else if (io_count_ < 0 || static_cast<int>(count) != io_count_ + 1) {
      io_count_ = -1;
      return;
    } else {
      io_count_ = static_cast<int>(count);
    }
    io_.insert(io_.end(), bytes.begin() + 1, bytes.end());
    if (kind != 2 && !(kind == 0 && count == 0x3F)) return;
    io_count_ = -1;
  }
  takeOutput(now);
}

void FakeDevice::takeOutput(Instant now) {
  if (strict_about_sizes && io_.size() != consumed) {
    violation("process data of " + std::to_string(io_.size()) + " bytes, expected " + std::to_string(consumed));
  }
  output = io_;
  ++outputs;
  ++polls;
  io_at_ = now;
  if ((held & 2) != 0) produce(0xF);
  if (byChange() && (held & 0x40) == 0 && !mute_acknowledges) put(0x3C0u | mac, {});
}

void FakeDevice::produce(unsigned message) {
  Bytes bytes = input;
  bytes.resize(produced);
  ++produced_count;
  produced_at_ = now_;
  last_produced_ = input;
  fragments(message << 6u | mac, bytes);
}

void FakeDevice::fragments(std::uint32_t id, const Bytes& message) {
  if (produced <= 8) return put(id, message);
  for (std::size_t at = 0, count = 0; at < message.size(); at += 7, ++count) {
    const bool last = at + 7 >= message.size();
    const unsigned kind = at == 0 ? 0u : last ? 2u : 1u;
    Bytes bytes{static_cast<std::uint8_t>(at == 0 && last ? 0x3Fu : kind << 6u | count)};
    for (std::size_t i = at; i < std::min(at + 7, message.size()); ++i) bytes.push_back(message[i]);
    put(id, bytes);
  }
}

void FakeDevice::tick(Instant now) {
  now_ = now;
  if (!powered) return;
  if ((held & 1) != 0 && now - explicit_at_ >= milliseconds{4 * explicit_rate}) {
    held = static_cast<std::uint8_t>(held & ~1u);
    ++explicit_deaths;
    if (held == 0) master = 0xFF;
  }
  const Duration patience = milliseconds{4 * rate} + timeout_step;
  const bool unfed = (held & 0x32) != 0 && !(byChange() && consumed == 0) && now - io_at_ >= patience;
  const bool unstrobed = (held & 4) != 0 && now - strobe_at_ >= patience;
  if (established && rate > 0 && (unfed || unstrobed)) {
    established = false;
    timed_out = true;
    ++io_deaths;
  }
  if (!answer_.empty() && now - answer_at_ >= milliseconds{1000}) {
    if (answer_tries_++ > 0) {
      answer_.clear();
    } else {
      nextAnswerFragment(now);
    }
  }
  if (!established || !byChange() || deaf_to_io) return;
  const bool changed = (held & 0x10) != 0 && input != last_produced_;
  if (changed || now - produced_at_ >= milliseconds{rate}) {
    produce(0xD);
    acknowledge_awaited_ = (held & 0x40) == 0;
    repeated_ = false;
  } else if (acknowledge_awaited_ && !repeated_ && now - produced_at_ >= milliseconds{16}) {
    repeated_ = true;
    ++repeated_productions;
    produce(0xD);
  }
}

}  // namespace nord_driver::devicenet
