// Function codes and service access points of DP, as slave and referee know them: EN 50170.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nord_driver::sim {

// FC of a request, bits 0-3.
constexpr unsigned kSdaLow = 0x3;
constexpr unsigned kSdnLow = 0x4;
constexpr unsigned kSdaHigh = 0x5;
constexpr unsigned kSdnHigh = 0x6;
constexpr unsigned kFdlStatus = 0x9;
constexpr unsigned kSrdLow = 0xC;
constexpr unsigned kSrdHigh = 0xD;
constexpr unsigned kIdent = 0xE;
constexpr unsigned kLsapStatus = 0xF;

// FC of an answer.
constexpr std::uint8_t kAnswerOk = 0x00;
constexpr std::uint8_t kUserError = 0x01;
constexpr std::uint8_t kNoResource = 0x02;
constexpr std::uint8_t kServiceNotActive = 0x03;
constexpr std::uint8_t kDataLow = 0x08;
constexpr std::uint8_t kDataHigh = 0x0A;

constexpr std::uint8_t kSapResourceManager = 49;  // DP-V1, master class 2; its connections: 0 to 48
constexpr std::uint8_t kSapOfClass2Master = 50;
constexpr std::uint8_t kSapRecords = 51;  // DP-V1, master class 1
constexpr std::uint8_t kSapGlobalControl = 58;
constexpr std::uint8_t kSapGetConfiguration = 59;
constexpr std::uint8_t kSapDiagnosis = 60;
constexpr std::uint8_t kSapSetParameters = 61;
constexpr std::uint8_t kSapCheckConfiguration = 62;

constexpr std::uint8_t kBroadcast = 127;

// Set_Prm, byte 0.
constexpr std::uint8_t kLockRequest = 0x80;
constexpr std::uint8_t kUnlockRequest = 0x40;
constexpr std::uint8_t kSyncRequest = 0x20;
constexpr std::uint8_t kFreezeRequest = 0x10;
constexpr std::uint8_t kWatchdogOn = 0x08;
constexpr std::size_t kSetParametersMinimum = 7;
// The three bytes a DP-V1 slave has after these; DPV1_Status_1.
constexpr std::size_t kDpv1StatusBytes = 3;
constexpr std::uint8_t kDpv1Enable = 0x80;
constexpr std::uint8_t kWatchdogBase1ms = 0x04;

// Global_Control, byte 0; the "un" commands win.
constexpr std::uint8_t kClearData = 0x02;
constexpr std::uint8_t kUnfreeze = 0x04;
constexpr std::uint8_t kFreeze = 0x08;
constexpr std::uint8_t kUnsync = 0x10;
constexpr std::uint8_t kSync = 0x20;

// Slave_Diag, bytes 0 and 1.
constexpr std::uint8_t kNotReady = 0x02;
constexpr std::uint8_t kConfigurationFault = 0x04;
constexpr std::uint8_t kExtendedDiagnosis = 0x08;
constexpr std::uint8_t kParameterFault = 0x40;
constexpr std::uint8_t kParametersRequired = 0x01;
constexpr std::uint8_t kStaticDiagnosis = 0x02;
constexpr std::uint8_t kAlwaysOne = 0x04;
constexpr std::uint8_t kWatchdogRunning = 0x08;
constexpr std::uint8_t kFreezeMode = 0x10;
constexpr std::uint8_t kSyncMode = 0x20;

}  // namespace nord_driver::sim
