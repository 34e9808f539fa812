#include "campaign/shrink.h"

#include <algorithm>

namespace nord_driver::test {

namespace {

class Shrinker {
 public:
  Shrinker(Shrunk& best, const CampaignBus& bus, const TransportWrap& wrap, unsigned most_tries)
      : best_(best), bus_(bus), wrap_(wrap), most_tries_(most_tries) {}

  bool leaveOutEvents() {
    bool any = false;
    for (std::size_t count = std::max<std::size_t>(best_.scenario.events.size() / 2, 1); count > 0; count /= 2) {
      for (std::size_t from = 0; from < best_.scenario.events.size();) {
        Scenario less = best_.scenario;
        const auto begin = less.events.begin() + static_cast<std::ptrdiff_t>(from);
        less.events.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(count, less.events.size() - from)));
        if (!shows(less)) {
          from += count;
        } else {
          any = true;
        }
      }
    }
    return any;
  }
  bool leaveOutDrives() {
    bool any = false;
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      Scenario less = best_.scenario;
      if (less.layout.axes != 0 && less.layout.drives() > 1) {
        --less.layout.axes;
        goes_on = shows(without(less, less.layout.drives()));
      }
      less = best_.scenario;
      if (!goes_on && less.layout.singles != 0 && less.layout.drives() > 1) {
        --less.layout.singles;
        goes_on = shows(without(less, less.layout.firstAxis()));
      }
      if (!goes_on && best_.scenario.layout.wheels == 4) {
        less = best_.scenario;
        less.layout.wheels = 2;
        less.layout.one_module = false;
        goes_on = shows(without(without(less, 2), 2));
      }
      any = any || goes_on;
    }
    return any;
  }
  bool shorten() {
    Scenario less = best_.scenario;
    less.length = std::min(less.length, best_.violation.at);
    bool any = less.length < best_.scenario.length && shows(less);
    for (std::size_t i = 0; i < best_.scenario.events.size(); ++i) {
      less = best_.scenario;
      const Act* const act = findAct(bus_, less.events[i].act);
      const unsigned least = act == nullptr ? 10 : std::max(10, act->span.least);  // what is shorter is not lawful
      less.events[i].span /= 2;
      if (less.events[i].span >= least) any = shows(less) || any;
    }
    return any;
  }

 private:
  /// What happens at `drive`, which is not there any more; those behind it move up.
  static Scenario without(Scenario scenario, DriveIndex drive) {
    auto& events = scenario.events;
    events.erase(std::remove_if(events.begin(), events.end(), [&](const Event& event) { return event.drive == drive; }),
                 events.end());
    for (Event& event : events) {
      if (event.drive > drive) --event.drive;
    }
    return scenario;
  }
  bool shows(const Scenario& less) {
    if (best_.tries >= most_tries_) return false;
    ++best_.tries;
    const Outcome outcome = Player{less, bus_, wrap_}.play();
    if (!outcome.violation || outcome.violation->invariant != best_.violation.invariant) return false;
    best_.scenario = less;
    best_.violation = *outcome.violation;
    return true;
  }

  Shrunk& best_;
  const CampaignBus& bus_;
  const TransportWrap& wrap_;
  unsigned most_tries_;
};

}  // namespace

Shrunk shrink(const Scenario& scenario, const Violation& violation, const CampaignBus& bus, const TransportWrap& wrap,
              unsigned most_tries) {
  Shrunk best{scenario, violation, 0};
  Shrinker shrinker{best, bus, wrap, most_tries};
  for (bool goes_on = true; goes_on;) {
    goes_on = shrinker.leaveOutEvents();
    goes_on = shrinker.leaveOutDrives() || goes_on;
    goes_on = shrinker.shorten() || goes_on;
  }
  return best;
}

}  // namespace nord_driver::test
