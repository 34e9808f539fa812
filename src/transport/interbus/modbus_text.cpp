#include "transport/interbus/modbus_text.h"

#include <vector>

#include "link/modbus/modbus_telegram.h"

namespace nord_driver {

namespace {

constexpr std::size_t kFunctionAt = 7, kDataAt = 8;
constexpr unsigned kReadHolding = 3, kReadInput = 4, kWrite = 16, kReadWrite = 23;
constexpr unsigned kExceptionBit = 0x80;
constexpr unsigned kHighestListed = 8;  // words that belong to no drive

unsigned u16(ByteView bytes, std::size_t at) {
  return static_cast<unsigned>(bytes[at]) << 8 | bytes[at + 1];
}

Word wordAt(ByteView values, std::size_t i) {
  return static_cast<Word>(u16(values, 2 * i));
}

std::string range(unsigned first, unsigned count) {
  return std::to_string(first) + (count > 1 ? " to " + std::to_string(first + count - 1) : "");
}

}  // namespace

std::string ModbusText::raw(const TraceRecord& record) {
  const auto content = packetContent(record.view());
  return content ? toHex(content->bytes) : toHex(record.view());
}

std::string ModbusText::operator()(const TraceRecord& record) const {
  const auto content = packetContent(record.view());
  if (!content) return "no packet of Modbus/TCP";
  if (content->at > 0) return "the rest of the telegram before it, from byte " + std::to_string(content->at) + " on";
  const ByteView bytes = content->bytes;
  if (bytes.size() <= kDataAt) return "too short for Modbus/TCP";
  const std::string number = "#" + std::to_string(u16(bytes, 0)) + " ";
  return number + (record.kind == TraceKind::kSent ? request(bytes) : answer(bytes, content->first_register));
}

std::string ModbusText::request(ByteView bytes) const {
  const unsigned function = bytes[kFunctionAt];
  if (bytes.size() < kDataAt + 4) return "a request that is too short";
  const unsigned first = u16(bytes, kDataAt), count = u16(bytes, kDataAt + 2);
  if (function == kReadHolding) return "read holding registers " + range(first, count);
  if (function == kReadInput) return "read input registers " + range(first, count);
  if (function == kWrite && bytes.size() > kDataAt + 5) {
    return "write " + range(first, count) + ": " + words(bytes.sub(kDataAt + 5), first, true);
  }
  if (function == kReadWrite && bytes.size() > kDataAt + 9) {
    const unsigned to = u16(bytes, kDataAt + 4), words_to = u16(bytes, kDataAt + 6);
    return "read " + range(first, count) + " and write " + range(to, words_to) + ": " +
           words(bytes.sub(kDataAt + 9), to, true);
  }
  return "function " + std::to_string(function);
}

std::string ModbusText::answer(ByteView bytes, unsigned first) const {
  const unsigned function = bytes[kFunctionAt];
  if ((function & kExceptionBit) != 0) {
    const unsigned code = bytes[kDataAt];
    return "function " + std::to_string(function & ~kExceptionBit) + " refused, exception " + std::to_string(code) +
           ": " + link::exceptionMeaning(code);
  }
  if (function == kWrite && bytes.size() >= kDataAt + 4) {
    return "written " + range(u16(bytes, kDataAt), u16(bytes, kDataAt + 2));
  }
  if (function == kReadHolding || function == kReadInput || function == kReadWrite) {
    return "read " + range(first, bytes[kDataAt] / 2u) + ": " + words(bytes.sub(kDataAt + 1), first, false);
  }
  return "an answer with function " + std::to_string(function);
}

// Words of drives by their names; what else there is by its value.
std::string ModbusText::words(ByteView values, unsigned first, bool written) const {
  std::string named = drives(values, first, written);
  if (!named.empty()) return named;
  std::string text;
  const std::size_t count = values.size() / 2;
  for (std::size_t i = 0; i < count && i < kHighestListed; ++i) {
    text += (i == 0 ? "" : " ") + toHexWord(wordAt(values, i));
  }
  return text + (count > kHighestListed ? " ..." : "");
}

std::string ModbusText::drives(ByteView values, unsigned first, bool written) const {
  const unsigned image = written ? config_.server.outputs.address : config_.server.inputs.address;
  if (first < image) return {};
  RegisterImage words;
  words.resize(kMostImageWords);
  const unsigned at = first - image;
  const std::size_t end = at + values.size() / 2;
  if (end > words.size()) return {};
  for (std::size_t i = at; i < end; ++i) words[i] = wordAt(values, i - at);
  std::string text;
  for (std::size_t i = 0; i < config_.drives.size(); ++i) {
    const WordRange range = written ? config_.map->outputs(i) : config_.map->inputs(i);
    if (range.first < at || range.end() > end) continue;
    const interbus::ProcessWords data = config_.map->wordsAt(range, i, words);
    const InterbusDrive& drive = config_.drives[i];
    text += (text.empty() ? "" : ", ") + drive.name + (written ? " STW " : " ZSW ") + toHexWord(data.head);
    for (unsigned value = 0; value < (drive.ppo_type == 1 ? 1u : 3u); ++value) {
      text += (written ? " SW" : " IW") + std::to_string(value + 1) + " " + toHexWord(data.values[value]);
    }
  }
  return text;
}

}  // namespace nord_driver
