#include "campaign/generator.h"

#include <algorithm>

#include "campaign/player.h"
#include "support/dice.h"

namespace nord_driver::test {

namespace {

int draw(Dice& dice, Range range) {
  if (range.most <= range.least) return range.least;
  return dice.from(range.least, range.most);
}

Layout drawLayout(Dice& dice, const CampaignBus& bus) {
  // Two drives as a rule, up to eight.
  static constexpr Layout kLayouts[] = {
      {2, 0, 0, false}, {2, 0, 0, false}, {2, 0, 0, false}, {2, 1, 0, false}, {0, 1, 0, false}, {0, 2, 0, false},
      {4, 0, 0, false}, {2, 2, 0, false}, {4, 4, 0, false}, {0, 5, 0, false}, {4, 0, 0, true},  {0, 3, 0, true},
      {2, 1, 0, true},  {2, 2, 0, true},  {2, 0, 1, false}, {2, 0, 1, false}, {0, 0, 1, false}, {0, 1, 1, false},
      {0, 0, 2, false}, {2, 1, 2, false}, {4, 0, 2, false}, {4, 2, 2, false}, {0, 2, 2, true},  {0, 0, 3, true}};
  for (;;) {
    const Layout layout = kLayouts[dice.below(sizeof(kLayouts) / sizeof(kLayouts[0]))];
    const bool mixed = layout.wheels == 2;
    const bool shares = bus.shares == Shares::kAny || (bus.shares == Shares::kFourOrSingles && !mixed);
    const bool carried =
        layout.axes == 0 || (layout.drives() <= bus.most_with_axes && (!layout.one_module || bus.module_carries_axes));
    if ((!layout.one_module || shares) && carried) return layout;
  }
}

const Act& drawAct(Dice& dice, const std::vector<const Act*>& acts) {
  unsigned sum = 0;
  for (const Act* act : acts) sum += act->weight;
  unsigned roll = dice.below(sum);
  for (const Act* act : acts) {
    if (roll < act->weight) return *act;
    roll -= act->weight;
  }
  return *acts.back();
}

Event drawEvent(Dice& dice, const Act& act, const Layout& layout, unsigned at) {
  Event event;
  event.at = at;
  event.act = act.name;
  event.drive = dice.below(static_cast<unsigned>(layout.drives()));
  event.span = static_cast<unsigned>(draw(dice, act.span));
  event.amount = draw(dice, act.amount);
  event.extra = draw(dice, act.extra);
  return event;
}

Event eventOf(const char* act, unsigned at, unsigned span, DriveIndex drive, int amount, int extra) {
  Event event;
  event.at = at;
  event.span = span;
  event.act = act;
  event.drive = drive;
  event.amount = amount;
  event.extra = extra;
  return event;
}

/// Enable, and commands for all that can be commanded, which change now and then.
void addDriving(Dice& dice, Scenario& scenario, unsigned from, unsigned until) {
  scenario.events.push_back(eventOf("enable", from, 0, 0, 1, 0));
  const Layout& layout = scenario.layout;
  for (unsigned at = from + 200 + dice.below(200); at < until;) {
    const unsigned span = 200 + dice.below(1200);
    if (layout.wheels != 0) {
      scenario.events.push_back(eventOf("drive", at, span, 0, draw(dice, {-45, 45}), draw(dice, {-45, 45})));
    }
    for (DriveIndex i = layout.wheels; i < layout.firstAxis(); ++i) {
      scenario.events.push_back(eventOf("turn", at, span, i, draw(dice, {-90, 90}), 0));
    }
    for (DriveIndex i = layout.firstAxis(); i < layout.drives(); ++i) {
      const unsigned roll = dice.below(10);
      const unsigned when = at + dice.below(50);
      if (roll < 6) scenario.events.push_back(eventOf("go", when, 0, i, draw(dice, {-120, 120}), 0));
      if (roll >= 5) scenario.events.push_back(eventOf("onward", when, 0, i, draw(dice, {-60, 60}), 0));
      if (roll == 9) scenario.events.push_back(eventOf("onward", when, 0, i, draw(dice, {-30, 30}), 0));
    }
    at += dice.below(8) == 0 ? span + 700 : span;
  }
}

}  // namespace

Scenario makeScenario(const CampaignBus& bus, std::uint32_t seed) {
  Dice dice{seed};
  Scenario scenario;
  scenario.bus = bus.name;
  scenario.seed = seed;
  scenario.layout = drawLayout(dice, bus);
  scenario.layout.variant = seed % 512;  // not drawn: what a seed stands for otherwise stays as it is

  std::vector<const Act*> causes, users;
  for (const auto* acts : {&driveActs(), &bus.acts()}) {
    for (const Act& act : *acts) causes.push_back(&act);
  }
  for (const Act& act : userActs()) {
    const std::string name = act.name;
    const bool drives = name == "drive" || name == "turn" || name == "go" || name == "onward" || name == "home" ||
                        name == "end_node" || name == "kill";
    if (!drives) users.push_back(&act);
  }

  // Every fourth starts into the trouble.
  const unsigned ready_at = scenario.layout.axes != 0 ? bus.axes_ready_at : bus.ready_at;
  const auto at = static_cast<unsigned>(ready_at * scenario.layout.slowness());
  const unsigned begin = dice.below(4) == 0 ? 0 : at + 300;
  const unsigned length = 1500 + dice.below(2000);
  scenario.length = at + length;
  addDriving(dice, scenario, at, scenario.length);
  const unsigned blows = 1 + dice.below(4);
  for (unsigned i = 0; i < blows; ++i) {
    const unsigned when = begin + dice.below(scenario.length - begin);
    const unsigned at_once = 1 + dice.below(3);
    for (unsigned k = 0; k < at_once; ++k) {
      scenario.events.push_back(drawEvent(dice, drawAct(dice, causes), scenario.layout, when + dice.below(60)));
    }
  }
  const unsigned requests = dice.below(5);
  for (unsigned i = 0; i < requests; ++i) {
    scenario.events.push_back(
        drawEvent(dice, drawAct(dice, users), scenario.layout, begin + dice.below(scenario.length - begin)));
  }
  // On its way it is refused: half of them come before the first target.
  if (scenario.layout.axes != 0 && dice.below(3) == 0) {
    const unsigned when = at + (dice.coin() ? 150 : 400 + dice.below(length));
    const auto axis = static_cast<DriveIndex>(scenario.layout.firstAxis() + dice.below(scenario.layout.axes));
    scenario.events.push_back(eventOf("home", when, 0, axis, 0, 0));
  }
  // A second try, when what struck first is over.
  if (dice.coin()) {
    const unsigned again = at + length / 2;
    scenario.events.push_back(eventOf("acknowledge", again, 0, 0, 1, 0));
    scenario.events.push_back(eventOf("enable", again + 700, 0, 0, 1, 0));
  }
  if (dice.below(8) == 0) {
    const unsigned end = at + 400 + dice.below(length - 400);
    scenario.events.push_back(eventOf(dice.coin() ? "end_node" : "kill", end, 0, 0, 0, 0));
  }
  std::stable_sort(scenario.events.begin(), scenario.events.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
  return scenario;
}

}  // namespace nord_driver::test
