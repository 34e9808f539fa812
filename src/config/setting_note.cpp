#include "config/setting_note.h"

namespace nord_driver {

void noteSetting(const Settings& settings, const std::string& key, const SettingNote& note) {
  if (const auto* const listener = dynamic_cast<const SettingListener*>(&settings)) listener->listen(key, note);
}

}  // namespace nord_driver
