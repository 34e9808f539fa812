#include "transport/canopen/canopen_config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "canopen/nmt.h"
#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "transport/canopen/canopen_drive_config.h"
#include "transport/canopen/canopen_eds.h"

namespace nord_driver {

namespace {

using std::chrono::milliseconds;

constexpr std::uint32_t kSyncCobId = 0x080;       // CiA 301, pre-defined connection set; BU 0260 p. 50
constexpr std::uint32_t kUsualBitRate = 250'000;  // as delivered on SK 2xxE, P514 = 5 (BU 0280)
// P514 (BU 0280): 10, 20, 50, 100, 125, 250, 500 and 1000 kbit/s.
constexpr std::array<std::uint32_t, 8> kBitRates{10'000, 20'000, 50'000, 100'000, 125'000, 250'000, 500'000, 1'000'000};
constexpr double kMostLoad = 0.8;

std::uint32_t readBitRate(const Settings& bus) {
  std::string rates;
  for (const std::uint32_t known : kBitRates) rates += (rates.empty() ? "" : ", ") + std::to_string(known);
  noteSetting(bus, "bit_rate", {"one of " + rates, "", "bit/s", ""});
  if (!bus.has("bit_rate")) return 0;
  const std::int64_t rate = *bus.integer("bit_rate");
  if (std::find(kBitRates.begin(), kBitRates.end(), rate) != kBitRates.end()) return static_cast<std::uint32_t>(rate);
  throw wrongSetting(bus, "bit_rate", std::to_string(rate), "one of " + rates + " bit/s, as P514 has them");
}

// On the wire: 47 bits around the data, and at worst one stuffed bit after four (ISO 11898-1).
constexpr std::uint32_t frameBits(std::uint32_t bytes) noexcept {
  return 47 + 8 * bytes + (34 + 8 * bytes - 1) / 4;
}

void checkLoad(const Settings& bus, const CanopenConfig& config, double cycle_rate) {
  std::uint32_t bits = config.master.sync_cob_id ? frameBits(0) : 0;
  for (const CanopenDrive& drive : config.drives) bits += 2 * frameBits(2u + 2u * drive.process_values);
  const std::uint32_t rate = config.bit_rate != 0 ? config.bit_rate : kUsualBitRate;
  const double most = kMostLoad * rate / bits;
  if (cycle_rate <= most) return;
  throw ConfigError(bus.fullName("bit_rate") + ": " + std::to_string(rate) + " bit/s is too slow for " +
                    std::to_string(config.drives.size()) + " drives at " + shortNumber(cycle_rate) +
                    " Hz, their process data alone would fill the bus: expected a cycle_rate of at most " +
                    shortNumber(std::floor(most)) + " Hz, or the faster bit_rate the bus runs at");
}

void readOwnNode(const Settings& bus, canopen::MasterConfig& master) {
  const double heartbeat = numberOr(bus, "heartbeat", 0.0, 0.0, 65.535, "s");
  master.heartbeat_time = std::chrono::round<milliseconds>(seconds(heartbeat));
  const std::int64_t id = integerOr(bus, "node_id", canopen::kMaxNodeId, 1, canopen::kMaxNodeId);
  if (heartbeat > 0.0) master.own_id = static_cast<std::uint8_t>(id);
}

Duration readAnswerWindow(const Settings& bus, double cycle_rate) {
  const double quarter = 0.25 / cycle_rate;
  return seconds(numberOr(bus, "answer_window", std::min(quarter, 0.005), 0.0, 0.5 / cycle_rate, "s"));
}

class Reader {
 public:
  Reader(CanopenConfig& config, const CanopenBusDefaults& defaults) : config_(config), defaults_(defaults) {}

  /// `source` is one of `all`.
  void add(const DriveSettings& source, const std::vector<DriveSettings>& all) {
    const Settings& settings = *source.settings;
    CanopenDrive drive = readCanopenDrive(source);
    const ModuleSettings module{source, all};
    const canopen::NodeConfig node = readCanopenNode(module, drive, defaults_);
    checkOwnId(settings, node);
    drive.node = findOrAdd(settings, module, drive, node);
    canopen::NodeConfig& shared = config_.master.nodes[drive.node];
    addServer(settings, drive, shared);
    const CanopenPdoOptions pdo = readPdoOptions(settings, drive, defaults_);
    addPdos(drive, pdo, shared);
    drive.transmit_limit = limit(pdo);
    shared.first_answer_timeout = std::max(shared.first_answer_timeout, firstAnswerTimeout(drive));
    shared.silence = std::max(shared.silence, silence(drive, shared.error_control.mode));
    config_.drives.push_back(drive);
  }

 private:
  void checkOwnId(const Settings& settings, const canopen::NodeConfig& node) const {
    if (config_.master.own_id != node.id) return;
    throw wrongSetting(settings, "address", std::to_string(node.id),
                       "another node id than bus/node_id, which this computer's heartbeat bears");
  }

  // `settings`: of the drive itself, which has to be another one than those before it.
  std::size_t findOrAdd(const Settings& settings, const ModuleSettings& module, const CanopenDrive& drive,
                        const canopen::NodeConfig& node) {
    std::vector<canopen::NodeConfig>& nodes = config_.master.nodes;
    for (const CanopenDrive& other : config_.drives) {
      if (nodes[other.node].id != node.id) continue;
      const bool gateway = drive.connection == CanopenConnection::kGateway;
      if (!gateway || other.connection != CanopenConnection::kGateway) {
        throw wrongSetting(
            settings, "address", std::to_string(node.id),
            "another node id than drive \"" + other.name + "\" has; only inverters behind one gateway share theirs");
      }
      if (other.inverter == drive.inverter) {
        throw wrongSetting(settings, "inverter", std::to_string(drive.inverter),
                           "another one of 1 to 4 than drive \"" + other.name + "\" has behind the same gateway");
      }
      checkSharedNode(module, node, nodes[other.node]);
      return other.node;
    }
    nodes.push_back(node);
    return nodes.size() - 1;
  }

  // The first server is always there; those of FI2 to FI4 get their identifiers from us (1201h to 1203h).
  void addServer(const Settings& settings, CanopenDrive& drive, canopen::NodeConfig& node) const {
    if (node.sdo_servers.empty()) node.sdo_servers.push_back(canopen::defaultSdoChannel(node.id));
    const bool per_inverter = readParameterServers(settings, drive) == ParameterServers::kPerInverter;
    if (drive.connection != CanopenConnection::kGateway || drive.inverter == 1 || !per_inverter) return;
    const canopen::SdoChannel channel = readSdoServer(settings, drive, node.id);
    const auto index = static_cast<std::uint16_t>(0x1200 + drive.inverter - 1);
    node.setup.push_back({index, 1, channel.request_id, 4});
    node.setup.push_back({index, 2, channel.response_id, 4});
    drive.sdo_server = node.sdo_servers.size();
    node.sdo_servers.push_back(channel);
  }

  // Two and a half event times: one TPDO may be lost, and each may be late.
  Duration limit(const CanopenPdoOptions& pdo) const {
    if (pdo.synchronous) return 3 * defaults_.period;
    if (!pdo.event_time || *pdo.event_time == Duration::zero()) return Duration::zero();
    return *pdo.event_time * 5 / 2;
  }

  // A node that sends on changes only begins with what there is, or says nothing for a long time.
  static Duration firstAnswerTimeout(const CanopenDrive& drive) {
    return drive.transmit_limit > Duration::zero() ? drive.transmit_limit : Duration{milliseconds{100}};
  }

  // Where nothing else tells that a node has left operation: longer than `online` takes, so that what stops the drive
  // goes out while its RPDOs do.
  static Duration silence(const CanopenDrive& drive, canopen::ErrorControlMode mode) {
    const bool told = mode != canopen::ErrorControlMode::kNone;
    if (told || drive.transmit_limit == Duration::zero()) return Duration::zero();
    return std::max<Duration>(std::chrono::seconds{1}, 3 * drive.transmit_limit);
  }

  CanopenConfig& config_;
  const CanopenBusDefaults& defaults_;
};

}  // namespace

link::CanSettings readCanopenLink(const Settings& bus) {
  return {requiredText(bus, "interface", "a CAN interface such as can0, or virtual:NAME"), {}, readBitRate(bus)};
}

CanopenConfig readCanopenConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  CanopenConfig config;
  const link::CanSettings link = readCanopenLink(bus);
  config.interface = link.interface;
  config.bit_rate = link.bit_rate;
  config.answer_window = readAnswerWindow(bus, cycle_rate);
  readOwnNode(bus, config.master);
  CanopenBusDefaults defaults;
  defaults.sync = booleanOr(bus, "sync", false);
  defaults.period = seconds(1.0 / cycle_rate);
  defaults.sdo_timeout = seconds(numberOr(bus, "sdo_timeout", 0.3, 0.01, 60.0, "s"));
  defaults.heartbeat = config.master.own_id.has_value();
  if (defaults.sync) config.master.sync_cob_id = kSyncCobId;

  Reader reader{config, defaults};
  for (const DriveSettings& source : drives) reader.add(source, drives);
  // When all inverters behind a module have added theirs.
  for (std::size_t i = 0; i < drives.size(); ++i) {
    applyEds(*drives[i].settings, config.bit_rate, config.master.nodes[config.drives[i].node]);
  }
  checkLoad(bus, config, cycle_rate);
  try {
    canopen::checkConfig(config.master);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(bus.fullName("") + ": " + error.what());
  }
  return config;
}

}  // namespace nord_driver
