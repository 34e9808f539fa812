// One parameter access, the same for every bus: PKW, SDO, DP-V1 record and explicit message all answer it.
#pragma once

#include <cstdint>

namespace nord_driver::profile {

enum class ParameterAction : std::uint8_t {
  kRead,
  kWriteRam,         ///< lost at power off
  kWritePersistent,  ///< costs one of the EEPROM's 100 000 cycles (BU 0020 7.5 warning)
};

/// How the index of a parameter is built (BU 0020 7.5.2): from the parameter set, the array element, both or neither.
enum class ParameterShape : std::uint8_t { kPlain, kPerSet, kArray, kArrayPerSet };

struct ParameterRequest {
  std::uint32_t id = 0;      ///< chosen by the asker, comes back in the result
  std::uint16_t number = 0;  ///< the manual's: 102 for P102 (0..999)
  ParameterShape shape = ParameterShape::kPlain;
  std::uint8_t parameter_set = 1;  ///< 1..4, used by kPerSet and kArrayPerSet
  std::uint8_t index = 1;          ///< the manual's array index, [-01] = 1; used by kArray and kArrayPerSet
  ParameterAction action = ParameterAction::kRead;
  bool double_word = false;  ///< 32 bit value (writes only; an answer tells its own width)
  std::int32_t raw = 0;      ///< value to write
  /// A read of the drive layer itself: by this value it tells shares and speeds from each other from now on. A
  /// transport that carries speeds, not shares, tells them by the same one and by no other.
  bool scales = false;
};

enum class ParameterOutcome : std::uint8_t {
  kDone,
  kRefused,    ///< the inverter answered with an error number
  kTimeout,    ///< no matching answer in time
  kOffline,    ///< the drive answers nothing at the moment
  kNoChannel,  ///< this process data type carries no parameter channel (PPO 3, PPO 4)
  kBusy,       ///< too many requests wait already
};

struct ParameterResult {
  std::uint32_t id = 0;
  ParameterOutcome outcome = ParameterOutcome::kTimeout;
  std::uint16_t error_number = 0;  ///< with kRefused: see parameter_error.h
  std::uint32_t abort_code = 0;    ///< with kRefused, CANopen: the SDO abort code behind error_number; 0: none
  std::int32_t raw = 0;            ///< with kDone: the value read, or read back
};

}  // namespace nord_driver::profile
