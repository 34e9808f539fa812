#include "tools/changed_dump.h"

#include <algorithm>

#include "tools/parameter_name.h"

namespace nord_driver::tools {

ChangedDump changedOnly(const Dump& whole, const catalogue::DriveCatalogue& known) {
  ChangedDump changed;
  changed.dump.series = whole.series;
  for (const Dump::Value& value : whole.values) {
    if (!isSetting(value.address)) continue;
    const unsigned index = std::max<unsigned>(value.address.index, 1);
    const catalogue::ParameterEntry* entry = known.find(value.address.number);
    const auto factory = entry != nullptr ? entry->defaultOf(index) : std::nullopt;
    if (!factory) {
      changed.unknown.push_back(value.address);
    } else if (entry->meant(value.raw, index) != entry->rawOf(*factory)) {
      changed.dump.values.push_back(value);
    }
  }
  return changed;
}

std::string changedText(const ChangedDump& changed, const catalogue::DriveCatalogue& known, const std::string& drive,
                        const std::string& address) {
  std::string text = "# Only what deviates from the factory setting.\n" + dumpText(changed.dump, known, drive, address);
  for (const catalogue::ParameterAddress& unknown : changed.unknown) {
    text += "# factory setting not known, not in here: " + parameterName(unknown) + "\n";
  }
  return text;
}

}  // namespace nord_driver::tools
