#include "transport/profibus/profibus_scanner.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "config/setting_checks.h"
#include "nord_driver/trace/telegram_trace.h"
#include "profibus/bus_scan.h"
#include "profibus/class2_master.h"
#include "profibus/identification.h"
#include "transport/profibus/profibus_dp_config.h"
#include "transport/profibus/profibus_line.h"
#include "transport/profibus/profibus_recorder.h"
#include "transport/profibus/record_parameter_channel.h"

namespace nord_driver {

namespace {

using profibus::BusScan;
using profibus::ScannedStation;

constexpr Duration kSlice = std::chrono::milliseconds{50};  // between two looks at whether the end is asked for
constexpr Duration kTypePlateLimit = std::chrono::seconds{3};
constexpr std::uint16_t kSkTu3 = 0x7531, kSkCu4 = 0x0BA8;  // BU 0020 5.2, BU 0220 4.2.2
constexpr std::uint8_t kInverters = 4;                     // behind one module
constexpr int kPauses = 3;                                 // of a channel between two orders
constexpr Duration kParameterLimit = std::chrono::seconds{1};
constexpr std::uint16_t kSoftwareVersion = 707, kDatabase = 742, kPower = 743;

/// One line that is open for the time of a scan.
class Line {
 public:
  Line(link::ByteLink& link, const std::atomic<bool>& end_asked)
      : link_(link), end_asked_(end_asked), trace_(kLinkTypeProfibusDl, {}, 16), recorder_(trace_) {}

  /// Until `done()`, the end is asked for, or the line is gone.
  template <typename Engine, typename Done>
  void talk(Engine& engine, Done done) {
    while (!end_asked_ && link_.isOpen() && !done()) {
      const Instant until = link_.now() + kSlice;
      talkOnLine(engine, link_, recorder_, until, [&] { return done() || link_.now() >= until; });
      if (link_.isOpen() && !done() && link_.now() < until) link_.sleepUntil(until);  // nothing to wait for
    }
  }
  link::ByteLink& link() { return link_; }

 private:
  link::ByteLink& link_;
  const std::atomic<bool>& end_asked_;
  TelegramTrace trace_;
  ProfibusRecorder recorder_;
};

FoundStation stationOf(std::uint8_t address, const ScannedStation& scanned) {
  FoundStation station;
  station.number = address;
  if (scanned.kind != ScannedStation::Kind::kSlave) {
    station.note = describe(address, scanned).str();
    return station;
  }
  char ident[24] = "not told";
  if (scanned.ident) std::snprintf(ident, sizeof ident, "%04Xh", static_cast<unsigned>(*scanned.ident));
  station.module = ident;
  if (scanned.ident == kSkTu3) {
    station.module = "SK TU1/2/3-PBR (7531h)";
    station.series = "sk300e, sk5xxe, sk54xe, sk700e or sk750e";
  } else if (scanned.ident == kSkCu4) {
    station.module = "SK CU4/TU4-PBR (0BA8h)";
    station.series = "sk1x0e, sk2xxe, sk5xxe or sk54xe";
  }
  if (scanned.ident && scanned.owner != profibus::kNoOwner) {
    station.note = "parameterised by master " + std::to_string(scanned.owner);
  }
  if (address == profibus::StationAddress::kUnnamed) {
    station.note += std::string(station.note.empty() ? "" : "; ") + "not addressed yet: set its address to 3 to 125";
  }
  return station;
}

std::string besideMaster(std::uint8_t master) {
  return "master " + std::to_string(master) + " was heard: nothing is sent on the bus of another master; end it first";
}

// A station that a master has keeps its time for that one.
bool mayHaveTypePlate(const ScannedStation& scanned) {
  return scanned.kind == ScannedStation::Kind::kSlave && scanned.ident == kSkCu4 && scanned.owner == profibus::kNoOwner;
}

/// One record after the other with one module, over a connection of its own (MS2).
class ModuleTalk {
 public:
  ModuleTalk(Line& line, const profibus::BusParameters& bus, unsigned address)
      : line_(line), master_(bus, {*profibus::StationAddress::from(static_cast<int>(address))}) {
    master_.restart(line_.link().now());
  }

  /// Nothing: it has no answer to this before `end`.
  std::optional<profibus::RecordResult> carryOut(const profibus::RecordRequest& request, Instant end) {
    std::optional<profibus::RecordResult> result;
    if (!master_.submitRecord(0, request)) return result;
    line_.talk(master_, [&] {
      if (!result) result = master_.pollRecord();
      if (!result) master_.wantsBus(now());  // moves it on
      return result.has_value() || now() >= end;
    });
    return result;
  }
  void close() {
    master_.close();
    const Instant closed = now() + kSlice * 4;
    line_.talk(master_, [&] { return !master_.wantsBus(now()) || now() >= closed; });
  }
  Instant now() const { return line_.link().now(); }
  bool goesOn() const { return line_.link().isOpen() && !refusedBy(); }
  /// The master that was heard: nothing more is sent.
  std::optional<std::uint8_t> refusedBy() const { return master_.refusedBy(); }

