// What was heard of the keys of a configuration while the code that reads them ran.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "config/setting_note.h"

namespace nord_driver::documents {

/// Of one key, over all configurations that were read.
struct KeyRecord {
  std::set<std::string> asked_as;  ///< the kinds it was asked for without a note, as a document names them
  std::vector<SettingNote> notes;  ///< each only once
  bool was_absent = false;         ///< in a configuration that was taken all the same

  /// What was heard of it elsewhere.
  void add(const KeyRecord& other);
  /// Forgets what is known already.
  void add(const SettingNote& note);

  /// What a document says of it. A note that names its words or numbers one by one is narrower than one with a range.
  std::string values() const;    ///< "0.01 to 650 s"; empty: nobody has read it
  std::string fallback() const;  ///< "0.2 s"; empty: none
  bool valuesVary() const;       ///< with the rest of the configuration
  bool fallbackVaries() const;
  bool isRequired() const { return !was_absent && fallback().empty(); }
};

/// Where a key stands.
enum class Group { kNode, kBus, kDrive };

/// Of all configurations of one transport.
using KeyRecords = std::map<Group, std::map<std::string, KeyRecord>>;

}  // namespace nord_driver::documents
