// The assemblies of NORD's DeviceNet modules: how long they are, and where an inverter's words are in them
// (BU 0280 4.2.2 to 4.2.5). Bytes are low byte first.
#pragma once

#include <cstddef>
#include <cstdint>

#include "devicenet/io_fragments.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/profile/process_data.h"
#include "profile/ac_drive.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver {

/// A pair that P160 selects. One for our outputs, its partner for our inputs; both have the same layout.
struct AssemblyLayout {
  unsigned output;             ///< instance: 100
  unsigned input;              ///< its partner: 110
  unsigned parameter;          ///< the value of P160
  std::size_t bytes;           ///< of both; 0: as P161 to P165 say
  bool module_byte;            ///< the first byte is the module's own
  std::uint8_t inverters;      ///< how many fit
  std::size_t inverter_bytes;  ///< of each; 0: as P162 to P165 say
  DevicenetProfile profile;
};

/// The instance that P161 to P165 lay out.
constexpr unsigned kVariableAssembly = 120;
/// What the variable assembly can hold at most.
constexpr std::size_t kLongestAssembly = 33;

/// By the output instance; nullptr for one there is not.
const AssemblyLayout* findAssembly(unsigned output) noexcept;

/// Sets the offsets of the drives of each module, and the sizes of its node. Bytes of one that is absent close up in the
/// variable assembly, and stay free in the others.
void layOut(DevicenetConfig& config);

/// Puts control word and setpoints, in the order of the drive's series, where they belong. `bytes` is long enough.
void packWords(const DevicenetDrive& drive, const profile::ProcessOutput& output, devicenet::IoBytes& bytes) noexcept;
/// False, and nothing written, when the assembly is too short. Values it does not carry become 0.
bool unpackWords(const DevicenetDrive& drive, ByteView bytes, profile::ProcessInput& input) noexcept;

void packAcDrive(const DevicenetDrive& drive, const profile::AcDriveOutput& output, devicenet::IoBytes& bytes) noexcept;
bool unpackAcDrive(const DevicenetDrive& drive, ByteView bytes, profile::AcDriveInput& input) noexcept;

}  // namespace nord_driver
