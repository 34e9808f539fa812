#include "process_campaign/process_scenario.h"

#include <algorithm>
#include <iomanip>
#include <iterator>
#include <sstream>

#include "support/dice.h"

namespace nord_driver::test {

namespace {

/// Where an act works: two of one place are never on at the same time.
enum class Place { kUser, kDriver, kPower, kTerminals, kAnswers, kParameters };

struct Kind {
  ProcessAct act;
  const char* name;
  unsigned weight;
  Place place;
  double least, most;  // s it lasts; 0, 0: it is done at once
  int from, to;        // of amount
};

constexpr Kind kKinds[] = {
    {ProcessAct::kDrive, "drive", 0, Place::kUser, 0.0, 0.0, -100, 100},
    {ProcessAct::kSilence, "silence", 0, Place::kUser, 0.0, 0.0, 0, 0},
    {ProcessAct::kEnable, "enable", 0, Place::kUser, 0.0, 0.0, 0, 0},
    {ProcessAct::kDisable, "disable", 2, Place::kUser, 0.0, 0.0, 0, 0},
    {ProcessAct::kQuickStop, "quick_stop", 2, Place::kUser, 0.0, 0.0, 0, 0},
    {ProcessAct::kAcknowledge, "acknowledge", 2, Place::kUser, 0.0, 0.0, 0, 0},
    {ProcessAct::kHold, "hold", 4, Place::kDriver, 0.01, 2.0, 0, 0},
    {ProcessAct::kKill, "kill", 3, Place::kDriver, 0.05, 1.5, 0, 0},
    {ProcessAct::kEnd, "end", 2, Place::kDriver, 0.05, 1.0, 0, 0},
    {ProcessAct::kUnplug, "unplug", 3, Place::kPower, 0.1, 1.5, 0, 0},
    {ProcessAct::kPowerOff, "power_off", 3, Place::kPower, 0.1, 1.5, 0, 0},
    {ProcessAct::kLinkCut, "link_cut", 2, Place::kPower, 0.1, 1.5, 0, 0},
    {ProcessAct::kMute, "mute", 3, Place::kAnswers, 0.02, 1.5, 0, 0},
    {ProcessAct::kLocalControl, "local_control", 3, Place::kTerminals, 0.1, 1.5, 0, 0},
    {ProcessAct::kTrip, "trip", 4, Place::kPower, 0.0, 1.5, 10, 209},
    {ProcessAct::kCoast, "coast", 2, Place::kTerminals, 0.1, 1.0, 0, 0},
    {ProcessAct::kLateAnswers, "late_answers", 2, Place::kAnswers, 0.1, 1.0, 1, 20},
    {ProcessAct::kSilentParameters, "silent_parameters", 1, Place::kParameters, 0.2, 1.5, 0, 0},
};

const Kind& kindOf(ProcessAct act) {
  return *std::find_if(std::begin(kKinds), std::end(kKinds), [act](const Kind& kind) { return kind.act == act; });
}

const Kind& drawKind(Dice& dice) {
  unsigned sum = 0;
  for (const Kind& kind : kKinds) sum += kind.weight;
  unsigned roll = dice.below(sum);
  for (const Kind& kind : kKinds) {
    if (roll < kind.weight) return kind;
    roll -= kind.weight;
  }
  return kKinds[0];
}

bool overlaps(const ProcessEvent& event, const std::vector<ProcessEvent>& others) {
  const Place place = kindOf(event.act).place;
  return place != Place::kUser && std::any_of(others.begin(), others.end(), [&](const ProcessEvent& other) {
           const bool here = kindOf(other.act).place == place && (place == Place::kDriver || other.left == event.left);
           return here && event.at <= other.at + other.span && other.at <= event.at + event.span;
         });
}

ProcessEvent eventOf(ProcessAct act, double at, int amount = 0, int extra = 0) {
  ProcessEvent event;
  event.act = act;
  event.at = at;
  event.amount = amount;
  event.extra = extra;
  return event;
}

}  // namespace

ProcessScenario makeProcessScenario(std::uint32_t seed, double scale) {
  Dice dice{seed};
  ProcessScenario scenario;
  scenario.seed = seed;
  scenario.length = 3.0 + dice.from(0.0, 2.0);
  auto& events = scenario.events;
  events.push_back(eventOf(ProcessAct::kEnable, 0.0));
  for (double at = 0.2; at < scenario.length; at += dice.from(0.3, 1.2)) {
    const bool silent = dice.below(8) == 0;
    events.push_back(silent ? eventOf(ProcessAct::kSilence, at)
                            : eventOf(ProcessAct::kDrive, at, dice.from(-100, 100), dice.from(-100, 100)));
  }
  const unsigned blows = 1 + dice.below(3);
  for (unsigned i = 0; i < blows; ++i) {
    const double when = dice.from(0.3, scenario.length - 0.5);
    const unsigned at_once = 1 + dice.below(2);
    for (unsigned k = 0; k < at_once; ++k) {
      const Kind& kind = drawKind(dice);
      ProcessEvent event = eventOf(kind.act, when + dice.from(0.0, 0.06), dice.from(kind.from, kind.to));
      event.span = dice.from(kind.least, kind.most);
      event.left = dice.below(2) == 0;
      // A fault whose cause is gone at once is one of two.
      if (kind.act == ProcessAct::kTrip && dice.below(2) == 0) event.span = 0.0;
      if (!overlaps(event, events)) events.push_back(event);
    }
  }
  // A second try, when what struck first may be over.
  if (dice.below(2) == 0) {
    const double again = 0.6 * scenario.length;
    events.push_back(eventOf(ProcessAct::kAcknowledge, again));
    events.push_back(eventOf(ProcessAct::kEnable, again + 0.4));
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const ProcessEvent& a, const ProcessEvent& b) { return a.at < b.at; });
  scenario.length *= scale;
  for (ProcessEvent& event : events) {
    event.at *= scale;
    event.span *= scale;
  }
  return scenario;
}

const char* toString(ProcessAct act) noexcept {
  return kindOf(act).name;
}

std::string toText(const ProcessEvent& event) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << event.at << '+' << event.span << ' ' << toString(event.act) << ' '
      << (event.left ? "left " : "right ") << event.amount << ' ' << event.extra;
  return out.str();
}

std::string toText(const ProcessScenario& scenario) {
  std::ostringstream out;
  out << "seed " << scenario.seed << ", " << std::fixed << std::setprecision(2) << scenario.length << " s";
  for (const ProcessEvent& event : scenario.events) out << "; " << toText(event);
  return out.str();
}

}  // namespace nord_driver::test
