#include "transport/devicenet/devicenet_drive_config.h"

#include <algorithm>
#include <array>

#include "config/setting_choice.h"
#include "config/setting_note.h"
#include "devicenet/identifier.h"
#include "profile/process_data_order.h"
#include "transport/devicenet/assembly.h"

namespace nord_driver {

namespace {

using devicenet::IoKind;
using profile::Series;

constexpr Choice<DevicenetConnection> kModules[] = {{"sk_cu4", DevicenetConnection::kGateway},
                                                    {"sk_tu4", DevicenetConnection::kGateway},
                                                    {"sk_tu1", DevicenetConnection::kOption},
                                                    {"sk_tu2", DevicenetConnection::kOption},
                                                    {"sk_tu3", DevicenetConnection::kOption}};
constexpr Choice<DevicenetProfile> kProfiles[] = {{"nord", DevicenetProfile::kNord},
                                                  {"ac_drive", DevicenetProfile::kAcDrive},
                                                  {"ac_drive_extended", DevicenetProfile::kAcDriveExtended}};
constexpr Choice<IoKind> kIoKinds[] = {
    {"poll", IoKind::kPoll}, {"cos", IoKind::kChangeOfState}, {"cyclic", IoKind::kCyclic}, {"strobe", IoKind::kStrobe}};
constexpr Choice<ParameterObjects> kParameterObjects[] = {{"numbered", ParameterObjects::kNumbered},
                                                          {"index_object", ParameterObjects::kIndexObject}};

enum class ValueOrder : std::uint8_t { kBySeries, kInOrder };
constexpr Choice<ValueOrder> kValueOrders[] = {{"by_series", ValueOrder::kBySeries},
                                               {"in_order", ValueOrder::kInOrder}};

// Those that have no system bus sit behind a technology unit of their own.
bool needsOption(Series series) noexcept {
  return series == Series::kSk300e || series == Series::kSk700e || series == Series::kSk750e;
}
bool needsGateway(Series series) noexcept {
  return series == Series::kSk1x0e || series == Series::kSk2xxe;
}

DevicenetConnection readConnection(const Settings& settings, Series series) {
  const auto usual = needsGateway(series) ? DevicenetConnection::kGateway : DevicenetConnection::kOption;
  const auto connection = choiceOr(settings, "module", usual, kModules);
  const std::string text = "\"" + settings.text("module").value_or("") + "\"";
  if (connection == DevicenetConnection::kGateway && needsOption(series)) {
    throw wrongSetting(settings, "module", text, "sk_tu1, sk_tu2 or sk_tu3: this series is only behind SK TU1/2/3-DEV");
  }
  if (connection == DevicenetConnection::kOption && needsGateway(series)) {
    throw wrongSetting(settings, "module", text, "sk_cu4 or sk_tu4: this series is only behind SK CU4/TU4-DEV");
  }
  return connection;
}

void checkPlace(const Settings& settings, const DevicenetDrive& drive, unsigned assembly) {
  if (drive.inverter == 1) return;
  const std::string inverter = std::to_string(drive.inverter);
  if (drive.connection == DevicenetConnection::kOption) {
    throw wrongSetting(settings, "inverter", inverter,
                       "1: SK TU1/2/3-DEV has one inverter (module: sk_cu4 has up to four)");
  }
  const AssemblyLayout& layout = *findAssembly(assembly);
  if (layout.inverters >= drive.inverter) return;
  throw wrongSetting(
      settings, "inverter", inverter,
      "1: assembly " + std::to_string(assembly) + " has " + std::to_string(layout.bytes) +
          " bytes, which are those of one inverter; four need assembly 102 (P160 = 5) or 120 (P160 = 0)");
}

// With P160 = 0 each inverter has its own lengths and profile (BU 0280 4.2.5). Of an odd length the last byte is the low
// half of a value: it is sent as 0 and not read.
std::size_t readLength(const Settings& settings, const char* key, const DevicenetDrive& drive, const char* index) {
  const std::int64_t bytes = integerOr(settings, key, 4, 0, 8);
  const bool nord = drive.drive_profile == DevicenetProfile::kNord;
  if (nord && bytes < 4) {
    const char* const why = bytes == 0 ? "0 bytes are those of an inverter that does not exist (BU 0280 4.2.5)"
                                       : "fewer than 4 bytes carry no setpoint or actual value";
    throw wrongSetting(settings, key, std::to_string(bytes),
                       "4 to 8, as P" + std::to_string(161 + drive.inverter) + " " + index + " says: " + why);
  }
  if (!nord && bytes != 4) {
    throw wrongSetting(settings, key, std::to_string(bytes), "4: the AC drive profile has four bytes each way");
  }
  return static_cast<std::size_t>(bytes);
}

void readVariable(const Settings& settings, DevicenetDrive& drive) {
  drive.drive_profile = choiceOr(settings, "profile", DevicenetProfile::kNord, kProfiles);
  drive.control_bytes = readLength(settings, "control_bytes", drive, "[-02]");
  drive.status_bytes = readLength(settings, "status_bytes", drive, "[-01]");
}

void readFixed(const Settings& settings, DevicenetDrive& drive, unsigned assembly) {
  const AssemblyLayout& layout = *findAssembly(assembly);
  drive.drive_profile = choiceOr(settings, "profile", layout.profile, kProfiles);
  const std::string name = "assembly " + std::to_string(assembly);
  if (drive.drive_profile != layout.profile) {
    throw wrongSetting(settings, "profile", "\"" + *settings.text("profile") + "\"",
                       "no such key: " + name + " implies it; only 120 lets each inverter have its own");
  }
  drive.control_bytes = layout.inverter_bytes;
  drive.status_bytes = layout.inverter_bytes;
  for (const char* key : {"control_bytes", "status_bytes"}) {
    const std::int64_t bytes = integerOr(settings, key, static_cast<std::int64_t>(layout.inverter_bytes), 0, 8);
    if (bytes == static_cast<std::int64_t>(layout.inverter_bytes)) continue;
    throw wrongSetting(settings, key, std::to_string(bytes),
                       std::to_string(layout.inverter_bytes) + ", as " + name + " has them; only 120 is free");
  }
}

bool readModuleByte(const Settings& settings, const char* key, const AssemblyLayout& layout) {
  const std::int64_t implied = layout.module_byte ? 1 : 0;
  const std::int64_t bytes = integerOr(settings, key, implied, 0, 1);
  if (bytes != implied && layout.output != kVariableAssembly) {
    throw wrongSetting(settings, key, std::to_string(bytes),
                       std::to_string(implied) + ", as assembly " + std::to_string(layout.output) + " has it");
  }
  return bytes == 1;
}

std::optional<std::uint16_t> readIdentity(const Settings& settings, const std::string& key) {
  if (!settings.has(key)) return std::nullopt;
  return static_cast<std::uint16_t>(requiredInteger(settings, key, 0, 0xFFFF));
}

// By the series on every other bus (BU 0020 7.3.6); BU 0280 4.2.2 has the words in order, of SK 2xxE. Of a position of 32
// bits the words are those behind the control word (BU 0280 4.2.1.1), which only leaves one place for another value.
bool thirdBeforeSecond(const Settings& settings, Series series) {
  const auto order = choiceOr(settings, "value_order", ValueOrder::kBySeries, kValueOrders);
  if (!profile::thirdBeforeSecond(series)) return false;
  const bool wide = settings.text("mode") == "position" && settings.integer("position/bits").value_or(32) == 32;
  return wide || order == ValueOrder::kBySeries;
}

}  // namespace

unsigned readAssembly(const Settings& settings) {
  const std::int64_t instance = integerOr(settings, "assembly", 100, 0, 255);
  noteSetting(settings, "assembly", {"one of 20, 21, 100, 101, 102, 120", "", "", "100"});
  if (findAssembly(static_cast<unsigned>(instance)) == nullptr) {
    throw wrongSetting(settings, "assembly", std::to_string(instance),
                       "20, 21, 100, 101, 102 or 120: the output instance P160 selects");
  }
  return static_cast<unsigned>(instance);
}

DevicenetDrive readDevicenetDrive(const DriveSettings& source, unsigned assembly) {
  const Settings& settings = *source.settings;
  DevicenetDrive drive{readDriveCommon(source)};
  drive.mac = static_cast<std::uint8_t>(requiredAddress(source, 0, devicenet::kMacIds - 1));
  drive.connection = readConnection(settings, drive.series);
  checkPlace(settings, drive, assembly);
  if (assembly == kVariableAssembly) {
    readVariable(settings, drive);
  } else {
    readFixed(settings, drive, assembly);
  }
  drive.third_before_second = thirdBeforeSecond(settings, drive.series);
  drive.parameter_objects = choiceOr(settings, "parameter_objects", ParameterObjects::kNumbered, kParameterObjects);
  return drive;
}

DevicenetModule readDevicenetModule(const Settings& settings, const DevicenetDrive& drive, unsigned assembly,
                                    devicenet::NodeConfig& node) {
  const AssemblyLayout& layout = *findAssembly(assembly);
  DevicenetModule module;
  module.mac = drive.mac;
  module.assembly = assembly;
  module.output_byte = readModuleByte(settings, "module_output_bytes", layout);
  module.input_byte = readModuleByte(settings, "module_input_bytes", layout);
  node.mac = drive.mac;
  node.io.kind = choiceOr(settings, "io", IoKind::kPoll, kIoKinds);
  node.vendor_id = readIdentity(settings, "vendor_id");
  node.device_type = readIdentity(settings, "device_type");
  node.product_code = readIdentity(settings, "product_code");
  return module;
}

void checkSharedModule(const ModuleSettings& settings, const DevicenetModule& module, const devicenet::NodeConfig& node,
                       const DevicenetModule& first, const devicenet::NodeConfig& first_node) {
  const struct {
    const char* key;
    bool same;
  } kShared[] = {
      {"assembly", module.assembly == first.assembly},
      {"io", node.io.kind == first_node.io.kind},
      {"module_output_bytes", module.output_byte == first.output_byte},
      {"module_input_bytes", module.input_byte == first.input_byte},
      {"vendor_id", node.vendor_id == first_node.vendor_id},
      {"device_type", node.device_type == first_node.device_type},
      {"product_code", node.product_code == first_node.product_code},
  };
  for (const auto& shared : kShared) {
    if (!shared.same) throw settings.differing(shared.key);
  }
}

}  // namespace nord_driver
