#include "transport/profibus/profibus_stations.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "profibus/configuration_bytes.h"
#include "transport/module_signals.h"

namespace nord_driver {

namespace {

using profile::Series;

constexpr std::uint8_t kIoSlot = 0x30, kEmptySlot = 0x00;  // BU 0220 4.2.2.4; P182 shows 48 for the first
// DPV1_Status_1. With the second the slave counts its watchdog in steps of 1 ms, not in those of 10 ms that it is given.
constexpr std::uint8_t kDpv1Enable = 0x80, kWatchdogBase1ms = 0x04;
constexpr Duration kRecordTimeout = std::chrono::seconds{1};
constexpr const char* kTuName = "SK TU1/2/3-PBR";
constexpr const char* kCuName = "SK CU4/TU4-PBR";

/// One drive as configured, before its station is known as a whole.
struct Plan {
  const DriveSettings* source = nullptr;
  DriveCommon drive;
  ProfibusModule module = ProfibusModule::kSkTu3;
  profibus::StationAddress address;
  std::uint8_t ppo_type = 1;
  std::optional<bool> io_byte;
  std::optional<std::string> user_parameters, gsd;
};

// SK 1x0E and SK 2xxE reach PROFIBUS only through SK CU4/TU4-PBR, SK 300E and 7x0E only through their own technology
// units; SK 5xxE and SK 54xE have both ways, and mostly SK TU3-PBR (BU 2700 3.1).
ProfibusModule readModule(const Settings& settings, Series series) {
  const bool only_cu4 = series == Series::kSk1x0e || series == Series::kSk2xxe;
  const bool either = series == Series::kSk5xxe || series == Series::kSk54xe;
  noteSetting(settings, "module",
              {"one of sk_tu1, sk_tu2, sk_tu3, sk_cu4, sk_tu4", "", "", only_cu4 ? "sk_cu4" : "sk_tu3"});
  const auto text = settings.text("module");
  if (!text) return only_cu4 ? ProfibusModule::kSkCu4 : ProfibusModule::kSkTu3;
  const bool with_slots = *text == "sk_cu4" || *text == "sk_tu4";
  const bool plain = *text == "sk_tu1" || *text == "sk_tu2" || *text == "sk_tu3";
  if (with_slots && (only_cu4 || either)) return ProfibusModule::kSkCu4;
  if (plain && !only_cu4) return ProfibusModule::kSkTu3;
  throw wrongSetting(settings, "module", "\"" + *text + "\"",
                     either     ? "sk_tu3 (SK TU3-PBR), sk_cu4 or sk_tu4 (SK CU4/TU4-PBR)"
                     : only_cu4 ? "sk_cu4 or sk_tu4: this series is only behind SK CU4/TU4-PBR"
                                : "sk_tu1, sk_tu2 or sk_tu3: this series is only behind SK TU1/2/3-PBR");
}

// BU 2700 5.2.4.
profibus::StationAddress readAddress(const DriveSettings& source, const DriveCommon& drive, ProfibusUse use) {
  constexpr std::int64_t kFirst = 3, kLast = 125, kFactory = 126;
  if (use == ProfibusUse::kRecordsOnly) {
    return *profibus::StationAddress::from(static_cast<int>(requiredAddress(source, kFirst, kFactory)));
  }
  if (drive.address == kFactory) {
    throw wrongSetting(*source.settings, "address", std::to_string(kFactory),
                       "a whole number from 3 to 125: 126 is what a module has from the factory, give it an address of "
                       "its own");
  }
  return *profibus::StationAddress::from(static_cast<int>(requiredAddress(source, kFirst, kLast)));
}

Plan readPlan(const DriveSettings& source, ProfibusUse use) {
  const Settings& settings = *source.settings;
  Plan plan;
  plan.source = &source;
  plan.drive = readDriveCommon(source);
  plan.module = readModule(settings, plan.drive.series);
  plan.address = readAddress(source, plan.drive, use);
  plan.ppo_type = static_cast<std::uint8_t>(integerOr(settings, "ppo_type", 1, 1, 4));
  plan.io_byte = settings.boolean("io_byte");
  if (!plan.io_byte && usesModuleSignals(settings)) plan.io_byte = true;
  plan.user_parameters = settings.text("user_parameters");
  plan.gsd = settings.text("gsd");
  if (plan.module == ProfibusModule::kSkTu3) {
    if (plan.drive.inverter != 1) {
      throw wrongSetting(settings, "inverter", std::to_string(plan.drive.inverter),
                         std::string{"1: "} + kTuName + " serves one inverter");
    }
    if (plan.io_byte.value_or(false)) {
      throw wrongSetting(settings, "io_byte", "true",
                         std::string{"false: only "} + kCuName + " has inputs and outputs of its own");
    }
  }
  return plan;
}

std::vector<std::uint8_t> bytesOf(const Settings& settings, const std::string& text) {
  constexpr const char* kKey = "user_parameters";
  std::vector<std::uint8_t> bytes;
  try {
    bytes = fromHex(text);
  } catch (const std::invalid_argument&) {
    throw wrongSetting(settings, kKey, "\"" + text + "\"", "hexadecimal bytes such as \"00 1A FF\"");
  }
  if (bytes.size() > profibus::kMaxUserParameters) {
    throw wrongSetting(settings, kKey, std::to_string(bytes.size()) + " bytes",
                       "at most " + std::to_string(profibus::kMaxUserParameters));
  }
  return bytes;
}

/// Of the whole station: any of its drives may say it, and all that do must say the same.
template <typename T, typename Print>
std::optional<T> agreed(const std::vector<Plan>& plans, std::optional<T> Plan::*member, const char* key, Print print) {
  const Plan* first = nullptr;
  for (const Plan& plan : plans) {
    if (!(plan.*member)) continue;
    if (first == nullptr) first = &plan;
    if (plan.*member == first->*member) continue;
    throw wrongSetting(*plan.source->settings, key, print(*(plan.*member)),
                       std::string{print(*(first->*member))} + ", as drive \"" + first->source->name +
                           "\" behind the same module has it");
  }
  return first == nullptr ? std::nullopt : first->*member;
}

class StationBuilder {
 public:
  StationBuilder(const Settings& bus, ProfibusGsdLibrary& gsd, ProfibusDpConfig& config)
      : bus_(bus), gsd_library_(gsd), config_(config) {}

