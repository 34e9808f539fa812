#include "transport/profibus/profibus_scanner.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/trace/telegram_trace.h"
#include "profibus/bus_scan.h"
#include "profibus/class2_master.h"
#include "profibus/identification.h"
#include "transport/profibus/profibus_dp_config.h"
#include "transport/profibus/profibus_line.h"
#include "transport/profibus/profibus_recorder.h"

namespace nord_driver {

namespace {

using profibus::BusScan;
using profibus::ScannedStation;

constexpr Duration kSlice = std::chrono::milliseconds{50};  // between two looks at whether the end is asked for
constexpr Duration kTypePlateLimit = std::chrono::seconds{3};
constexpr std::uint16_t kSkTu3 = 0x7531, kSkCu4 = 0x0BA8;  // BU 0020 5.2, BU 0220 4.2.2
constexpr unsigned kUnnamed = 126;

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
  if (address == kUnnamed) {
    station.note += std::string(station.note.empty() ? "" : "; ") + "not addressed yet: set its address to 3 to 125";
  }
  return station;
}

// A station that a master has keeps its time for that one.
bool mayHaveTypePlate(const ScannedStation& scanned) {
  return scanned.kind == ScannedStation::Kind::kSlave && scanned.ident == kSkCu4 && scanned.owner == profibus::kNoOwner;
}

void askTypePlate(Line& line, const profibus::BusParameters& bus, FoundStation& station) {
  const auto address = *profibus::StationAddress::from(static_cast<int>(station.number));
  profibus::Class2Master master{bus, {address}};
  master.restart(line.link().now());
  profibus::IdentificationReader reader{0};
  const Instant end = line.link().now() + kTypePlateLimit;
  while (!reader.done() && line.link().isOpen() && line.link().now() < end) {
    const auto request = reader.pollRecord();
    if (!request || !master.submitRecord(0, *request)) break;
    std::optional<profibus::RecordResult> result;
    line.talk(master, [&] {
      if (!result) result = master.pollRecord();
      if (!result) master.wantsBus(line.link().now());  // moves it on
      return result.has_value() || line.link().now() >= end;
    });
    if (!result) break;
    reader.handleRecord(*result);
  }
  if (const auto plate = reader.typePlate()) station.version = describe(*plate).str();
  master.close();
  const Instant closed = line.link().now() + kSlice * 4;
  line.talk(master, [&] { return !master.wantsBus(line.link().now()) || line.link().now() >= closed; });
}

}  // namespace

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
  BusScan scan{config.bus};
  scan.start(link->now());
  line.talk(scan, [&] { return scan.done(); });
  if (!link->isOpen()) {
    report.trouble = link->lastError();
  } else if (scan.refusedBy()) {
    report.trouble = "master " + std::to_string(*scan.refusedBy()) +
                     " was heard: nothing is sent on the bus of another master; end it first";
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
    if (report.trouble.empty() && mayHaveTypePlate(scanned)) askTypePlate(line, after, report.stations.back());
  }
  link->close();
  return report;
}

}  // namespace nord_driver
