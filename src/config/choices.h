// A setting that is one word out of a few.
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

/// The value of the word under `key`; `fallback` when it is not configured. Throws ConfigError with the words there are.
template <typename Value, std::size_t N>
Value readChoice(const Settings& settings, const std::string& key, Value fallback, const Choice<Value> (&choices)[N]) {
  const auto text = settings.text(key);
  if (!text) return fallback;
  std::string words;
  for (const auto& choice : choices) {
    if (*text == choice.word) return choice.value;
    words += (words.empty() ? "" : ", ") + std::string(choice.word);
  }
  throw wrongSetting(settings, key, "\"" + *text + "\"", "one of " + words);
}

}  // namespace nord_driver
