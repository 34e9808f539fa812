// The settings of a drive behind a bus module that several drives share.
#pragma once

#include <string>
#include <vector>

#include "config/setting_note.h"
#include "nord_driver/config/settings.h"

namespace nord_driver {

/// What a drive says, and what it leaves to the others behind its module: any of them may say what is the module's, in
/// whichever order the drives are handed over.
class ModuleSettings final : public Settings, public SettingListener {
 public:
  /// Of `drives`, those that have the `address` of `own` are behind its module. Both must outlive it. Throws ConfigError
  /// where an address is none.
  ModuleSettings(const DriveSettings& own, const std::vector<DriveSettings>& drives);

  bool has(const std::string& key) const override { return of(key).has(key); }
  std::optional<double> number(const std::string& key) const override { return of(key).number(key); }
  std::optional<std::int64_t> integer(const std::string& key) const override { return of(key).integer(key); }
  std::optional<bool> boolean(const std::string& key) const override { return of(key).boolean(key); }
  std::optional<std::string> text(const std::string& key) const override { return of(key).text(key); }
  std::optional<std::vector<std::string>> texts(const std::string& key) const override { return of(key).texts(key); }
  std::vector<std::string> keys() const override { return own_.settings->keys(); }
  std::string fullName(const std::string& key) const override { return of(key).fullName(key); }
  void listen(const std::string& key, const SettingNote& note) const override {
    noteSetting(*own_.settings, key, note);
  }

  /// This drive says otherwise than the first that says it; throw what this returns.
  ConfigError differing(const std::string& key) const;

 private:
  /// The first behind the module that has the key; this drive when none does.
  const DriveSettings& firstWith(const std::string& key) const;
  const Settings& of(const std::string& key) const;

  const DriveSettings& own_;
  std::vector<const DriveSettings*> module_;  // with this one
};

}  // namespace nord_driver
