// Where a NORD inverter keeps its process data and parameters in a CANopen object dictionary, and how its PDOs are
// laid out.
//
//   SK TU1/2/3-CAO, SK 5xxE's own port (BU 0060 p. 58, 59): control word 3000h, status word 3001h, setpoints 3002h:1..,
//   actual values 3003h:1..; PDO 1 carries a word and value 1, PDO 2 a word and three values. All RPDOs are on, of the
//   TPDOs only the first: for three actual values TPDO 1 is switched off and TPDO 2 on.
//   SK CU4/TU4-CAO (BU 0260 p. 40 to 52): PDO n is inverter n's, a word and three values; 3000h:n, 3002h:3n-2..3n.
//   CiA 402 (BU 0060 p. 57): 6040h and 6042h, 6041h and 6044h in PDO 1.
// Bytes are low byte first (BU 0060 p. 96).
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/node_config.h"
#include "core/can_frame.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/process_data.h"
#include "profile/cia402.h"
#include "transport/canopen/canopen_config.h"

namespace nord_driver {

/// What the PDOs of a drive shall be.
struct CanopenPdoOptions {
  bool synchronous = false;              ///< with every SYNC, and not at once on a change
  std::optional<Duration> inhibit_time;  ///< none: left as it is
  std::optional<Duration> event_time;    ///< none: left as it is
  bool write_mapping = false;            ///< false: the mapping is left as it is
};

/// Adds the drive's PDOs to its node and notes in the drive which ones they are.
void addPdos(CanopenDrive& drive, const CanopenPdoOptions& pdo, canopen::NodeConfig& node);

using PdoBytes = FixedBytes<kCanDataLength>;

/// Control word and setpoints in the order of the drive's series.
PdoBytes packPdo(const CanopenDrive& drive, const profile::ProcessOutput& output) noexcept;
/// False, and nothing written, when the PDO is too short. Values it does not carry become 0.
bool unpackPdo(const CanopenDrive& drive, ByteView bytes, profile::ProcessInput& input) noexcept;

PdoBytes packCia402(const profile::Cia402Output& output) noexcept;
bool unpackCia402(ByteView bytes, profile::Cia402Input& input) noexcept;

struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
};

/// The object of a parameter: none when the request names no parameter (number above 999, set beyond 1..4, element 0,
/// or one whose sub-index would not fit a byte).
std::optional<ObjectAddress> parameterObject(const CanopenDrive& drive,
                                             const profile::ParameterRequest& request) noexcept;

}  // namespace nord_driver
