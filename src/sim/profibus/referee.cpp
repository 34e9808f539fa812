#include "sim/profibus/referee.h"

#include "sim/profibus/services.h"

namespace nord_driver::sim {

namespace {

bool sameTelegram(const Telegram& a, const Telegram& b) noexcept {
  return a.function == b.function && a.source == b.source && a.destination_sap == b.destination_sap &&
         a.source_sap == b.source_sap && a.data == b.data;
}

/// The frame counted as the first one has FCV = 0; its repetition may not differ either.
bool differsInMoreThanFcv(const Telegram& a, const Telegram& b) noexcept {
  Telegram c = a;
  c.function = static_cast<std::uint8_t>((a.function & ~0x10u) | (b.function & 0x10u));
  return !sameTelegram(c, b);
}

bool isWriteOrder(unsigned label) noexcept {
  return label == 2 || label == 3 || label == 7 || label == 8 || (label >= 11 && label <= 14);
}

}  // namespace

const char* toString(Rule rule) noexcept {
  switch (rule) {
    case Rule::kShortPause:
      return "a request came less than 33 bit times after the last activity (EN 50170, T_SYN)";
    case Rule::kCollision:
      return "a request was sent into a running answer";
    case Rule::kEarlyAnswer:
      return "an answer came earlier than 11 bit times after its request (min T_SDR)";
    case Rule::kNoTelegram:
      return "bytes that are no telegram were sent";
    case Rule::kNotARequest:
      return "an answer was sent where only requests may come";
    case Rule::kUnknownFunction:
      return "a request had an unknown function code";
    case Rule::kFrameCountOnUnacknowledged:
      return "FCB or FCV was set in a telegram without frame count (SDN, FDL status, ident)";
    case Rule::kFirstRequestWithoutFcb:
      return "a request with FCV = 0 had FCB = 0; the first one has FCB = 1";
    case Rule::kFcvBeforeFirstRequest:
      return "FCV = 1 was used before a first request with FCV = 0, FCB = 1";
    case Rule::kFcbReused:
      return "the same FCB was used with another telegram";
    case Rule::kFcbToggledWithoutAnswer:
      return "FCB was toggled although the last request had no answer";
    case Rule::kDiagnosisWithData:
      return "Slave_Diag was requested with data";
    case Rule::kWrongParameterLength:
      return "Set_Prm was shorter than 7 bytes";
    case Rule::kParameterisedWithoutLock:
      return "Set_Prm had neither Lock_Req nor Unlock_Req";
    case Rule::kConfiguredBeforeParameterised:
      return "Chk_Cfg came before an acknowledged Set_Prm";
    case Rule::kDataExchangeBeforeReady:
      return "Data_Exchange came before the station's diagnosis said ready";
    case Rule::kWrongDataLength:
      return "Data_Exchange had another length than configured";
    case Rule::kWriteOrderLeftStanding:
      return "a parameter write order was left standing after its answer (BU 2700 6.5, continuous writing)";
    case Rule::kZeroControlWord:
      return "a control word with bit 10 = 0 came after valid process data (BU 2700 6.4.3)";
    case Rule::kRecordBeforeReady:
      return "a DP-V1 record was asked for outside data exchange";
    case Rule::kRecordWhileOutstanding:
      return "a DP-V1 request came before the response to the last one was fetched";
    case Rule::kCount:
      break;
  }
  return "?";
}

void Referee::request(const Telegram& telegram) noexcept {
  awaiting_ = false;
  if (telegram.kind == TelegramKind::kToken) return;
  if (telegram.kind == TelegramKind::kShortAcknowledge || !telegram.isRequest()) {
    broken(Rule::kNotARequest);
    return;
  }
  Station& station = stations_[telegram.destination];
  switch (telegram.code()) {
    case kSdnLow:
    case kSdnHigh:
    case kFdlStatus:
    case kIdent:
    case kLsapStatus:
      if (telegram.fcb() || telegram.fcv()) broken(Rule::kFrameCountOnUnacknowledged);
      return;
    case kSdaLow:
    case kSdaHigh:
    case kSrdLow:
    case kSrdHigh:
      service(station, telegram, !frameCount(station, telegram));
      pending_ = telegram;
      awaiting_ = true;
      return;
    default:
      broken(Rule::kUnknownFunction);
  }
}

// EN 50170-4, frame count bit.
bool Referee::frameCount(Station& station, const Telegram& telegram) noexcept {
  bool repeated = false;
  if (!telegram.fcv()) {
    if (!telegram.fcb()) broken(Rule::kFirstRequestWithoutFcb);
    repeated = station.first_request_sent && !station.answered && sameTelegram(telegram, station.last);
    station.first_request_sent = true;
  } else if (!station.first_request_sent) {
    broken(Rule::kFcvBeforeFirstRequest);
  } else if (telegram.fcb() == station.last.fcb()) {
    repeated = true;
    if (differsInMoreThanFcv(telegram, station.last)) broken(Rule::kFcbReused);
  } else if (!station.answered) {
    broken(Rule::kFcbToggledWithoutAnswer);
  }
  station.last = telegram;
  station.answered = false;
  return !repeated;
}

void Referee::service(Station& station, const Telegram& telegram, bool repeated) noexcept {
  const std::size_t length = telegram.data.size();
  if (!telegram.destination_sap) {
    if (station.view != View::kReady) broken(Rule::kDataExchangeBeforeReady);
    if (station.output_length != 0 && length != station.output_length) broken(Rule::kWrongDataLength);
    return;
  }
  switch (*telegram.destination_sap) {
    case kSapDiagnosis:
      if (length != 0) broken(Rule::kDiagnosisWithData);
      return;
    case kSapSetParameters:
      if (length < kSetParametersMinimum) {
        broken(Rule::kWrongParameterLength);
      } else if ((telegram.data[0] & (kLockRequest | kUnlockRequest)) == 0) {
        broken(Rule::kParameterisedWithoutLock);
      }
      return;
    case kSapCheckConfiguration:
      if (station.view == View::kUnknown) broken(Rule::kConfiguredBeforeParameterised);
      return;
    case kSapRecords:
      if (station.view != View::kReady) broken(Rule::kRecordBeforeReady);
      if (length == 0) return;
      if (station.record_outstanding && !repeated) broken(Rule::kRecordWhileOutstanding);
      station.record_outstanding = true;
      return;
    default:
      return;
  }
}

void Referee::answer(const Telegram& telegram) noexcept {
  if (!awaiting_) return;
  awaiting_ = false;
  Station& station = stations_[pending_.destination];
  station.answered = true;
  const bool acknowledged = telegram.kind == TelegramKind::kShortAcknowledge;
  if (!pending_.destination_sap) {
    if (!acknowledged && telegram.code() == kServiceNotActive) station.view = View::kUnknown;
    return;
  }
  switch (*pending_.destination_sap) {
    case kSapSetParameters: {
      if (!acknowledged) return;
      const bool locked =
          !pending_.data.empty() && (pending_.data[0] & (kLockRequest | kUnlockRequest)) == kLockRequest;
      station.view = locked ? View::kParameterised : View::kUnknown;
      station.standing.fill(0);
      station.record_outstanding = false;
      return;
    }
    case kSapCheckConfiguration:
      if (acknowledged && station.view != View::kUnknown) station.view = View::kConfigured;
      return;
    case kSapRecords:
      // RS: the server is not there (any more). A response ends the service.
      if (!acknowledged && (telegram.code() == kServiceNotActive || !telegram.data.empty())) {
        station.record_outstanding = false;
      }
      return;
    case kSapDiagnosis: {
      if (telegram.data.size() < 6) return;
      const unsigned first = telegram.data[0];
      const unsigned second = telegram.data[1];
      if ((second & kParametersRequired) != 0 || (first & (kParameterFault | kConfigurationFault)) != 0) {
        station.view = View::kUnknown;
      } else if (station.view == View::kConfigured && (first & kNotReady) == 0 && (second & kStaticDiagnosis) == 0) {
        station.view = View::kReady;
      }
      return;
    }
    default:
      return;
  }
}

void Referee::parameterChannel(std::uint8_t station, const PkwWords& order, bool answered, unsigned inverter) noexcept {
  unsigned& standing = stations_[station].standing[inverter];
  standing = answered && isWriteOrder(order.label()) ? standing + 1 : 0;
  if (standing == kStandingTolerance + 1) broken(Rule::kWriteOrderLeftStanding);
}

}  // namespace nord_driver::sim
