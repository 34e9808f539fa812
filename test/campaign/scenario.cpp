#include "campaign/scenario.h"

#include <sstream>

namespace nord_driver::test {

std::string toText(const Event& event) {
  std::ostringstream out;
  out << event.at << '+' << event.span << ' ' << event.act << ' ' << event.drive << ' ' << event.amount << ' '
      << event.extra;
  return out.str();
}

std::string toText(const Scenario& scenario) {
  std::ostringstream out;
  out << "bus=" << scenario.bus << " seed=" << scenario.seed << " wheels=" << scenario.layout.wheels
      << " singles=" << scenario.layout.singles;
  if (scenario.layout.axes != 0) out << " axes=" << scenario.layout.axes;
  out << " one_module=" << scenario.layout.one_module;
  if (scenario.layout.variant != 0) out << " variant=" << scenario.layout.variant;
  out << " length=" << scenario.length;
  for (const Event& event : scenario.events) out << "; " << toText(event);
  return out.str();
}

namespace {

bool take(std::istream& in, const std::string& key, std::string& value) {
  std::string word;
  if (!(in >> word) || word.compare(0, key.size() + 1, key + "=") != 0) return false;
  value = word.substr(key.size() + 1);
  return true;
}

bool take(std::istream& in, const std::string& key, unsigned& value) {
  std::string text;
  return take(in, key, text) && static_cast<bool>(std::istringstream{text} >> value);
}

/// False when it is there and no number.
bool takeIfThere(std::istream& in, const std::string& head, const std::string& key, unsigned& value) {
  return head.find(" " + key + "=") == std::string::npos || take(in, key, value);
}

}  // namespace

std::optional<Scenario> scenarioFrom(const std::string& text) {
  std::istringstream parts{text};
  std::string head;
  if (!std::getline(parts, head, ';')) return std::nullopt;
  Scenario scenario;
  std::istringstream in{head};
  unsigned seed = 0, one_module = 0;
  if (!take(in, "bus", scenario.bus) || !take(in, "seed", seed) || !take(in, "wheels", scenario.layout.wheels) ||
      !take(in, "singles", scenario.layout.singles) || !takeIfThere(in, head, "axes", scenario.layout.axes) ||
      !take(in, "one_module", one_module) || !takeIfThere(in, head, "variant", scenario.layout.variant) ||
      !take(in, "length", scenario.length)) {
    return std::nullopt;
  }
  scenario.seed = seed;
  scenario.layout.one_module = one_module != 0;
  for (std::string part; std::getline(parts, part, ';');) {
    std::istringstream words{part};
    Event event;
    char plus = 0;
    if (!(words >> event.at >> plus >> event.span >> event.act >> event.drive >> event.amount >> event.extra) ||
        plus != '+' || event.drive >= scenario.layout.drives()) {
      return std::nullopt;
    }
    scenario.events.push_back(event);
  }
  return scenario;
}

}  // namespace nord_driver::test
