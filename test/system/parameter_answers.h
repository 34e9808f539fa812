// What a user is told of an access to a parameter, over the whole stack below ROS.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "catalogue/parameter_access.h"
#include "catalogue/shipped.h"
#include "system/driven_robot.h"

namespace nord_driver::test {

struct Access {
  std::uint16_t number = 0;
  std::uint8_t index = 0;
  std::optional<double> value = std::nullopt;  ///< to be written, to RAM; nothing: it is read
};

/// As the services do it, of the first drive: from the manual's numbers to the answer; "done: " before one that is good.
inline std::string answerTo(DrivenRobot& robot, const Access& access) {
  cycle::Request request;
  request.drive = 0;
  request.kind = access.value ? cycle::RequestKind::kWriteParameter : cycle::RequestKind::kReadParameter;
  const catalogue::DriveCatalogue known{catalogue::shippedCatalogues(), robot.config().drives[0].series, {}};
  catalogue::ParameterAccess made = catalogue::accessTo({access.number, 0, access.index}, known);
  std::string refused = made.error;
  if (refused.empty() && access.value) refused = catalogue::setValue(made, {*access.value, false, true});
  if (!refused.empty()) return "nothing was asked: " + refused;
  request.parameter = made.request;
  const cycle::Completion answer = robot.ask(request);
  return (answer.success ? "done: " : "") + answer.message.str();
}

/// Its words of at least four letters, in small letters.
inline std::set<std::string> wordsOf(const std::string& text) {
  std::set<std::string> words;
  std::string word;
  for (const char letter : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    } else {
      if (word.size() >= 4) words.insert(word);
      word.clear();
    }
  }
  return words;
}

/// `told` has the code as `code` writes it, and behind it a meaning that shares a word with what the file says of it.
inline ::testing::AssertionResult tells(const std::string& told, const std::string& code,
                                        const catalogue::FaultEntry& entry) {
  const std::size_t at = told.find(code);
  if (at == std::string::npos) return ::testing::AssertionFailure() << "no \"" << code << "\" in: " << told;
  const std::set<std::string> meaning = wordsOf(told.substr(at + code.size()));
  std::string file = entry.name.value_or("") + " " + entry.cause.value_or("");
  for (const std::uint32_t number : entry.stands_for) {
    const catalogue::FaultEntry* same = catalogue::shippedFaults().find(catalogue::FaultCodes::kPkw, number);
    if (same != nullptr) file += " " + same->name.value_or("") + " " + same->cause.value_or("");
  }
  const std::set<std::string> expected = wordsOf(file);
  const bool shared = std::any_of(expected.begin(), expected.end(),
                                  [&meaning](const std::string& word) { return meaning.count(word) > 0; });
  if (shared) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "the file means \"" << file << "\" by it; told is: " << told;
}

/// Two or more hexadecimal digits.
inline std::string inHex(std::uint32_t number, std::size_t digits) {
  std::string text;
  for (; digits > 0; --digits) text += "0123456789ABCDEF"[number >> 4 * (digits - 1) & 0xFu];
  return text;
}

}  // namespace nord_driver::test
