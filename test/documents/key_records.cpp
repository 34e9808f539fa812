#include "documents/key_records.h"

#include <algorithm>

namespace nord_driver::documents {

namespace {

bool namesEach(const SettingNote& note) {
  return note.kind.compare(0, 7, "one of ") == 0;
}

// "a number" -> "number".
std::string withoutArticle(const std::string& kind) {
  return kind.compare(0, 2, "a ") == 0 ? kind.substr(2) : kind;
}

// "one of auto, off" -> "`auto`, `off`".
std::string wordsOf(const std::string& kind) {
  std::string text = "`";
  for (const char c : kind.substr(std::string("one of ").size())) text += c == ',' ? "`," : std::string(1, c);
  for (std::size_t at = text.find(", "); at != std::string::npos; at = text.find(", ", at + 3))
    text.insert(at + 2, "`");
  return text + "`";
}

std::string valuesOf(const SettingNote& note) {
  std::string text = namesEach(note) ? wordsOf(note.kind) : note.range.empty() ? withoutArticle(note.kind) : note.range;
  if (note.kind == "a whole number") text = "whole number, " + text;
  return text + (note.unit.empty() ? "" : " " + note.unit);
}

std::vector<SettingNote> narrowest(const std::vector<SettingNote>& notes) {
  std::vector<SettingNote> each;
  for (const SettingNote& note : notes) {
    if (namesEach(note)) each.push_back(note);
  }
  return each.empty() ? notes : each;
}

std::set<std::string> allValues(const KeyRecord& record) {
  std::set<std::string> texts;
  for (const SettingNote& note : narrowest(record.notes)) texts.insert(valuesOf(note));
  return texts;
}

std::set<std::string> allFallbacks(const KeyRecord& record) {
  std::set<std::string> texts;
  for (const SettingNote& note : record.notes) {
    if (!note.fallback.empty()) texts.insert(note.fallback + (note.unit.empty() ? "" : " " + note.unit));
  }
  return texts;
}

}  // namespace

std::string KeyRecord::values() const {
  if (!notes.empty()) return valuesOf(narrowest(notes).front());
  return asked_as.empty() ? "" : withoutArticle(*asked_as.begin());
}

void KeyRecord::add(const SettingNote& note) {
  const bool known = std::any_of(notes.begin(), notes.end(), [&](const SettingNote& other) {
    return other.kind == note.kind && other.range == note.range && other.unit == note.unit &&
           other.fallback == note.fallback;
  });
  if (!known) notes.push_back(note);
}

void KeyRecord::add(const KeyRecord& other) {
  asked_as.insert(other.asked_as.begin(), other.asked_as.end());
  for (const SettingNote& note : other.notes) add(note);
  was_absent = was_absent || other.was_absent;
}

std::string KeyRecord::fallback() const {
  for (const SettingNote& note : notes) {
    if (!note.fallback.empty()) return note.fallback + (note.unit.empty() ? "" : " " + note.unit);
  }
  return "";
}

bool KeyRecord::valuesVary() const {
  return allValues(*this).size() > 1;
}

bool KeyRecord::fallbackVaries() const {
  return allFallbacks(*this).size() > 1;
}

}  // namespace nord_driver::documents
