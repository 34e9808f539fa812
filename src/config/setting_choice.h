// A setting that is one of some words, each standing for a value.
#pragma once

#include <cstddef>
#include <string>

#include "config/setting_checks.h"

namespace nord_driver {

template <typename Value>
struct Choice {
  const char* word;
  Value value;
};

/// The value of the word at `key`, or `fallback` when it is absent. Throws ConfigError naming all words when it is none
/// of them.
template <typename Value, std::size_t N>
Value choiceOr(const Settings& settings, const std::string& key, Value fallback, const Choice<Value> (&choices)[N]) {
  std::string words, usual;
  for (const auto& choice : choices) {
    words += (words.empty() ? "" : ", ") + std::string(choice.word);
    if (usual.empty() && choice.value == fallback) usual = choice.word;
  }
  const std::string word = wordOr(settings, key, usual, words);
  if (word == usual) return fallback;  // also where no word stands for it
  for (const auto& choice : choices) {
    if (word == choice.word) return choice.value;
  }
  throw wrongSetting(settings, key, "\"" + word + "\"", "one of " + words);
}

}  // namespace nord_driver
