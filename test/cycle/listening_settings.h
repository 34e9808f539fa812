// Settings that keep what their readers say of each key.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/setting_note.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {

class ListeningSettings final : public Settings, public SettingListener {
 public:
  explicit ListeningSettings(const test::MapSettings& values) : values_{values} {}

  bool has(const std::string& key) const override { return values_.has(key); }
  std::optional<double> number(const std::string& key) const override { return values_.number(key); }
  std::optional<std::int64_t> integer(const std::string& key) const override { return values_.integer(key); }
  std::optional<bool> boolean(const std::string& key) const override { return values_.boolean(key); }
  std::optional<std::string> text(const std::string& key) const override { return values_.text(key); }
  std::optional<std::vector<std::string>> texts(const std::string& key) const override { return values_.texts(key); }
  std::vector<std::string> keys() const override { return values_.keys(); }
  std::string fullName(const std::string& key) const override { return values_.fullName(key); }
  void listen(const std::string& key, const SettingNote& note) const override { notes_[key] = note; }

  /// "a number, 0.01 to 100 m, default 1"; "nothing": no reader has said anything of it.
  std::string noteOf(const std::string& key) const {
    const auto at = notes_.find(key);
    if (at == notes_.end()) return "nothing";
    const SettingNote& note = at->second;
    std::string text = note.kind;
    if (!note.range.empty()) text += ", " + note.range;
    if (!note.unit.empty()) text += " " + note.unit;
    if (!note.fallback.empty()) text += ", default " + note.fallback;
    return text;
  }

 private:
  test::MapSettings values_;
  mutable std::map<std::string, SettingNote> notes_;
};

}  // namespace nord_driver::cycle