  /// `plans` are of one station, by inverter number; their drives are in `config_.drives` already.
  void build(std::size_t index, const std::vector<Plan>& plans, const std::vector<std::size_t>& drives) {
    const Plan& first = plans.front();
    const Settings& settings = *first.source->settings;
    ProfibusStation& station = config_.stations[index];
    profibus::SlaveConfig& slave = config_.slaves[index];
    const bool modular = first.module == ProfibusModule::kSkCu4;
    station.module = first.module;
    station.drives = drives;
    station.io_byte =
        agreed(plans, &Plan::io_byte, "io_byte", [](bool on) { return on ? "true" : "false"; }).value_or(false);
    slave.address = first.address;
    slave.ident_number = modular ? profile::kIdentCu4Tu4 : profile::kIdentTechnologyUnit;
    slave.watchdog = config_.watchdog;
    if (modular) {
      slave.user_parameters = {kDpv1Enable, 0x00, 0x00};
      slave.dpv1 = true;
      slave.record_timeout = kRecordTimeout;
    }
    const Settings* naming = &settings;  // the drive that names a file itself, if one does
    for (const Plan& plan : plans) {
      if (plan.gsd && !naming->has("gsd")) naming = plan.source->settings.get();
    }
    agreed(plans, &Plan::gsd, "gsd", [](const std::string& path) { return path; });
    gsd_ = gsd_library_.find(*naming, slave.ident_number);
    if (gsd_ != nullptr) takeGsd(settings, station, slave);

    modules_ = 0;
    if (modular) addSlot(slave, station.io_byte ? kIoSlot : kEmptySlot, station.io_byte ? 1 : 0);
    std::uint8_t slot_inverter = 1;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      for (; slot_inverter < plans[i].drive.inverter; ++slot_inverter) addSlot(slave, kEmptySlot, 0);
      addInverter(plans[i], config_.drives[drives[i]], slave);
      ++slot_inverter;
    }
    const auto text =
        agreed(plans, &Plan::user_parameters, "user_parameters", [](const std::string& hex) { return hex; });
    if (text) {
      slave.user_parameters = bytesOf(settings, *text);
      slave.dpv1 = slave.dpv1 && slave.user_parameters.size() >= 3 && (slave.user_parameters[0] & kDpv1Enable) != 0;
    }
    const bool dpv1_slave = gsd_ != nullptr ? gsd_->file.dpv1 : modular;
    const bool base_1ms =
        dpv1_slave && !slave.user_parameters.empty() && (slave.user_parameters[0] & kWatchdogBase1ms) != 0;
    if (base_1ms && text) {
      throw wrongSetting(settings, "user_parameters", "\"" + *text + "\"",
                         "bit 2 of the first byte (WD_Base_1ms) 0: the watchdog is given in steps of 10 ms");
    }
    if (base_1ms) slave.user_parameters[0] ^= kWatchdogBase1ms;
    if (gsd_ != nullptr) {
      checkLengths(settings, slave);
      checkParameters(settings, slave.user_parameters.size());
    }
  }

