#include "sim/profibus/record_server.h"

namespace nord_driver::sim {

namespace {

// Function numbers and errors of DP-V1 (EN 50170-8; a negative response has bit 7 set).
constexpr std::uint8_t kRead = 0x5E;
constexpr std::uint8_t kWrite = 0x5F;
constexpr std::uint8_t kNegative = 0x80;
constexpr std::uint8_t kErrorDpv1 = 0x80;  // Error_Decode
constexpr std::uint8_t kFeatureNotSupported = 0xA9;
constexpr std::uint8_t kInvalidIndex = 0xB0;
constexpr std::uint8_t kWriteLength = 0xB1;
constexpr std::uint8_t kInvalidSlot = 0xB2;
constexpr std::uint8_t kStateConflict = 0xB5;

constexpr std::size_t kHeader = 4;  // function, slot, index, length
constexpr std::uint8_t kPkwBytes = 8;
constexpr std::uint8_t kFirstIndex = 100;

constexpr unsigned kLabelMask = 0xF000;
constexpr unsigned kNumberMask = 0x07FF;
constexpr unsigned kNumberOffset = 1000;
constexpr Word kReadWithoutWrite = 9;  // "... or at acyclic access a READ without a WRITE before it" (BU 0220 7.2.3.1)

RecordServer::Pdu refused(std::uint8_t function, std::uint8_t code) noexcept {
  return {static_cast<std::uint8_t>(function | kNegative), kErrorDpv1, code, 0};
}

/// The same number, 1000 higher or lower; a number that has no place there becomes none at all.
Word shifted(Word pke, bool up) noexcept {
  const unsigned number = pke & kNumberMask;
  const unsigned moved = up ? number + kNumberOffset : number < kNumberOffset ? 0u : number - kNumberOffset;
  return static_cast<Word>((pke & kLabelMask) | (moved > kNumberMask ? 0u : moved));
}

}  // namespace

std::optional<RecordServer::Pdu> RecordServer::handle(ByteView request) noexcept {
  if (!request.empty()) {
    response_ = respond(request);
    outstanding_ = true;
    polls_left_ = settings_.polls;
    return std::nullopt;
  }
  if (!outstanding_) return std::nullopt;
  if (polls_left_ > 0) {
    --polls_left_;
    return std::nullopt;
  }
  outstanding_ = false;
  return response_;
}

void RecordServer::reset() noexcept {
  outstanding_ = false;
  answers_ = {};
  busy_left_ = {};
  read_refusals_ = {};
  identification_.reset();
}

RecordServer::Pdu RecordServer::respond(ByteView request) noexcept {
  const std::uint8_t function = request[0];
  if ((function != kRead && function != kWrite) || request.size() < kHeader) {
    return refused(function, kFeatureNotSupported);
  }
  const std::uint8_t slot = request[1];
  const std::uint8_t index = request[2];
  if (index == IdentificationRecords::kIndex) return identify(request);
  if (settings_.by_slot ? slot == 0 || slot > kDevices : slot != 0) return refused(function, kInvalidSlot);
  const std::optional<unsigned> device = deviceOf(slot, index);
  if (!device) return refused(function, kInvalidIndex);
  return function == kWrite ? write(*device, request) : read(*device, request);
}

// I&M: the call is written, its answer read (PROFIBUS profile guideline, part 1).
RecordServer::Pdu RecordServer::identify(ByteView request) noexcept {
  Pdu response;
  ByteWriter<Pdu::capacity()> writer{response};
  if (request[0] == kWrite) {
    const ByteView data = request.sub(kHeader);
    if (request[3] != data.size()) return refused(kWrite, kWriteLength);
    if (const auto code = identification_.write(data)) return refused(kWrite, *code);
    writer.append(request.sub(0, kHeader));
    return response;
  }
  const auto data = identification_.read();
  if (!data) return refused(kRead, kStateConflict);
  const ByteView wanted = ByteView{*data}.sub(0, request[3]);
  writer.append(request.sub(0, 3));
  writer.u8(static_cast<std::uint8_t>(wanted.size()));
  writer.append(wanted);
  return response;
}

std::optional<unsigned> RecordServer::deviceOf(std::uint8_t slot, std::uint8_t index) const noexcept {
  if (settings_.by_slot) return slot - 1u;
  if (index < kFirstIndex || index >= kFirstIndex + kDevices) return std::nullopt;
  return static_cast<unsigned>(index - kFirstIndex);
}

// The order of the record is carried out, its answer waits for a read: BU 0220 8.3.4.4.
RecordServer::Pdu RecordServer::write(unsigned device, ByteView request) noexcept {
  if (request[3] != kPkwBytes || request.size() != kHeader + kPkwBytes) return refused(kWrite, kWriteLength);
  ByteReader reader{request.sub(kHeader)};
  PkwWords order;
  order.pke = reader.u16be();
  order.ind = reader.u16be();
  order.pwe1 = reader.u16be();
  order.pwe2 = reader.u16be();
  if (settings_.plain_numbers) order.pke = shifted(order.pke, true);
  if (const auto code = devices_.recordRefusal(device, order, false)) return refused(kWrite, *code);
  PkwWords answer = devices_.executeRecord(device, order);
  if (settings_.plain_numbers) answer.pke = shifted(answer.pke, false);
  answers_[device] = answer;
  read_refusals_[device] = devices_.recordRefusal(device, order, true);
  busy_left_[device] = settings_.busy;
  Pdu response;
  for (const std::uint8_t byte : request.sub(0, kHeader)) response.push_back(byte);
  return response;
}

RecordServer::Pdu RecordServer::read(unsigned device, ByteView request) noexcept {
  if (busy_left_[device] > 0) {
    --busy_left_[device];
    return refused(kRead, kStateConflict);
  }
  if (read_refusals_[device]) return refused(kRead, *read_refusals_[device]);
  PkwWords answer;
  answer.pke = 0x7000;
  answer.pwe2 = kReadWithoutWrite;
  if (answers_[device]) answer = *answers_[device];
  answers_[device].reset();
  Pdu data;
  ByteWriter<Pdu::capacity()> words{data};
  words.u16be(answer.pke);
  words.u16be(answer.ind);
  words.u16be(answer.pwe1);
  words.u16be(answer.pwe2);
  if (data.size() > request[3]) data.resize(request[3]);  // the length asked for is the longest wanted
  Pdu response;
  ByteWriter<Pdu::capacity()> writer{response};
  writer.append(request.sub(0, 3));
  writer.u8(static_cast<std::uint8_t>(data.size()));
  writer.append(data);
  return response;
}

}  // namespace nord_driver::sim
