// doc/parameters.md: the meaning of each key from doc/parameters.yaml; its kind, unit, range and default from the code that
// reads it, by letting it read the configurations of a file (configurations.yaml).
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>
#include <vector>

#include "documents/key_records.h"

namespace nord_driver::documents {

/// By the transport as users write it ("profibus_dp").
using RecordsByTransport = std::map<std::string, KeyRecords>;

/// Lets the node and its transport read each configuration once as it is, and once at another cycle rate: what changes
/// then is no constant. Throws ConfigError when one is refused.
RecordsByTransport readAll(const YAML::Node& configurations);

struct Document {
  std::string text;                   ///< Markdown
  std::vector<std::string> problems;  ///< a sentence for each key that the two sides do not agree on
};

/// `meanings`: doc/parameters.yaml; its head says how it is written.
Document makeDocument(const YAML::Node& meanings, const RecordsByTransport& records);

/// The document of the project in `folder`.
Document documentOf(const std::string& folder);

}  // namespace nord_driver::documents