 private:
  static void addParameters(profibus::SlaveConfig& slave, const profibus::GsdModule& module) {
    slave.user_parameters.insert(slave.user_parameters.end(), module.user_parameters.begin(),
                                 module.user_parameters.end());
  }

  // A module of the file that is the same may have parameters of its own.
  void addSlot(profibus::SlaveConfig& slave, std::uint8_t identifier, std::size_t bytes) {
    ++modules_;
    slave.configuration.push_back(identifier);
    if (gsd_ != nullptr) {
      const auto& modules = gsd_->file.modules;
      const auto same = std::find_if(modules.begin(), modules.end(), [identifier](const profibus::GsdModule& module) {
        return module.configuration.size() == 1 && module.configuration.front() == identifier;
      });
      if (same != modules.end()) addParameters(slave, *same);
    }
    slave.output_length += bytes;
    slave.input_length += bytes;
  }

  void takeGsd(const Settings& settings, ProfibusStation& station, profibus::SlaveConfig& slave) {
    const profibus::GsdFile& file = gsd_->file;
    if (file.ident_number) slave.ident_number = *file.ident_number;
    slave.user_parameters = file.user_parameters;
    slave.dpv1 = file.dpv1 && file.c1_read_write;
    if (slave.dpv1) {
      slave.user_parameters.resize(std::max<std::size_t>(slave.user_parameters.size(), 3), 0);
      slave.user_parameters[0] |= kDpv1Enable;  // left open by files whose engineering tool sets it
    }
    if (file.c1_response_timeout > Duration::zero()) slave.record_timeout = file.c1_response_timeout;
    station.min_interval = file.min_slave_interval;
    station.max_tsdr_bits = file.maxTsdrBits(config_.bus.baud.bitsPerSecond());
    if (!file.rates.empty() && !supportsRate(file, config_.bus.baud)) refuseRate(settings);
    if ((config_.bus.sync_outputs && !file.sync_supported) || (config_.bus.freeze_inputs && !file.freeze_supported)) {
      config_.warnings.push_back(gsd_->path + ": this module knows no " +
                                 (config_.bus.sync_outputs && !file.sync_supported ? "SYNC" : "FREEZE"));
    }
  }

  void refuseRate(const Settings& settings) const {
    std::string rates;
    for (const profibus::GsdRate& rate : gsd_->file.rates) {
      if (rate.supported) rates += (rates.empty() ? "" : ", ") + std::to_string(rate.bits_per_second);
    }
    throw wrongSetting(bus_, "baud_rate", std::to_string(config_.bus.baud.bitsPerSecond()),
                       "a rate of the module of " + settings.fullName("") + " (" + gsd_->path +
                           "): " + (rates.empty() ? "it names none" : rates));
  }

  void addInverter(const Plan& plan, ProfibusDrive& drive, profibus::SlaveConfig& slave) {
    const std::uint16_t layout_ident =
        plan.module == ProfibusModule::kSkCu4 ? profile::kIdentCu4Tu4 : profile::kIdentTechnologyUnit;
    drive.ppo = *profile::ppoLayout(plan.ppo_type, layout_ident, drive.series);
    drive.offset = slave.output_length;
    std::vector<std::uint8_t> identifiers(drive.ppo.identifiers.begin(), drive.ppo.identifiers.end());
    if (gsd_ != nullptr && !gsd_->file.modules.empty()) {
      if (const auto* module = findPpoModule(gsd_->file, plan.ppo_type, drive.ppo)) {
        identifiers = module->configuration;
        takeLength(plan, *module, drive);
        addParameters(slave, *module);
      } else {
        config_.warnings.push_back(gsd_->path + " has no module that is PPO " + std::to_string(plan.ppo_type) +
                                   " by name or by its identifiers " + toHex(drive.ppo.identifiers) +
                                   ": the identifiers of the manual are used");
      }
    }
    ++modules_;  // one, however many identifiers it has
    slave.configuration.insert(slave.configuration.end(), identifiers.begin(), identifiers.end());
    slave.output_length += drive.ppo.bytes();
    slave.input_length += drive.ppo.bytes();
  }

