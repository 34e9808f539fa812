#include "sim/inverter/pkw_server.h"

namespace nord_driver::sim {

namespace {

constexpr unsigned kNumberMask = 0x07FF;
constexpr unsigned kNumberOffset = 1000;  // P000-P999 are mapped to 1000-1999

constexpr Word kErrorLabel = 7;
constexpr unsigned kCountElements = 9;

/// What an order label asks for: the table of BU 2700 6.5.1.1. Labels 11 and 12 as BU 0020 7.5.1 has them (11 double
/// word, 12 word); BU 2700 prints "double word" for both, with the answers of BU 0020: a slip.
struct Order {
  bool known = false;
  bool write = false;
  bool array = false;
  bool double_word = false;
  bool ram = false;
};

Order orderOf(unsigned label) noexcept {
  switch (label) {
    case 1:
      return {true, false, false, false, false};
    case 2:
      return {true, true, false, false, false};
    case 3:
      return {true, true, false, true, false};
    case 6:
      return {true, false, true, false, false};
    case 7:
      return {true, true, true, false, false};
    case 8:
      return {true, true, true, true, false};
    case 11:
      return {true, true, true, true, true};
    case 12:
      return {true, true, true, false, true};
    case 13:
      return {true, true, false, true, true};
    case 14:
      return {true, true, false, false, true};
    default:
      return {};
  }
}

PkwWords refused(const PkwWords& order, Word error) noexcept {
  return PkwServer::refusal(order, error);
}

PkwWords refused(const PkwWords& order, ParameterError error) noexcept {
  return refused(order, static_cast<Word>(error));
}

PkwWords accepted(const PkwWords& order, unsigned label, std::int32_t value) noexcept {
  const auto bits = static_cast<std::uint32_t>(value);  // negative values: FFFF in the high word (BU 2700 6.5.1.3)
  PkwWords answer;
  answer.pke = static_cast<Word>(label << 12 | (order.pke & kNumberMask));
  answer.ind = order.ind;
  answer.pwe1 = static_cast<Word>(bits >> 16);
  answer.pwe2 = static_cast<Word>(bits & 0xFFFFu);
  return answer;
}

}  // namespace

PkwWords PkwServer::refusal(const PkwWords& order, Word error) noexcept {
  PkwWords answer;
  answer.pke = static_cast<Word>(kErrorLabel << 12 | (order.pke & kNumberMask));
  answer.ind = order.ind;
  answer.pwe2 = error;
  return answer;
}

void PkwServer::receive(const PkwWords& order) noexcept {
  if (order != order_) {
    order_ = order;
    executed_ = false;
    waiting_ = settings_.delay;
  }
  if (executed_ || silent_) return;
  if (waiting_ > 0) {
    --waiting_;
    return;
  }
  answer_ = execute(order_);
  executed_ = true;
}

void PkwServer::reset() noexcept {
  order_ = answer_ = PkwWords{};
  waiting_ = 0;
  executed_ = true;
}

PkwWords PkwServer::execute(const PkwWords& order) noexcept {
  const unsigned label = order.label();
  if (label == 0) return PkwWords{};
  const Order asked = orderOf(label);
  const unsigned pnu = order.pke & kNumberMask;
  if (refusal_ && (!refusal_->number || *refusal_->number + kNumberOffset == pnu)) {
    return refused(order, refusal_->error);
  }
  if ((!asked.known && label != kCountElements) || (asked.ram && !settings_.ram_orders)) {
    return refused(order, ParameterError::kInvalidOrder);
  }
  const ParameterDefinition* definition = pnu >= kNumberOffset ? parameters_.find(pnu - kNumberOffset) : nullptr;
  if (definition == nullptr) return refused(order, ParameterError::kInvalidNumber);
  if (label == kCountElements) {
    if (definition->elements == 0) return refused(order, ParameterError::kNoArray);
    return accepted(order, 6, definition->elements);
  }

  // The index counts only with the array labels. Set-dependent: bits 8-9 the set, bits 10-15 the element; else bits
  // 8-15 the element (6.5.1.2).
  unsigned set = 0;
  unsigned element = 0;
  if (asked.array) {
    const unsigned high = order.ind >> 8;
    if (!definition->per_set && definition->elements == 0) return refused(order, ParameterError::kNoArray);
    set = definition->per_set ? high & 0x03u : 0;
    element = definition->per_set ? high >> 2 : high;
    if (element >= (definition->elements == 0 ? 1u : definition->elements)) {
      return refused(order, ParameterError::kSubIndex);
    }
  }
  if (definition->double_word && !settings_.double_word_answers) {
    return refused(order, ParameterError::kAnswerNotPossible);
  }
  if (asked.write) {
    if (asked.double_word != definition->double_word) return refused(order, ParameterError::kDataType);
    const auto raw = static_cast<std::int32_t>(static_cast<std::uint32_t>(order.pwe1) << 16 | order.pwe2);
    // P560 is the inverter's; a bus module has none and saves what it is not told otherwise.
    const bool to_ram = asked.ram || (parameters_.find(560) != nullptr && parameters_.value(560) == 0);
    const auto error =
        parameters_.write(definition->number, set, element, raw, to_ram ? Storage::kRam : Storage::kEeprom);
    if (error) return refused(order, *error);
  }
  const unsigned word_label = asked.array ? 4u : 1u;
  return accepted(order, definition->double_word ? word_label + 1 : word_label,
                  parameters_.value(definition->number, set, element));
}

}  // namespace nord_driver::sim
