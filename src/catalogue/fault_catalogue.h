// Fault, error and abort numbers in words, from the files of the project and those a user lays over them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catalogue/device.h"
#include "catalogue/yaml_map.h"

namespace nord_driver::catalogue {

/// Which numbers a file is about; `codes:` of the files.
enum class FaultCodes : std::uint8_t {
  kP700,               ///< of the inverters in P700 and P701, raw: the printed number times ten
  kP170,               ///< of the bus modules in their P170, raw
  kEmcy,               ///< CANopen EMCY
  kDrivecom,           ///< DRIVECOM object 603Fh
  kPkw,                ///< error numbers of the parameter channel
  kDpv1,               ///< Error_Code_1 of DP-V1
  kDpv1Abort,          ///< reasons of an MS2 abort
  kSdoAbort,           ///< SDO abort codes
  kDevicenetGeneral,   ///< general codes of DeviceNet error answers
  kDevicenetAllocate,  ///< additional codes of a refused allocation
};

constexpr std::array<FaultCodes, 10> kAllFaultCodes{FaultCodes::kP700,
                                                    FaultCodes::kP170,
                                                    FaultCodes::kEmcy,
                                                    FaultCodes::kDrivecom,
                                                    FaultCodes::kPkw,
                                                    FaultCodes::kDpv1,
                                                    FaultCodes::kDpv1Abort,
                                                    FaultCodes::kSdoAbort,
                                                    FaultCodes::kDevicenetGeneral,
                                                    FaultCodes::kDevicenetAllocate};

/// "p700", "devicenet_general", as the files write it.
const char* toString(FaultCodes codes) noexcept;

struct FaultEntry {
  std::uint32_t number = 0;  ///< raw: 102 for 10.2
  std::optional<std::string> name;
  std::optional<std::string> cause;   ///< a clause
  std::optional<std::string> remedy;  ///< a clause
  std::optional<std::string> note;
  std::optional<std::string> erratum;
  /// The numbers behind this one, raw: of P700 for EMCY, of the parameter channel for SDO aborts.
  std::vector<std::uint32_t> stands_for;
  std::vector<std::string> source;
  Place place;
};

class FaultCatalogue {
 public:
  /// In this order: an entry of a later file corrects one of an earlier file key by key, or adds one. Throws ConfigError
  /// with one sentence on what is wrong in which file.
  static FaultCatalogue load(const std::vector<std::string>& files);

  /// The entry of a number that holds for every device; nullptr: not described.
  const FaultEntry* find(FaultCodes codes, std::uint32_t number) const;
  /// That of the device, or the one that holds for every device.
  const FaultEntry* find(FaultCodes codes, std::uint32_t number, const Device& device) const;
  /// Those that hold for every device, in the order of the numbers; with a device those of this device alone.
  std::vector<const FaultEntry*> all(FaultCodes codes, const std::optional<Device>& device = std::nullopt) const;

 private:
  using Key = std::pair<FaultCodes, std::optional<Device>>;
  std::map<Key, std::map<std::uint32_t, FaultEntry>> entries_;
};

/// "E10.2", "1020", "8100h", "06090011h": as displays and manuals write the number.
std::string faultLabel(FaultCodes codes, std::uint32_t number);

}  // namespace nord_driver::catalogue
