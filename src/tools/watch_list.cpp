#include "tools/watch_list.h"

#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

unsigned elementOf(const catalogue::ParameterAddress& address) {
  return address.index == 0 ? 1u : address.index;
}

// What the drives know of it: of several series one may have a name for it.
std::string labelOf(const std::vector<const catalogue::DriveCatalogue*>& known,
                    const std::vector<catalogue::ParameterAddress>& addresses) {
  for (std::size_t i = 0; i < addresses.size(); ++i) {
    const std::string name = catalogue::fullName(known[i]->find(addresses[i].number), elementOf(addresses[i]));
    if (!name.empty()) return parameterName(addresses[i]) + " " + name;
  }
  return parameterName(addresses.front());
}

}  // namespace

WatchList::WatchList(const std::vector<std::string>& parameters,
                     const std::vector<const catalogue::DriveCatalogue*>& known)
    : addresses_(known.size()) {
  for (const std::string& parameter : parameters) {
    std::vector<catalogue::ParameterAddress> row;
    for (std::size_t i = 0; i < known.size(); ++i) {
      row.push_back(findParameter(parameter, *known[i]));
      const catalogue::ParameterAccess access = catalogue::accessTo(row.back(), *known[i]);
      if (!access.error.empty()) throw UsageError(access.error);
      addresses_[i].push_back(row.back());
    }
    labels_.push_back(labelOf(known, row));
  }
}

std::string answerCell(const catalogue::ParameterAddress& address, const ParameterAnswer& answer,
                       const catalogue::DriveCatalogue& known) {
  return answer.success ? known.valueText(answer.entry, answer.raw, elementOf(address)) : answer.message;
}

}  // namespace nord_driver::tools