  // The manuals contradict each other on reserve words: the file decides.
  void takeLength(const Plan& plan, const profibus::GsdModule& module, ProfibusDrive& drive) const {
    const auto lengths = profibus::ioLengths(module.configuration);
    const std::size_t pkw = drive.ppo.has_pkw ? 8 : 0;
    const std::size_t least = pkw + 2 * (std::size_t{1} + drive.ppo.process_values);
    const std::size_t most = pkw + 12;
    const std::size_t bytes = lengths ? lengths->outputs : 0;
    if (!lengths || lengths->inputs != bytes || bytes % 2 != 0 || bytes < least || bytes > most) {
      throw wrongSetting(*plan.source->settings, "ppo_type", std::to_string(plan.ppo_type),
                         "a type whose module carries " + std::to_string(least) + " to " + std::to_string(most) +
                             " bytes each way; \"" + module.name + "\" of " + gsd_->path + " is " +
                             toHex(module.configuration));
    }
    drive.ppo.process_words = static_cast<std::uint8_t>((bytes - pkw) / 2);
  }

  void checkLengths(const Settings& settings, const profibus::SlaveConfig& slave) const {
    const profibus::GsdFile& file = gsd_->file;
    const auto above = [](std::size_t length, unsigned limit) { return limit != 0 && length > limit; };
    if (above(slave.output_length, file.max_output_length) || above(slave.input_length, file.max_input_length) ||
        above(slave.output_length + slave.input_length, file.max_data_length)) {
      throw ConfigError(settings.fullName("ppo_type") + ": the station would carry " +
                        std::to_string(slave.output_length) + " bytes each way, expected at most " +
                        std::to_string(file.max_output_length) + " out, " + std::to_string(file.max_input_length) +
                        " in, " + std::to_string(file.max_data_length) + " together (" + gsd_->path + ")");
    }
    if (file.max_modules != 0 && modules_ > file.max_modules) {
      throw ConfigError(settings.fullName("inverter") + ": " + std::to_string(modules_) +
                        " modules are needed, expected at most " + std::to_string(file.max_modules) + " (" +
                        gsd_->path + ")");
    }
  }

  // A slave refuses a longer Set_Prm with Prm_Fault.
  void checkParameters(const Settings& settings, std::size_t length) const {
    const unsigned limit = gsd_->file.max_user_parameters;
    if (limit == 0 || length <= limit) return;
    throw ConfigError(settings.fullName("user_parameters") + ": Set_Prm would carry " + std::to_string(length) +
                      " bytes of station and modules, expected at most " + std::to_string(limit) +
                      " (Max_User_Prm_Data_Len of " + gsd_->path + ")");
  }

  const Settings& bus_;
  ProfibusGsdLibrary& gsd_library_;
  ProfibusDpConfig& config_;
  const GsdEntry* gsd_ = nullptr;
  std::size_t modules_ = 0;  // of the station, empty slots included
};

/// The station of a drive; a new one when nobody has its address yet.
std::size_t stationOf(const Plan& plan, const std::vector<Plan>& others, ProfibusDpConfig& config) {
  const Settings& settings = *plan.source->settings;
  const auto number = std::to_string(plan.address.value());
  if (plan.address == config.bus.master) {
    throw wrongSetting(settings, "address", number, "another address than the master's own");
  }
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Plan& other = others[i];
    if (other.address != plan.address) continue;
    if (plan.module == ProfibusModule::kSkTu3 || other.module == ProfibusModule::kSkTu3) {
      throw wrongSetting(settings, "address", number, "another address than drive \"" + other.source->name + "\" has");
    }
    for (const Plan& neighbour : others) {
      if (neighbour.address != plan.address || neighbour.drive.inverter != plan.drive.inverter) continue;
      throw wrongSetting(
          settings, "inverter", std::to_string(plan.drive.inverter),
          "another number from 1 to 4 than drive \"" + neighbour.source->name + "\" behind the same module has");
    }
    return config.drives[i].slave;
  }
  config.slaves.emplace_back();
  config.stations.emplace_back();
  return config.slaves.size() - 1;
}

}  // namespace

void readStations(const Settings& bus, const std::vector<DriveSettings>& drives, ProfibusGsdLibrary& gsd,
                  ProfibusDpConfig& config) {
  std::vector<Plan> plans;
  for (const DriveSettings& source : drives) {
    const Plan plan = readPlan(source, config.use);
    ProfibusDrive drive{plan.drive};
    drive.slave = stationOf(plan, plans, config);
    config.drives.push_back(drive);
    plans.push_back(plan);
  }
  StationBuilder builder{bus, gsd, config};
  for (std::size_t station = 0; station < config.stations.size(); ++station) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      if (config.drives[i].slave == station) members.push_back(i);
    }
    std::sort(members.begin(), members.end(),
              [&](std::size_t a, std::size_t b) { return plans[a].drive.inverter < plans[b].drive.inverter; });
    std::vector<Plan> own;
    own.reserve(members.size());
    for (const std::size_t member : members) own.push_back(plans[member]);
    builder.build(station, own, members);
  }
  gsd.warnOfUnused();
}

}  // namespace nord_driver
