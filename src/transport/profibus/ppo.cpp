#include "transport/profibus/ppo.h"

#include "profile/process_data_order.h"

namespace nord_driver::profile {

namespace {

struct Row {
  std::uint16_t ident;
  std::uint8_t type;
  bool has_pkw;
  std::uint8_t process_words;
  FixedBytes<2> identifiers;
};

// 7531h: PPO 2 and 4 reserve six process data words, the last two unused (BU 0020 7.2).
// 0BA8h: the identifiers are the ones P182 shows, 245, 247, 241, 243 (BU 2700 7.1.4).
const Row* findRow(std::uint8_t type, std::uint16_t ident) noexcept {
  static const Row kRows[] = {
      {kIdentTechnologyUnit, 1, true, 2, {0xF3, 0xF1}},
      {kIdentTechnologyUnit, 2, true, 6, {0xF3, 0xF5}},
      {kIdentTechnologyUnit, 3, false, 2, {0xF1}},
      {kIdentTechnologyUnit, 4, false, 6, {0xF5}},
      {kIdentCu4Tu4, 1, true, 2, {0xF5}},
      {kIdentCu4Tu4, 2, true, 4, {0xF7}},
      {kIdentCu4Tu4, 3, false, 2, {0xF1}},
      {kIdentCu4Tu4, 4, false, 4, {0xF3}},
  };
  for (const Row& row : kRows) {
    if (row.type == type && row.ident == ident) return &row;
  }
  return nullptr;
}

// The word, counted from STW/ZSW = 0, of process value 0..2.
std::size_t position(const PpoLayout& layout, std::size_t value) noexcept {
  if (layout.third_before_second && value > 0) return 4 - value;
  return 1 + value;
}

}  // namespace

std::optional<PpoLayout> ppoLayout(std::uint8_t type, std::uint16_t ident, Series series) noexcept {
  const Row* row = findRow(type, ident);
  if (row == nullptr) return std::nullopt;
  PpoLayout layout;
  layout.has_pkw = row->has_pkw;
  layout.process_words = row->process_words;
  layout.process_values = row->process_words > 2 ? 3 : 1;
  layout.third_before_second = thirdBeforeSecond(series);
  layout.identifiers = row->identifiers;
  return layout;
}

PpoWords pack(const PpoLayout& layout, const PkwWords& pkw, const ProcessOutput& output) noexcept {
  PpoWords words;
  if (layout.has_pkw) {
    for (const Word word : pkw) words.push_back(word);
  }
  const std::size_t first = words.size();
  words.resize(layout.words());
  words[first] = output.control_word;
  for (std::size_t i = 0; i < layout.process_values; ++i) {
    words[first + position(layout, i)] = toWord(output.setpoints[i]);
  }
  return words;
}

bool unpack(const PpoLayout& layout, const PpoWords& words, PkwWords& pkw, ProcessInput& input) noexcept {
  if (words.size() != layout.words()) return false;
  std::size_t first = 0;
  pkw = {};
  if (layout.has_pkw) {
    for (Word& word : pkw) word = words[first++];
  }
  input = {};
  input.status_word = words[first];
  for (std::size_t i = 0; i < layout.process_values; ++i) {
    input.actual_values[i] = toSigned(words[first + position(layout, i)]);
  }
  return true;
}

}  // namespace nord_driver::profile
