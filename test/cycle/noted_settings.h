// Settings that listen: what a reader says of its keys, as doc/parameters.md has it.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "config/setting_note.h"
#include "config/tree_settings.h"

namespace nord_driver::test {

class NotedSettings final : public TreeSettings, public SettingListener {
 public:
  NotedSettings(const std::string& prefix, SettingValue values) : TreeSettings{prefix, std::move(values)} {}

  void listen(const std::string& key, const SettingNote& note) const override { notes_[key] = note; }
  /// "one of a, b; range; fallback": the parts that are not empty; "" where nothing was said.
  std::string note(const std::string& key) const {
    const auto found = notes_.find(key);
    if (found == notes_.end()) return "";
    std::string text = found->second.kind;
    for (const std::string& part : {found->second.range, found->second.unit, found->second.fallback}) {
      if (!part.empty()) text += "; " + part;
    }
    return text;
  }

 private:
  mutable std::map<std::string, SettingNote> notes_;
};

}  // namespace nord_driver::test
