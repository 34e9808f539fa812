// A configuration that writes down what it is asked for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/setting_note.h"
#include "config/tree_settings.h"
#include "documents/key_records.h"

namespace nord_driver::documents {

class RecordingSettings final : public TreeSettings, public SettingListener {
 public:
  /// The node's group; those below it write into the same `records`, which outlive them.
  RecordingSettings(const TreeSettings& settings, KeyRecords& records);

  bool has(const std::string& key) const override;
  std::optional<double> number(const std::string& key) const override;
  std::optional<std::int64_t> integer(const std::string& key) const override;
  std::optional<bool> boolean(const std::string& key) const override;
  std::optional<std::string> text(const std::string& key) const override;
  std::optional<std::vector<std::string>> texts(const std::string& key) const override;
  std::optional<std::vector<std::string>> words(const std::string& key) const override;
  std::optional<std::vector<double>> numbers(const std::string& key) const override;
  std::shared_ptr<TreeSettings> group(const std::string& key) const override;
  void listen(const std::string& key, const SettingNote& note) const override;

 private:
  enum class Place { kNode, kDrives, kInside };

  RecordingSettings(const TreeSettings& settings, KeyRecords& records, Place place, Group group);
  KeyRecord& recordOf(const std::string& key) const;
  void ask(const std::string& key, const char* kind) const;

  KeyRecords& records_;
  Place place_ = Place::kNode;
  Group group_ = Group::kNode;
};

}  // namespace nord_driver::documents
