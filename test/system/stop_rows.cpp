#include "system/stop_rows.h"

#include "sim/inverter/words.h"
#include "system/what_stops_what.h"

namespace nord_driver::test {

namespace {

constexpr std::int32_t kRampOf30s = 3000;  // P103

void trip(WhatStopsWhat& test, bool cause_stays) {
  test.rig().unit(WhatStopsWhat::kRight).inverter().trip(30, cause_stays);
}
void setTerminals(WhatStopsWhat& test, bool off2, bool off3) {
  sim::Terminals terminals;
  terminals.coast = off2;
  terminals.quick_stop = off3;
  test.rig().unit(WhatStopsWhat::kRight).inverter().setTerminals(terminals);
}
void makeRampsLong(WhatStopsWhat& test) {
  for (DriveIndex i = 0; i < StopRig::kDrives; ++i) test.rig().unit(i).parameters().preset(103, 0, 0, kRampOf30s);
}

bool saysFault(Word status) {
  return (status & sim::zsw::kFault) != 0;
}
bool saysOff2(Word status) {
  return (status & sim::zsw::kNoOff2) == 0;
}
bool saysOff3(Word status) {
  return (status & sim::zsw::kNoOff3) == 0;
}
bool saysLocal(Word status) {
  return (status & sim::zsw::kBusControl) == 0;
}
bool saysNothing(Word status) {
  return status == 0;
}
bool saysNotEnabled(Word status) {
  return (status & sim::zsw::kOperationEnabled) == 0;
}

}  // namespace

// In the order of the table.
const std::vector<StopRow>& stopRows() {
  using Test = WhatStopsWhat;
  static const std::vector<StopRow> rows = [] {
    std::vector<StopRow> all;
    const auto add = [&all](const char* name, Known known, Reaction reaction, After after, const char* named,
                            void (*cause)(Test&)) -> StopRow& {
      all.push_back({name, known, reaction, after, named, cause});
      return all.back();
    };

    add("CommandTooOld", Known::kCommandAge, Reaction::kRamp, After::kEnabled, "", [](Test&) {}).commands_go_on = false;
    add("CommandIsNoNumber", Known::kCommandAge, Reaction::kRamp, After::kEnabled, "",
        [](Test& test) { test.commandNoNumbers(); });
    add("EnableFalse", Known::kAtOnce, Reaction::kRamp, After::kDisabled, "",
        [](Test& test) { test.submit(cycle::RequestKind::kDisable); });
    add("EnableFalseAndALongRamp", Known::kRampTooLong, Reaction::kQuickStop, After::kLatched, "did not end in time",
        [](Test& test) {
          makeRampsLong(test);
          test.submit(cycle::RequestKind::kDisable);
        });
    add("NodeEnds", Known::kAtOnce, Reaction::kRamp, After::kEnded, "",
        [](Test& test) { test.submit(cycle::RequestKind::kShutDown); });
    add("NodeEndsAndALongRamp", Known::kRampTooLong, Reaction::kQuickStop, After::kEnded, "did not end in time",
        [](Test& test) {
          makeRampsLong(test);
          test.submit(cycle::RequestKind::kShutDown);
        });
    add("QuickStop", Known::kAtOnce, Reaction::kQuickStop, After::kLatched, "a quick stop was asked for",
        [](Test& test) { test.submit(cycle::RequestKind::kQuickStop); });

    StopRow& fault = add("Fault", Known::kOnTheWire, Reaction::kOneStops, After::kFaultLatched,
                         "drive right stopped: a fault of the inverter", [](Test& test) { trip(test, true); });
    fault.status_says = saysFault;
    fault.end_cause = [](Test& test) { test.rig().unit(Test::kRight).inverter().clearCause(); };
    // Our own idle word acknowledges it (BU 0020 8).
    add("FaultThatVanishes", Known::kOnTheWire, Reaction::kOneStops, After::kFaultLatched,
        "drive right stopped: a fault of the inverter", [](Test& test) { trip(test, false); })
        .status_says = saysFault;
    add("UnaskedExit", Known::kOnTheWire, Reaction::kOneStops, After::kLatched,
        "left \"operation enabled\" without being asked",
        [](Test& test) {  // a dip of the mains
          test.rig().unit(Test::kRight).inverter().setPowered(false);
          test.rig().unit(Test::kRight).inverter().setPowered(true);
        })
        .status_says = saysNotEnabled;
    StopRow& off2 = add("Off2AtTheTerminals", Known::kOnTheWire, Reaction::kOneStops, After::kLatched,
                        "OFF2 at the inverter's terminals", [](Test& test) { setTerminals(test, true, false); });
    off2.status_says = saysOff2;
    off2.end_cause = [](Test& test) { setTerminals(test, false, false); };
    StopRow& off3 = add("Off3AtTheTerminals", Known::kOnTheWire, Reaction::kOneStops, After::kLatched,
                        "OFF3 at the inverter's terminals", [](Test& test) { setTerminals(test, false, true); });
    off3.status_says = saysOff3;
    off3.end_cause = [](Test& test) { setTerminals(test, false, false); };
    StopRow& local = add("LocalControl", Known::kOnTheWire, Reaction::kOneStops, After::kLatched, "local control",
                         [](Test& test) { test.rig().unit(Test::kRight).inverter().setLocalControl(true, 0.0); });
    local.status_says = saysLocal;
    local.end_cause = [](Test& test) { test.rig().unit(Test::kRight).inverter().setLocalControl(false); };

    // Its watchdog or guarding ends the other side as well: E10.2, E10.0.
    add("DriveSilent", Known::kSilence, Reaction::kOneIsGone, After::kFaultLatched,
        "drive right stopped: the inverter fell silent",
        [](Test& test) { test.rig().unit(Test::kRight).setMute(true); })
        .end_cause = [](Test& test) { test.rig().unit(Test::kRight).setMute(false); };
    add("DriveUnplugged", Known::kSilence, Reaction::kOneIsGone, After::kLatched,
        "drive right stopped: the inverter fell silent",
        [](Test& test) { test.rig().unit(Test::kRight).setPlugged(false); })
        .end_cause = [](Test& test) { test.rig().unit(Test::kRight).setPlugged(true); };
    StopRow& off = add("InverterOffBehindItsModule", Known::kZeros, Reaction::kOneIsGone, After::kLatched,
                       "drive right stopped: the inverter fell silent",
                       [](Test& test) { test.rig().unit(Test::kRight).setInverterPower(false); });
    off.status_says = saysNothing;
    off.end_cause = [](Test& test) { test.rig().unit(Test::kRight).setInverterPower(true); };

    // The process is stopped, or the machine sleeps: no telegram leaves for longer than every drive-side time-out.
    add("ComputerStandsStill", Known::kAtOnce, Reaction::kNoBus, After::kFaultLatched,
        "drive left stopped:", [](Test& test) { test.standStill(); });
    add("BusLost", Known::kAtOnce, Reaction::kNoBus, After::kFaultLatched, "stopped:", [](Test& test) {
      test.rig().setBusPresent(false);
    }).end_cause = [](Test& test) { test.rig().setBusPresent(true); };
    return all;
  }();
  return rows;
}

std::map<std::string, MapSettings::Value> stopSettings(double cycle_rate) {
  return {{"cycle_rate", cycle_rate}, {"linear/x/has_acceleration_limits", true}, {"linear/x/max_acceleration", 0.5}};
}

std::string nameOfStop(const ::testing::TestParamInfo<std::tuple<StopBus, StopRow>>& info) {
  return std::string(std::get<StopRow>(info.param).name) + "At" + std::get<StopBus>(info.param).name;
}

void PrintTo(const StopBus& bus, std::ostream* out) {
  *out << bus.name;
}
void PrintTo(const StopRow& row, std::ostream* out) {
  *out << row.name;
}

}  // namespace nord_driver::test
