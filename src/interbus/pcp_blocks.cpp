#include "interbus/pcp_blocks.h"

#include <algorithm>
#include <vector>

namespace nord_driver::interbus {

namespace {

constexpr std::uint16_t kServiceMask = 0x007F;
constexpr std::uint16_t kInitiateError = 0x000C;  // 018Ch, 808Ch
constexpr std::uint16_t kAbort = 0x000D;          // 008Dh, 018Dh
constexpr std::uint16_t kAbortIndication = 0x01AD;

struct Field {
  const char* name;
  unsigned first;
  unsigned words;
};
using Fields = std::vector<Field>;

Fields fieldsOf(const PcpInvokeLayout& layout) {
  return {{"service", layout.service, 1},     {"reference", layout.reference, 1}, {"index", layout.index, 1},
          {"sub_index", layout.sub_index, 1}, {"length", layout.length, 1},       {"data", layout.data, kDataWords}};
}

// In a negative result the additional code may stand where a positive one has its length.
Fields fieldsOf(const PcpResultLayout& layout) {
  Fields fields{{"service", layout.service, 1},
                {"reference", layout.reference, 1},
                {"error", layout.error, 1},
                {"length", layout.length, 1},
                {"data", layout.data, kDataWords}};
  if (layout.additional != layout.length && layout.additional != layout.data) {
    fields.push_back({"additional", layout.additional, 1});
  }
  return fields;
}

std::string faultOf(const Fields& fields) {
  for (const Field& field : fields) {
    if (field.first + field.words > kMostBlockWords) {
      return std::string(field.name) + ": " + std::to_string(field.first) + ", expected at most " +
             std::to_string(kMostBlockWords - field.words);
    }
    for (const Field& other : fields) {
      if (&other == &field) break;
      if (field.first >= other.first + other.words || other.first >= field.first + field.words) continue;
      return std::string(field.name) + ": " + std::to_string(field.first) + " lies in " + other.name +
             ", expected a word of its own";
    }
  }
  return {};
}

}  // namespace

unsigned blockWords(const PcpInvokeLayout& layout) noexcept {
  return std::max({layout.service, layout.reference, layout.index, layout.sub_index, layout.length,
                   layout.data + kDataWords - 1}) +
         1;
}

unsigned blockWords(const PcpResultLayout& layout) noexcept {
  return std::max({layout.service, layout.reference, layout.error, layout.additional, layout.length,
                   layout.data + kDataWords - 1}) +
         1;
}

std::string layoutFault(const PcpInvokeLayout& layout) {
  return faultOf(fieldsOf(layout));
}

std::string layoutFault(const PcpResultLayout& layout) {
  return faultOf(fieldsOf(layout));
}

PcpBlock toBlock(const PcpInvocation& invocation, const PcpInvokeLayout& layout) noexcept {
  PcpBlock block{};
  block[layout.service] = static_cast<Word>(invocation.service);
  if (invocation.service == PcpService::kNone) return block;
  block[layout.reference] = invocation.reference;
  block[layout.index] = invocation.index;
  block[layout.sub_index] = invocation.sub_index;
  block[layout.length] = static_cast<Word>(invocation.length);
  const bool wide = invocation.length == 4;
  block[layout.data] = static_cast<Word>(wide ? invocation.value >> 16 : invocation.value & 0xFFFFu);
  block[layout.data + 1] = static_cast<Word>(wide ? invocation.value & 0xFFFFu : 0u);
  return block;
}

PcpResult fromBlock(const PcpBlock& block, const PcpResultLayout& layout) noexcept {
  PcpResult result;
  result.service = block[layout.service];
  result.reference = block[layout.reference];
  result.error.error_class = static_cast<std::uint8_t>(block[layout.error] >> 8);
  result.error.code = static_cast<std::uint8_t>(block[layout.error] & 0xFFu);
  if (!result.good()) {
    result.error.additional = block[layout.additional];
    return result;
  }
  result.length = block[layout.length];
  const std::uint32_t high = block[layout.data], low = block[layout.data + 1];
  result.value = result.length == 4 ? high << 16 | low : result.length == 1 ? high >> 8 : high;
  return result;
}

PcpAnswer answerTo(const PcpInvocation& invocation, const PcpResult& result) noexcept {
  const auto asked = static_cast<std::uint16_t>(invocation.service);
  // The order itself is no confirmation: a gateway may show it until there is one.
  if (result.service == asked || result.reference != invocation.reference) return PcpAnswer::kNotYet;
  const auto number = static_cast<std::uint16_t>(result.service & kServiceMask);
  if (number == kAbort || result.service == kAbortIndication) return PcpAnswer::kAborted;
  if (number == (asked & kServiceMask)) return PcpAnswer::kHere;
  const bool refused = invocation.service == PcpService::kInitiate && number == kInitiateError;
  return refused ? PcpAnswer::kHere : PcpAnswer::kNotYet;
}

}  // namespace nord_driver::interbus