 private:
  Line& line_;
  profibus::Class2Master master_;
};

void askTypePlate(ModuleTalk& talk, FoundStation& station) {
  profibus::IdentificationReader reader{0};
  const Instant end = talk.now() + kTypePlateLimit;
  while (!reader.done() && talk.goesOn() && talk.now() < end) {
    const auto request = reader.pollRecord();
    const auto result = request ? talk.carryOut(*request, end) : std::nullopt;
    if (!result) break;
    reader.handleRecord(*result);
  }
  if (const auto plate = reader.typePlate()) station.version = describe(*plate).str();
}

/// Nothing: this inverter is not there, or has no such parameter.
std::optional<std::int32_t> readParameter(ModuleTalk& talk, RecordParameterChannel& channel, std::uint16_t number,
                                          std::uint8_t element) {
  profile::ParameterRequest request;
  request.id = 1;
  request.number = number;
  if (element > 0) {
    request.shape = profile::ParameterShape::kArray;
    request.index = element;
  }
  if (!channel.submit(request, talk.now())) return std::nullopt;
  const Instant end = talk.now() + kParameterLimit;
  int pauses = 0;
  while (talk.goesOn() && talk.now() < end) {
    if (const auto result = channel.pollResult()) {
      // The pause between two orders is the module's to hear, and no record.
      channel.pollRecord(talk.now());
      return result->outcome == profile::ParameterOutcome::kDone ? std::optional<std::int32_t>{result->raw}
                                                                 : std::nullopt;
    }
    const auto record = channel.pollRecord(talk.now());
    if (!record && ++pauses > kPauses) return std::nullopt;
    if (!record) continue;
    const auto result = talk.carryOut(*record, end);
    if (!result) return std::nullopt;
    channel.handleRecord(*result, talk.now());
  }
  return std::nullopt;
}

/// One row for each inverter behind the module that answers. What P742 and P743 mean for a series stands in no manual at
/// hand: they are told as numbers.
std::vector<FoundStation> askInverters(ModuleTalk& talk, const ProfibusDpConfig& config, unsigned address) {
  std::vector<FoundStation> inverters;
  for (std::uint8_t unit = 1; unit <= kInverters; ++unit) {
    RecordParameterChannel channel{unit, config.records, kParameterLimit};
    const auto version = readParameter(talk, channel, kSoftwareVersion, 1);
    if (!version) continue;
    FoundStation inverter;
    inverter.number = address;
    inverter.module = "inverter " + std::to_string(unit);
    inverter.version = "P707 = " + std::to_string(*version);
    if (const auto revision = readParameter(talk, channel, kSoftwareVersion, 2)) {
      inverter.version += " R" + std::to_string(*revision);
    }
    for (const std::uint16_t number : {kDatabase, kPower}) {
      const auto value = readParameter(talk, channel, number, 0);
      if (!value) continue;
      inverter.series +=
          (inverter.series.empty() ? "P" : ", P") + std::to_string(number) + " = " + std::to_string(*value);
    }
    inverters.push_back(inverter);
  }
  return inverters;
}

}  // namespace

std::string profibusScanIsQuiet(const Settings& bus) {
  constexpr Duration kQuiet = std::chrono::seconds{3};
  const Duration listens = readProfibusDpConfig(bus, {}, 100.0, ProfibusUse::kRecordsOnly).bus.listen_first;
  if (listens <= kQuiet) return {};
  return "listens for other masters for " + shortNumber(toSeconds(listens)) +
         " s before it sends anything (listen_first)";
}

ScanReport scanProfibus(const Settings& bus,
                        const std::function<std::unique_ptr<link::ByteLink>(const link::SerialSettings&)>& make_link,
                        const std::atomic<bool>& end_asked) {
  const ProfibusDpConfig config = readProfibusDpConfig(bus, {}, 100.0, ProfibusUse::kRecordsOnly);
  ScanReport report;
  report.bus = "PROFIBUS";
  report.number_name = "station";
  const std::unique_ptr<link::ByteLink> link = make_link(config.line);
  if (!link->open()) {
    report.trouble = link->lastError();
    return report;
  }
  Line line{*link, end_asked};
  profibus::BusParameters looking = config.bus;
  looking.gives_way = true;
  BusScan scan{looking};
  scan.start(link->now());
  line.talk(scan, [&] { return scan.done(); });
  if (!link->isOpen()) {
    report.trouble = link->lastError();
  } else if (scan.refusedBy()) {
    report.trouble = besideMaster(*scan.refusedBy());
  } else if (scan.lineBusy()) {
    report.trouble = "the line never falls silent: another baud rate, or noise?";
  } else if (!scan.done()) {
    report.trouble = "ended before every address was asked";
  }
  profibus::BusParameters after = config.bus;
  after.listen_first = Duration::zero();  // it was listened
  for (unsigned address = 0; address < BusScan::kAddresses; ++address) {
    const ScannedStation& scanned = scan.station(static_cast<std::uint8_t>(address));
    if (scanned.kind == ScannedStation::Kind::kSilent || scanned.kind == ScannedStation::Kind::kSelf) continue;
    report.stations.push_back(stationOf(static_cast<std::uint8_t>(address), scanned));
    if (!report.trouble.empty() || !mayHaveTypePlate(scanned)) continue;
    ModuleTalk talk{line, after, address};
    askTypePlate(talk, report.stations.back());
    for (const FoundStation& inverter : askInverters(talk, config, address)) report.stations.push_back(inverter);
    talk.close();
    if (!link->isOpen()) {
      report.trouble = link->lastError();
    } else if (talk.refusedBy()) {
      report.trouble = besideMaster(*talk.refusedBy());
    } else if (end_asked) {
      report.trouble = "ended before every module was asked";
    }
  }
  link->close();
  return report;
}

}  // namespace nord_driver
