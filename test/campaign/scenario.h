// A scenario of the fault campaign as data: which drives there are, and what happens when. Made from a seed, printed and
// read as one line of text, so that whatever it shows can be shown again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/transport/cyclic_exchange.h"

namespace nord_driver::test {

/// The first `wheels` drives are those of a base (even: left, odd: right), the `singles` behind them have commands of
/// their own, and the `axes` that come last go to positions.
struct Layout {
  unsigned wheels = 2;      ///< 0, 2 or 4
  unsigned singles = 0;     ///< 1 to 8 drives in all
  unsigned axes = 0;        ///< `mode: position`; the first of them can be asked for a reference run
  bool one_module = false;  ///< all of them behind one bus module (up to four)
  unsigned variant = 0;     ///< 0 to 511: how it is configured

  /// 0 to 3: which of its ways to exchange process data a bus with several takes.
  unsigned exchange() const noexcept { return variant % 4; }
  /// 0 to 3: which ways its stops take; 0: those nobody has chosen.
  unsigned ways() const noexcept { return variant / 4 % 4; }
  /// 0 to 3: how often it cycles, and whether it limits acceleration; 0: as nobody has chosen it.
  unsigned pace() const noexcept { return variant / 16 % 4; }
  /// 0 to 3: what else bounds its speeds; 0: nothing.
  unsigned bounds() const noexcept { return variant / 64 % 4; }
  bool limitsJerk() const noexcept { return bounds() % 2 == 1; }
  /// P104 of drives that are told speeds is above 0, and accepted.
  bool hasSlowest() const noexcept { return bounds() / 2 == 1; }
  /// Its words are those of the other profile of its bus, where that has one: CiA 402, the AC drive profile, DRIVECOM.
  /// They know no positions, and one drive for each module.
  bool otherProfile() const noexcept { return variant / 256 % 2 == 1 && axes == 0 && !one_module; }
  bool limitsAcceleration() const noexcept { return pace() == 3 || limitsJerk(); }
  /// Hz; more than two drives at 200 Hz are too much for their buses.
  double cycleRate() const noexcept { return pace() == 1 ? 50.0 : pace() != 2 ? 100.0 : drives() <= 2 ? 200.0 : 80.0; }
  /// What takes 1 s at 100 Hz takes that long where each step waits for a cycle.
  double slowness() const noexcept { return cycleRate() < 100.0 ? 100.0 / cycleRate() : 1.0; }
  std::size_t drives() const noexcept { return wheels + singles + axes; }
  DriveIndex firstAxis() const noexcept { return wheels + singles; }
};

/// One thing that happens: it begins at `at`, and ends `span` later where it lasts.
struct Event {
  unsigned at = 0;    ///< ms after the start
  unsigned span = 0;  ///< ms; 0: it does not last
  std::string act;    ///< its name in the table of acts
  DriveIndex drive = 0;
  int amount = 0;  ///< what it means stands in the table
  int extra = 0;
};

struct Scenario {
  std::string bus;  ///< "profibus", "canopen", "devicenet", "interbus"
  std::uint32_t seed = 0;
  Layout layout;
  unsigned length = 0;  ///< ms; then every cause ends, and what follows is judged
  std::vector<Event> events;
};

/// "bus=profibus seed=17 wheels=2 singles=0 axes=1 one_module=0 length=6000; 1500+0 enable 0 0 0; ..."; no axes and
/// variant 0 are left out.
std::string toText(const Scenario& scenario);
std::string toText(const Event& event);
/// Nothing when it is no such line.
std::optional<Scenario> scenarioFrom(const std::string& text);

}  // namespace nord_driver::test
