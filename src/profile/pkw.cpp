#include "profile/pkw.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint16_t kPnuOffset = 1000;  // P000..P999 are PNU 1000..1999 (BU 2700 6.5.1.1)
constexpr Word kPnuMask = 0x07FF;           // bit 11 is SPM, not supported

bool answerLabelFits(OrderLabel order, std::uint8_t answer) noexcept {
  const auto is = [answer](AnswerLabel label) { return answer == static_cast<std::uint8_t>(label); };
  switch (order) {
    case OrderLabel::kNone:
      return is(AnswerLabel::kNone);
    // Both widths in every PPO that has a parameter channel: PPO 1 carries 32 bits too, and PPO 4 none at all (the
    // manuals' "only with PPO 2 and 4" errs).
    case OrderLabel::kRead:
      return is(AnswerLabel::kWord) || is(AnswerLabel::kDouble);
    case OrderLabel::kReadArray:
      return is(AnswerLabel::kArrayWord) || is(AnswerLabel::kArrayDouble);
    case OrderLabel::kWriteWord:
    case OrderLabel::kWriteWordRam:
      return is(AnswerLabel::kWord);
    case OrderLabel::kWriteDouble:
    case OrderLabel::kWriteDoubleRam:
      return is(AnswerLabel::kDouble);
    case OrderLabel::kWriteArrayWord:
    case OrderLabel::kWriteArrayWordRam:
      return is(AnswerLabel::kArrayWord);
    case OrderLabel::kWriteArrayDouble:
    case OrderLabel::kWriteArrayDoubleRam:
      return is(AnswerLabel::kArrayDouble);
    case OrderLabel::kReadArrayLength:
      return is(AnswerLabel::kArrayLength);
  }
  return false;
}

}  // namespace

Word pkwIndex(ParameterShape shape, std::uint8_t set, std::uint8_t element) noexcept {
  const unsigned set_part = (set - 1u) & 3u;
  const unsigned element_part = element - 1u;
  switch (shape) {
    case ParameterShape::kPlain:
      return 0;
    case ParameterShape::kPerSet:
      return static_cast<Word>(set_part << 8);
    case ParameterShape::kArray:
      return static_cast<Word>((element_part & 0xFFu) << 8);
    case ParameterShape::kArrayPerSet:
      return static_cast<Word>((element_part & 0x3Fu) << 10 | set_part << 8);
  }
  return 0;
}

PkwWords toWords(const PkwOrder& order) noexcept {
  if (order.label == OrderLabel::kNone) return {};
  const auto pke = static_cast<unsigned>(order.label) << 12 | ((order.number + unsigned{kPnuOffset}) & kPnuMask);
  const auto value = static_cast<std::uint32_t>(order.value);
  return {static_cast<Word>(pke), order.index, static_cast<Word>(value >> 16), static_cast<Word>(value & 0xFFFFu)};
}

PkwAnswer toAnswer(const PkwWords& words) noexcept {
  PkwAnswer answer;
  answer.label = static_cast<std::uint8_t>(words[0] >> 12);
  answer.pnu = words[0] & kPnuMask;
  answer.index = words[1];
  const bool both = answer.label == static_cast<std::uint8_t>(AnswerLabel::kDouble) ||
                    answer.label == static_cast<std::uint8_t>(AnswerLabel::kArrayDouble) || words[2] == 0xFFFF;
  const std::uint32_t high = both ? words[2] : 0u;
  answer.value = static_cast<std::int32_t>(high << 16 | words[3]);
  if (answer.label == static_cast<std::uint8_t>(AnswerLabel::kError)) answer.error_number = words[3];
  return answer;
}

bool isWrite(OrderLabel label) noexcept {
  switch (label) {
    case OrderLabel::kNone:
    case OrderLabel::kRead:
    case OrderLabel::kReadArray:
    case OrderLabel::kReadArrayLength:
      return false;
    default:
      return true;
  }
}

bool isDoubleWord(OrderLabel label) noexcept {
  return label == OrderLabel::kWriteDouble || label == OrderLabel::kWriteArrayDouble ||
         label == OrderLabel::kWriteDoubleRam || label == OrderLabel::kWriteArrayDoubleRam;
}

bool answers(const PkwOrder& order, const PkwAnswer& answer) noexcept {
  if (order.label == OrderLabel::kNone) return false;
  if (answer.pnu != order.number + kPnuOffset) return false;
  // No manual says whether an error carries the index of its order: it is not asked for.
  if (answer.label == static_cast<std::uint8_t>(AnswerLabel::kError)) return true;
  if (!answerLabelFits(order.label, answer.label) || answer.index != order.index) return false;
  if (!isWrite(order.label)) return true;
  const std::uint32_t mask = isDoubleWord(order.label) ? 0xFFFFFFFFu : 0xFFFFu;
  return (static_cast<std::uint32_t>(answer.value) & mask) == (static_cast<std::uint32_t>(order.value) & mask);
}

}  // namespace nord_driver::profile
