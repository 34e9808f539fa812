#include "profibus/dp_services.h"

#include <array>

#include "profibus/class2_pdu.h"
#include "profibus/diagnosis.h"
#include "profibus/watchdog_factors.h"

namespace nord_driver::profibus {

namespace {

// Service access points of the slave; the master's is 62 (MS0). Data exchange has none.
constexpr std::uint8_t kMasterSap = 62;
constexpr std::uint8_t kRecordSap = 51;  // MS1, on both sides
constexpr std::uint8_t kGlobalControlSap = 58;
constexpr std::uint8_t kGetCfgSap = 59;
constexpr std::uint8_t kSlaveDiagSap = 60;
constexpr std::uint8_t kSetPrmSap = 61;
constexpr std::uint8_t kChkCfgSap = 62;

// First byte of Set_Prm. Sync_Req and Freeze_Req only where the bus uses them: a slave that was not told ignores SYNC.
// Without Lock_Req a slave does not go on to data exchange.
constexpr std::uint8_t kLockRequest = 0x80;
constexpr std::uint8_t kSyncRequest = 0x20;
constexpr std::uint8_t kFreezeRequest = 0x10;
constexpr std::uint8_t kWatchdogOn = 0x08;

// First byte of Global_Control.
constexpr std::uint8_t kUnfreeze = 0x04;
constexpr std::uint8_t kFreeze = 0x08;
constexpr std::uint8_t kUnsync = 0x10;
constexpr std::uint8_t kSync = 0x20;

constexpr std::size_t kSd3Octets = 8;

using PrmBytes = FixedBytes<kMaxIoLength>;

PrmBytes prmBytes(const SlaveConfig& slave, std::uint16_t ident, std::uint8_t requests) noexcept {
  const auto factors = WatchdogFactors::from(slave.watchdog);
  const WatchdogFactors sent = factors.value_or(WatchdogFactors{});  // 1 and 1 while the watchdog is off
  PrmBytes bytes;
  ByteWriter<kMaxIoLength> writer{bytes};
  writer.u8(static_cast<std::uint8_t>(kLockRequest | requests | (factors ? kWatchdogOn : 0u)));
  writer.u8(sent.f1);
  writer.u8(sent.f2);
  writer.u8(slave.min_tsdr_bits);
  writer.u16be(ident);
  writer.u8(slave.group);
  writer.append(slave.user_parameters);
  return bytes;
}

TelegramKind kindFor(std::size_t octets, bool send_sd3) noexcept {
  if (octets == 0) return TelegramKind::kSd1;
  return send_sd3 && octets == kSd3Octets ? TelegramKind::kSd3 : TelegramKind::kSd2;
}

/// Set_Prm and Chk_Cfg are answered by SC.
void expectAcknowledge(FdlRequest& request) noexcept {
  request.short_acknowledge_legal = true;
  request.acknowledge_legal = true;
  request.data_legal = false;
}

}  // namespace

DpServices::Route DpServices::toServer(std::uint8_t dsap) noexcept {
  return {kSendRequestDataHigh, dsap, kMasterSap};
}

void DpServices::ask(FdlRequest& request, StationAddress slave, std::uint8_t count_bits, const Route& route,
                     ByteView data) const noexcept {
  request = FdlRequest{};
  request.station = slave.value();
  request.retries = retries_;
  request.dsap = route.dsap;
  request.ssap = route.ssap;

  Telegram telegram;
  telegram.kind = kindFor(data.size() + (route.dsap ? 2u : 0u), send_sd3_);
  telegram.da = slave.value();
  telegram.sa = master_.value();
  telegram.fc = static_cast<std::uint8_t>(route.function | count_bits);
  telegram.dsap = request.dsap;
  telegram.ssap = request.ssap;
  telegram.data = data;
  encode(telegram, request.frame);
}

void DpServices::fdlStatus(FdlRequest& request, StationAddress slave) const noexcept {
  request = FdlRequest{};
  request.station = slave.value();
  request.acknowledge_legal = true;
  request.data_legal = false;
  request.any_station_type = true;

  Telegram telegram;
  telegram.kind = TelegramKind::kSd1;
  telegram.da = slave.value();
  telegram.sa = master_.value();
  telegram.fc = kRequestFdlStatus;
  encode(telegram, request.frame);
}

void DpServices::slaveDiag(FdlRequest& request, StationAddress slave, std::uint8_t count_bits) const noexcept {
  ask(request, slave, count_bits, toServer(kSlaveDiagSap), {});
  request.min_data = Diagnosis::kStandardLength;
  request.max_data = Diagnosis::kMaxLength;
}

void DpServices::setPrm(FdlRequest& request, const SlaveConfig& slave, std::uint16_t ident,
                        std::uint8_t count_bits) const noexcept {
  unsigned requests = 0;
  if (isSynchronised(slave)) requests = (sync_outputs_ ? kSyncRequest : 0u) | (freeze_inputs_ ? kFreezeRequest : 0u);
  ask(request, slave.address, count_bits, toServer(kSetPrmSap),
      prmBytes(slave, ident, static_cast<std::uint8_t>(requests)));
  expectAcknowledge(request);
}

void DpServices::chkCfg(FdlRequest& request, const SlaveConfig& slave, std::uint8_t count_bits) const noexcept {
  ask(request, slave.address, count_bits, toServer(kChkCfgSap), slave.configuration);
  expectAcknowledge(request);
}

void DpServices::getCfg(FdlRequest& request, StationAddress slave, std::uint8_t count_bits) const noexcept {
  ask(request, slave, count_bits, toServer(kGetCfgSap), {});
  request.min_data = 1;
  request.max_data = kMaxIoLength;
}

void DpServices::dataExchange(FdlRequest& request, const SlaveConfig& slave, ByteView outputs,
                              std::uint8_t count_bits) const noexcept {
  ask(request, slave.address, count_bits, {kSendRequestDataHigh, std::nullopt, std::nullopt}, outputs);
  request.min_data = slave.input_length;
  request.max_data = slave.input_length;
  // Only a slave that has nothing to say may acknowledge without data.
  request.short_acknowledge_legal = slave.input_length == 0;
  request.acknowledge_legal = slave.input_length == 0;
}

void DpServices::record(FdlRequest& request, StationAddress slave, ByteView pdu,
                        std::uint8_t count_bits) const noexcept {
  askAcyclic(request, slave, kRecordSap, kRecordSap, pdu, count_bits);
}

void DpServices::class2(FdlRequest& request, StationAddress slave, std::uint8_t access_point, ByteView pdu,
                        std::uint8_t count_bits) const noexcept {
  askAcyclic(request, slave, access_point, kClass2MasterSap, pdu, count_bits);
}

void DpServices::askAcyclic(FdlRequest& request, StationAddress slave, std::uint8_t dsap, std::uint8_t ssap,
                            ByteView pdu, std::uint8_t count_bits) const noexcept {
  ask(request, slave, count_bits, {kSendRequestDataLow, dsap, ssap}, pdu);
  request.short_acknowledge_legal = true;
  request.acknowledge_legal = true;
  request.max_data = kMaxIoLength;
}

void DpServices::operate(FdlRequest& request) const noexcept {
  globalControl(request, 0x00, 0x00);  // no Clear, no Freeze, no Sync; every group
}

void DpServices::synchronise(FdlRequest& request, bool on) const noexcept {
  unsigned command = 0;
  if (sync_outputs_) command |= on ? kSync : kUnsync;
  if (freeze_inputs_) command |= on ? kFreeze : kUnfreeze;
  globalControl(request, static_cast<std::uint8_t>(command), sync_groups_);
}

bool DpServices::isSynchronised(const SlaveConfig& slave) const noexcept {
  if (!sync_outputs_ && !freeze_inputs_) return false;
  return sync_groups_ == 0 || (slave.group & sync_groups_) != 0;
}

void DpServices::globalControl(FdlRequest& request, std::uint8_t command, std::uint8_t groups) const noexcept {
  request = FdlRequest{};
  request.answered = false;
  request.station = kBroadcastAddress;
  const std::array<std::uint8_t, 2> data{command, groups};

  Telegram telegram;
  telegram.kind = TelegramKind::kSd2;
  telegram.da = kBroadcastAddress;
  telegram.sa = master_.value();
  telegram.fc = kSendNoAcknowledgeHigh;
  telegram.dsap = kGlobalControlSap;
  telegram.ssap = kMasterSap;
  telegram.data = data;
  encode(telegram, request.frame);
}

}  // namespace nord_driver::profibus
