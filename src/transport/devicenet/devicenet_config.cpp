#include "transport/devicenet/devicenet_config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "devicenet/identifier.h"
#include "transport/devicenet/assembly.h"
#include "transport/devicenet/devicenet_drive_config.h"
#include "transport/devicenet/devicenet_eds.h"
#include "transport/devicenet/machine_serial.h"

namespace nord_driver {

namespace {

// BU 0280 P181; the slowest is assumed where nobody says which one it is.
constexpr std::array<std::uint32_t, 3> kBitRates{125'000, 250'000, 500'000};
constexpr double kMostLoad = 0.8;  // of the cycle: explicit messages need some, too

std::uint32_t readBitRate(const Settings& bus) {
  noteSetting(bus, "bit_rate", {"one of 125000, 250000, 500000", "", "bit/s", ""});
  if (!bus.has("bit_rate")) return 0;
  const std::int64_t rate = *bus.integer("bit_rate");
  if (std::find(kBitRates.begin(), kBitRates.end(), rate) != kBitRates.end()) return static_cast<std::uint32_t>(rate);
  throw wrongSetting(bus, "bit_rate", std::to_string(rate), "125000, 250000 or 500000 bit/s, as DeviceNet has them");
}

void readOwn(const Settings& bus, devicenet::ScannerConfig& scanner) {
  scanner.mac = static_cast<std::uint8_t>(integerOr(bus, "mac_id", 0, 0, devicenet::kMacIds - 1));
  scanner.own.vendor_id = static_cast<std::uint16_t>(integerOr(bus, "vendor_id", 0xFFFF, 0, 0xFFFF));
  scanner.own.serial_number = bus.has("serial_number")
                                  ? static_cast<std::uint32_t>(requiredInteger(bus, "serial_number", 0, 0xFFFFFFFF))
                                  : machineSerialNumber();
}

class Reader {
 public:
  Reader(const Settings& bus, DevicenetConfig& config, std::optional<Duration> packet_rate)
      : bus_(bus), config_(config), packet_rate_(packet_rate) {}

  /// `source` is one of `all`.
  void add(const DriveSettings& source, const std::vector<DriveSettings>& all) {
    const Settings& settings = *source.settings;
    const auto mac = requiredAddress(source, 0, devicenet::kMacIds - 1);
    const DevicenetDrive* first = firstAt(mac);
    const ModuleSettings of_module{source, all};
    const unsigned assembly = readAssembly(of_module);
    DevicenetDrive drive = readDevicenetDrive(source, assembly);
    if (drive.mac == config_.scanner.mac) {
      throw wrongSetting(settings, "address", std::to_string(drive.mac),
                         "another MAC id than ours, " + bus_.fullName("mac_id"));
    }
    devicenet::NodeConfig node;
    node.io.expected_packet_rate = packet_rate_;
    const DevicenetModule module = readDevicenetModule(of_module, drive, assembly, node);
    if (first == nullptr) {
      drive.module = config_.modules.size();
      config_.modules.push_back(module);
      config_.scanner.nodes.push_back(node);
    } else {
      drive.module = first->module;
      checkNeighbours(settings, drive);
      checkSharedModule(of_module, module, node, config_.modules[drive.module], config_.scanner.nodes[drive.module]);
    }
    // A module of one inverter has instance 1.
    if (drive.drive_profile != DevicenetProfile::kNord) {
      std::uint8_t& asked = config_.scanner.nodes[drive.module].asked_supervisors;
      asked = static_cast<std::uint8_t>(asked | 1u << (drive.inverter - 1));
    }
    config_.modules[drive.module].drives.push_back(config_.drives.size());
    config_.drives.push_back(drive);
  }

 private:
  const DevicenetDrive* firstAt(std::int64_t mac) const {
    for (const DevicenetDrive& drive : config_.drives) {
      if (drive.mac == mac) return &drive;
    }
    return nullptr;
  }

  void checkNeighbours(const Settings& settings, const DevicenetDrive& drive) const {
    for (const DevicenetDrive& other : config_.drives) {
      if (other.mac != drive.mac) continue;
      const bool gateways = drive.connection == DevicenetConnection::kGateway && other.connection == drive.connection;
      if (!gateways) {
        throw wrongSetting(
            settings, "address", std::to_string(drive.mac),
            "another MAC id than drive \"" + other.name + "\" has; only inverters behind one gateway share theirs");
      }
      if (other.inverter == drive.inverter) {
        throw wrongSetting(settings, "inverter", std::to_string(drive.inverter),
                           "another one of 1 to 4 than drive \"" + other.name + "\" has at the same MAC id, " +
                               std::to_string(drive.mac) + "; or another address");
      }
    }
  }

  const Settings& bus_;
  DevicenetConfig& config_;
  std::optional<Duration> packet_rate_;
};

// BU 0280 4.2.1.
void checkStrobe(const DevicenetModule& module, const devicenet::IoConfig& io,
                 const std::vector<DriveSettings>& drives) {
  if (io.kind != devicenet::IoKind::kStrobe || io.input_bytes <= devicenet::kStrobeCommandLength) return;
  const std::string partner = std::to_string(findAssembly(module.assembly)->input);
  throw wrongSetting(*drives[module.drives.front()].settings, "io", "\"strobe\"",
                     "poll, cos or cyclic: assembly " + partner + " has " + std::to_string(io.input_bytes) +
                         " bytes, and a bit strobe brings back at most " +
                         std::to_string(devicenet::kStrobeCommandLength));
}

void checkSizes(const Settings& bus, const DevicenetConfig& config, const std::vector<DriveSettings>& drives) {
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    const devicenet::IoConfig& io = config.scanner.nodes[i].io;
    checkStrobe(config.modules[i], io, drives);
    const std::size_t longest = std::max(io.input_bytes, io.output_bytes);
    if (longest <= kLongestAssembly) continue;
    throw ConfigError(bus.fullName("") + ": the inverters at MAC id " + std::to_string(config.modules[i].mac) +
                      " have " + std::to_string(longest) + " bytes of process data, an assembly holds at most " +
                      std::to_string(kLongestAssembly));
  }
}

void checkLoad(const Settings& bus, const DevicenetConfig& config, double cycle_rate) {
  const double wire = toSeconds(devicenet::cycleOnWire(config.scanner));
  if (wire <= kMostLoad / cycle_rate) return;
  const std::string rate = std::to_string(config.scanner.bit_rate);
  throw ConfigError(bus.fullName("bit_rate") + ": " + rate + " bit/s is too slow for " +
                    std::to_string(config.drives.size()) + " drives at " + shortNumber(cycle_rate) +
                    " Hz, their process data alone take up to " + shortNumber(std::ceil(wire * 1e4) / 1e4) +
                    " s of each " + shortNumber(1.0 / cycle_rate) + " s: expected a cycle_rate of at most " +
                    shortNumber(std::floor(kMostLoad / wire)) + " Hz, or the faster bit_rate the bus runs at" +
                    (config.bit_rate == 0 ? " (it is not configured, so the slowest is assumed)" : ""));
}

// Known before a program that serves parameters only takes the process data out.
void notePauses(DevicenetConfig& config) {
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    const devicenet::IoConfig& io = config.scanner.nodes[i].io;
    if (io.kind != devicenet::IoKind::kChangeOfState && io.kind != devicenet::IoKind::kCyclic) continue;
    config.modules[i].longest_pause = *io.expected_packet_rate + devicenet::kCoarsestStep;
  }
}

// A fragmented answer is on its way for a while.
Duration answerWindow(const Settings& bus, const DevicenetConfig& config, double cycle_rate) {
  const double wire = 1.5 * toSeconds(devicenet::cycleOnWire(config.scanner));
  const double usual = std::max(std::min(0.25 / cycle_rate, 0.005), wire);
  const double most = 0.9 / cycle_rate;
  return seconds(numberOr(bus, "answer_window", std::min(usual, most), 0.0, most, "s"));
}

}  // namespace

