#include "transport/canopen/canopen_drive_config.h"

#include <algorithm>
#include <array>

#include "canopen/nmt.h"
#include "config/setting_choice.h"
#include "config/setting_groups.h"
#include "profile/process_data_order.h"

namespace nord_driver {

namespace {

using canopen::ErrorControlMode;
using canopen::NodeConfig;
using profile::Series;
using std::chrono::milliseconds;

// The inverters' addresses on the system bus, FI1 to FI4; the ids after them are encoders (BU 0200 p. 291, BU 0280).
constexpr std::array<std::uint8_t, 4> kSystemBusIds{32, 34, 36, 38};
constexpr std::uint16_t kOffsetPerInverter = 0x0800;  // BU 0270 p. 43
constexpr Duration kMaxTime = milliseconds{65'535};   // 16 bits of milliseconds
constexpr Duration kMinPause = milliseconds{10};
constexpr double kMaxSdoTimeout = 60.0;

constexpr Choice<CanopenConnection> kConnections[] = {{"option", CanopenConnection::kOption},
                                                      {"onboard", CanopenConnection::kOnboard},
                                                      {"gateway", CanopenConnection::kGateway},
                                                      {"system_bus", CanopenConnection::kSystemBus}};
constexpr Choice<DriveProfile> kProfiles[] = {{"nord", DriveProfile::kNord}, {"cia402", DriveProfile::kCia402}};
constexpr Choice<ErrorControlMode> kErrorControls[] = {{"guarding", ErrorControlMode::kGuarding},
                                                       {"heartbeat", ErrorControlMode::kHeartbeat},
                                                       {"none", ErrorControlMode::kNone}};
constexpr Choice<canopen::BootReset> kResets[] = {{"communication", canopen::BootReset::kResetCommunication},
                                                  {"node", canopen::BootReset::kResetNode},
                                                  {"none", canopen::BootReset::kNone}};
constexpr Choice<ArraySubIndex> kArraySubIndices[] = {{"element", ArraySubIndex::kElement},
                                                      {"table", ArraySubIndex::kTable}};
constexpr Choice<ParameterServers> kParameterServers[] = {{"per_inverter", ParameterServers::kPerInverter},
                                                          {"index_offset", ParameterServers::kIndexOffset}};
constexpr Choice<bool> kMappings[] = {{"write", true}, {"keep", false}};

Duration wholeMilliseconds(const Settings& settings, const std::string& key, Duration fallback, Duration min,
                           Duration max) {
  return wholeMillisecondsOr(settings, key, fallback, min, max, "0.1 s: the object counts them");
}

std::optional<std::uint32_t> readIdentity(const Settings& settings, const std::string& key) {
  if (!settings.has(key)) return std::nullopt;
  return static_cast<std::uint32_t>(requiredInteger(settings, key, 0, 0xFFFFFFFF));
}

/// Which series can sit on CAN this way, and in words what was expected instead.
struct Reach {
  CanopenConnection connection;
  std::array<Series, 5> series;
  const char* expected;
};
constexpr Reach kReaches[] = {
    {CanopenConnection::kOption,
     {Series::kSk300e, Series::kSk5xxe, Series::kSk54xe, Series::kSk700e, Series::kSk750e},
     "a series that takes SK TU1/2/3-CAO (sk300e, sk5xxe, sk54xe, sk700e, sk750e); sk1x0e and sk2xxe need connection: "
     "gateway"},
    {CanopenConnection::kOnboard,
     {Series::kSk5xxe, Series::kSk54xe, Series::kSk5xxe, Series::kSk5xxe, Series::kSk5xxe},
     "sk5xxe or sk54xe: no other series has a CANopen port of its own"},
    {CanopenConnection::kGateway,
     {Series::kSk1x0e, Series::kSk2xxe, Series::kSk5xxe, Series::kSk54xe, Series::kSk2xxe},
     "a series that sits behind SK CU4/TU4-CAO (sk1x0e, sk2xxe, sk5xxe, sk54xe)"},
    {CanopenConnection::kSystemBus,
     {Series::kSk1x0e, Series::kSk2xxe, Series::kSk5xxe, Series::kSk54xe, Series::kSk2xxe},
     "a series with a system bus (sk1x0e, sk2xxe, sk5xxe, sk54xe)"},
};

void checkSeries(const Settings& settings, const CanopenDrive& drive) {
  for (const Reach& reach : kReaches) {
    if (reach.connection != drive.connection) continue;
    if (std::find(reach.series.begin(), reach.series.end(), drive.series) != reach.series.end()) return;
    throw wrongSetting(settings, "series", std::string("\"") + profile::toString(drive.series) + "\"", reach.expected);
  }
}

void checkCia402(const Settings& settings, const CanopenDrive& drive) {
  if (drive.drive_profile != DriveProfile::kCia402 || drive.connection == CanopenConnection::kOption) return;
  const char* why = "nord: what its CiA 402 objects are is in no manual we have";
  if (drive.connection == CanopenConnection::kOnboard) {
    why = "nord: the inverter's own CAN port does not support CiA 402 (BU 0060 p. 57), only SK TU1/2/3-CAO does";
  }
  throw wrongSetting(settings, "profile", "\"cia402\"", why);
}

std::uint8_t readProcessValues(const Settings& settings, const CanopenDrive& drive) {
  const std::int64_t fallback = drive.connection == CanopenConnection::kGateway ? 3 : 1;
  const std::int64_t values = integerOr(settings, "process_values", fallback, 1, 3);
  const std::string text = std::to_string(values);
  if (values == 2) throw wrongSetting(settings, "process_values", text, "1 or 3: there is no PDO of two values");
  if (values == 3 && drive.drive_profile == DriveProfile::kCia402) {
    throw wrongSetting(settings, "process_values", text, "1: the CiA 402 velocity mode has one speed");
  }
  if (values == 1 && drive.connection == CanopenConnection::kGateway) {
    throw wrongSetting(settings, "process_values", text, "3: the PDOs of SK CU4/TU4-CAO carry three values");
  }
  return static_cast<std::uint8_t>(values);
}

}  // namespace

namespace {

// The module's DI1 to DI4, DO1 and DO2 are the fifth pair of PDOs of SK CU4/TU4-CAO (1404h and 1604h, 1804h and 1A04h;
// BU 0260 p. 40 and 52). Neither their COB-ID as delivered nor the order of the bits is in a manual at hand.
void refuseModuleTerminals(const Settings& settings) {
  for (const std::string& name : keysBelow(settings, "signals")) {
    const std::string key = "signals/" + name + "/source";
    const std::string word = settings.text(key).value_or("");
    if (word.compare(0, 7, "module_") != 0) continue;
    throw wrongSetting(
        settings, key, "\"" + word + "\"",
        "a source of the inverter: over CANopen the module's own inputs and outputs are its fifth pair of "
        "PDOs (1404h, 1804h), and no manual at hand tells their COB-ID or their bits");
  }
}

}  // namespace

CanopenDrive readCanopenDrive(const DriveSettings& source) {
  const Settings& settings = *source.settings;
  CanopenDrive drive{readDriveCommon(source)};
  refuseModuleTerminals(settings);
  drive.connection = choiceOr(settings, "connection", CanopenConnection::kOption, kConnections);
  checkSeries(settings, drive);
  drive.drive_profile = choiceOr(settings, "profile", DriveProfile::kNord, kProfiles);
  checkCia402(settings, drive);
  if (drive.connection != CanopenConnection::kGateway && drive.inverter != 1) {
    throw wrongSetting(settings, "inverter", std::to_string(drive.inverter),
                       "1: only a gateway has several inverters behind one node");
  }
  drive.process_values = readProcessValues(settings, drive);
  drive.third_before_second = profile::thirdBeforeSecond(drive.series);
  drive.array_sub_index = choiceOr(settings, "array_sub_index", ArraySubIndex::kElement, kArraySubIndices);
  if (readParameterServers(settings, drive) == ParameterServers::kIndexOffset) {
    drive.parameter_base = static_cast<std::uint16_t>(kParameterBase + kOffsetPerInverter * drive.inverter);
  }
  return drive;
}

NodeConfig readCanopenNode(const ModuleSettings& settings, const CanopenDrive& drive, const CanopenBusDefaults& bus) {
  NodeConfig node;
  node.id = static_cast<std::uint8_t>(requiredInteger(settings, "address", 1, canopen::kMaxNodeId));
  const bool system_bus = drive.connection == CanopenConnection::kSystemBus;
  if (system_bus && std::find(kSystemBusIds.begin(), kSystemBusIds.end(), node.id) == kSystemBusIds.end()) {
    throw wrongSetting(settings, "address", std::to_string(node.id),
                       "32, 34, 36 or 38: the inverters FI1 to FI4 of the system bus");
  }
  node.device_type = readIdentity(settings, "device_type");
  node.vendor_id = readIdentity(settings, "vendor_id");
  node.product_code = readIdentity(settings, "product_code");
  node.revision_number = readIdentity(settings, "revision_number");
  // The system bus has masters of its own: nothing is reset there unasked.
  node.reset = choiceOr(settings, "boot_reset",
                        system_bus ? canopen::BootReset::kNone : canopen::BootReset::kResetCommunication, kResets);
  node.sdo_timeout = wholeMilliseconds(settings, "sdo_timeout", bus.sdo_timeout, kMinPause, seconds(kMaxSdoTimeout));

  canopen::ErrorControl& control = node.error_control;
  control.mode = choiceOr(settings, "error_control", ErrorControlMode::kGuarding, kErrorControls);
  control.heartbeat_time = wholeMilliseconds(settings, "heartbeat_time", milliseconds{100}, kMinPause, kMaxTime);
  control.heartbeat_timeout = wholeMilliseconds(
      settings, "heartbeat_timeout", std::min<Duration>(3 * control.heartbeat_time, kMaxTime), kMinPause, kMaxTime);
  if (control.heartbeat_timeout <= control.heartbeat_time) {
    throw wrongSetting(settings, "heartbeat_timeout", shortNumber(toSeconds(control.heartbeat_timeout)),
                       "more than heartbeat_time, " + shortNumber(toSeconds(control.heartbeat_time)) + " s");
  }
  control.guard_time = wholeMilliseconds(settings, "guard_time", milliseconds{100}, kMinPause, kMaxTime);
  control.life_time_factor = static_cast<std::uint8_t>(integerOr(settings, "life_time_factor", 3, 2, 255));
  if (settings.has("watch_master")) {
    control.master_timeout = wholeMilliseconds(settings, "watch_master", Duration::zero(), kMinPause, kMaxTime);
    if (!bus.heartbeat) {
      throw wrongSetting(settings, "watch_master", shortNumber(toSeconds(*control.master_timeout)),
                         "no such key unless bus/heartbeat makes this computer send a heartbeat");
    }
  }
  return node;
}

CanopenPdoOptions readPdoOptions(const Settings& settings, const CanopenDrive& drive, const CanopenBusDefaults& bus) {
  constexpr Duration kMaxInhibit = std::chrono::microseconds{6'553'500};  // 16 bits of 100 us
  constexpr Duration kDefaultEventTime = milliseconds{50};
  CanopenPdoOptions pdo;
  pdo.synchronous = bus.sync;
  const Duration event = std::max<Duration>(kDefaultEventTime, 2 * std::chrono::round<milliseconds>(bus.period));
  pdo.event_time = wholeMilliseconds(settings, "event_time", event, Duration::zero(), kMaxTime);
  // The event time, too, waits for the inhibit time (CiA 301, object 1800h): a longer one would make a sound drive silent.
  const bool limited = !pdo.synchronous && *pdo.event_time > Duration::zero();
  Duration inhibit = std::min<Duration>(std::chrono::round<milliseconds>(bus.period), kMaxInhibit);
  if (limited) inhibit = std::min(inhibit, *pdo.event_time);
  pdo.inhibit_time = seconds(numberOr(settings, "inhibit_time", toSeconds(inhibit), 0.0, toSeconds(kMaxInhibit), "s"));
  if (limited && *pdo.inhibit_time > *pdo.event_time) {
    throw wrongSetting(settings, "inhibit_time", shortNumber(toSeconds(*pdo.inhibit_time)),
                       "at most event_time, " + shortNumber(toSeconds(*pdo.event_time)) + " s");
  }
  const bool known = drive.process_values == 1 && drive.connection != CanopenConnection::kSystemBus;
  pdo.write_mapping = choiceOr(settings, "pdo_mapping", known, kMappings);
  if (!pdo.write_mapping && drive.drive_profile == DriveProfile::kCia402) {
    throw wrongSetting(settings, "pdo_mapping", "\"keep\"",
                       "write: profile cia402 needs 6040h, 6041h, 6042h and 6044h");
  }
  return pdo;
}

ParameterServers readParameterServers(const Settings& settings, const CanopenDrive& drive) {
  const auto servers = choiceOr(settings, "parameter_servers", ParameterServers::kPerInverter, kParameterServers);
  if (servers == ParameterServers::kIndexOffset && drive.connection != CanopenConnection::kGateway) {
    throw wrongSetting(settings, "parameter_servers", "\"index_offset\"",
                       "per_inverter: only a gateway has several inverters behind one node");
  }
  return servers;
}

canopen::SdoChannel readSdoServer(const Settings& settings, const CanopenDrive& drive, std::uint8_t node_id) {
  // What the pre-defined connection set leaves free, apart from the identifiers CiA 301 7.3.5 restricts.
  constexpr std::int64_t kFirstFree = 0x680, kLastFree = 0x6DF;
  const canopen::SdoChannel predefined = canopen::defaultSdoChannel(node_id);
  if (drive.inverter == 1 || drive.connection != CanopenConnection::kGateway) return predefined;
  // Six per gateway: a request and an answer for each of FI2 to FI4.
  const std::int64_t gateway = (node_id - 1) % 16, server = drive.inverter - 2;
  const std::int64_t first = kFirstFree + 6 * gateway + 2 * server;
  canopen::SdoChannel channel;
  channel.request_id = static_cast<std::uint32_t>(integerOr(settings, "sdo_request_id", first, 0x181, kLastFree));
  channel.response_id = static_cast<std::uint32_t>(integerOr(settings, "sdo_answer_id", first + 1, 0x181, kLastFree));
  return channel;
}

void checkSharedNode(const ModuleSettings& settings, const NodeConfig& node, const NodeConfig& first) {
  const struct {
    const char* key;
    bool same;
  } kShared[] = {
      {"device_type", node.device_type == first.device_type},
      {"vendor_id", node.vendor_id == first.vendor_id},
      {"product_code", node.product_code == first.product_code},
      {"revision_number", node.revision_number == first.revision_number},
      {"boot_reset", node.reset == first.reset},
      {"sdo_timeout", node.sdo_timeout == first.sdo_timeout},
      {"error_control", node.error_control.mode == first.error_control.mode},
      {"heartbeat_time", node.error_control.heartbeat_time == first.error_control.heartbeat_time},
      {"heartbeat_timeout", node.error_control.heartbeat_timeout == first.error_control.heartbeat_timeout},
      {"guard_time", node.error_control.guard_time == first.error_control.guard_time},
      {"life_time_factor", node.error_control.life_time_factor == first.error_control.life_time_factor},
      {"watch_master", node.error_control.master_timeout == first.error_control.master_timeout},
  };
  for (const auto& shared : kShared) {
    if (!shared.same) throw settings.differing(shared.key);
  }
}

}  // namespace nord_driver
