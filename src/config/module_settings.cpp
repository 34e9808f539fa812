#include "config/module_settings.h"

namespace nord_driver {

ModuleSettings::ModuleSettings(const DriveSettings& own, const std::vector<DriveSettings>& drives) : own_(own) {
  const auto address = own.settings->integer("address");
  for (const DriveSettings& drive : drives) {
    if (drive.settings->integer("address") == address) module_.push_back(&drive);
  }
}

const DriveSettings& ModuleSettings::firstWith(const std::string& key) const {
  for (const DriveSettings* drive : module_) {
    if (drive->settings->has(key)) return *drive;
  }
  return own_;
}

const Settings& ModuleSettings::of(const std::string& key) const {
  return own_.settings->has(key) ? *own_.settings : *firstWith(key).settings;
}

ConfigError ModuleSettings::differing(const std::string& key) const {
  return ConfigError(own_.settings->fullName(key) + " differs from that of drive \"" + firstWith(key).name +
                     "\", expected the same: both are inverters behind one module, which has it only once");
}

}  // namespace nord_driver