DevicenetConfig readDevicenetBus(const Settings& bus, double cycle_rate) {
  DevicenetConfig config;
  config.interface = requiredText(bus, "interface", "a CAN interface such as can0, or virtual:NAME");
  config.bit_rate = readBitRate(bus);
  config.scanner.bit_rate = config.bit_rate != 0 ? config.bit_rate : kBitRates[0];
  config.scanner.cycle_time = seconds(1.0 / cycle_rate);
  readOwn(bus, config.scanner);
  return config;
}

std::optional<Duration> readPacketRate(const Settings& bus) {
  using std::chrono::milliseconds;
  if (numberOr(bus, "expected_packet_rate", 0.0, 0.0, 65.535, "s") == 0.0) return std::nullopt;
  return wholeMillisecondsOr(bus, "expected_packet_rate", Duration::zero(), milliseconds{1}, milliseconds{65'535},
                             "0.025 s: the modules count them");
}

DevicenetConfig readDevicenetConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  DevicenetConfig config = readDevicenetBus(bus, cycle_rate);
  Reader reader{bus, config, readPacketRate(bus)};
  for (const DriveSettings& source : drives) reader.add(source, drives);
  layOut(config);
  checkSizes(bus, config, drives);
  applyEds(config, drives);
  checkLoad(bus, config, cycle_rate);
  config.answer_window = answerWindow(bus, config, cycle_rate);
  config.scanner = devicenet::completed(config.scanner);
  notePauses(config);
  try {
    devicenet::checkConfig(config.scanner);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(bus.fullName("") + ": " + error.what());
  }
  return config;
}

}  // namespace nord_driver
