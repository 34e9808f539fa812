#include "nord_driver/profibus/fdl_request.h"

namespace nord_driver::profibus {

namespace {

bool withoutAccessPoints(const Telegram& telegram) noexcept {
  return !telegram.dsap && !telegram.ssap;
}

/// The answer to DSAP 60 from SSAP 62 comes to DSAP 62 from SSAP 60.
bool mirrorsAccessPoints(const FdlRequest& request, const Telegram& telegram) noexcept {
  return telegram.dsap == request.ssap && telegram.ssap == request.dsap;
}

Mismatch matchData(const FdlRequest& request, const Telegram& telegram, FdlAnswer& answer) noexcept {
  if (!request.data_legal) return Mismatch::Function;
  if (!mirrorsAccessPoints(request, telegram)) return Mismatch::AccessPoint;
  if (telegram.data.size() < request.min_data || telegram.data.size() > request.max_data) return Mismatch::Length;
  answer.kind = FdlAnswer::Kind::Data;
  answer.data = telegram.data;
  return Mismatch::None;
}

// Captured slaves refuse with SD1, without service access points, also where the request had them.
Mismatch matchWithoutData(const FdlRequest& request, const Telegram& telegram, FdlAnswer::Kind kind,
                          FdlAnswer& answer) noexcept {
  if (!withoutAccessPoints(telegram) && !mirrorsAccessPoints(request, telegram)) return Mismatch::AccessPoint;
  if (!telegram.data.empty()) return Mismatch::Length;
  answer.kind = kind;
  return Mismatch::None;
}

}  // namespace

Mismatch matchAnswer(const FdlRequest& request, std::uint8_t master, const Telegram& telegram,
                     FdlAnswer& answer) noexcept {
  answer = FdlAnswer{};
  if (telegram.kind == TelegramKind::Sc) {
    return request.short_acknowledge_legal ? Mismatch::None : Mismatch::Acknowledge;
  }
  if (telegram.kind == TelegramKind::Sd4 || isRequest(telegram.fc)) return Mismatch::Stranger;
  if (telegram.da != master || telegram.sa != request.station) return Mismatch::Stranger;

  answer.code = responseCode(telegram.fc);
  answer.station_type = stationType(telegram.fc);
  if (answer.station_type != StationType::Slave && !request.any_station_type) return Mismatch::Function;

  switch (answer.code) {
    case ResponseCode::DataLow:
    case ResponseCode::DataHigh:
      return matchData(request, telegram, answer);
    case ResponseCode::Ok:
      if (!request.acknowledge_legal) return Mismatch::Acknowledge;
      return matchWithoutData(request, telegram, FdlAnswer::Kind::Acknowledge, answer);
    case ResponseCode::NoData:
      return matchWithoutData(request, telegram,
                              request.acknowledge_legal ? FdlAnswer::Kind::Acknowledge : FdlAnswer::Kind::Refusal,
                              answer);
    case ResponseCode::UserError:
    case ResponseCode::NoResource:
    case ResponseCode::NotActivated:
      return matchWithoutData(request, telegram, FdlAnswer::Kind::Refusal, answer);
    case ResponseCode::DataLowNoResource:
    case ResponseCode::DataHighNoResource:
      // The slave did not take what was sent: whatever data come with it, this was no exchange.
      answer.kind = FdlAnswer::Kind::Refusal;
      return mirrorsAccessPoints(request, telegram) ? Mismatch::None : Mismatch::AccessPoint;
  }
  return Mismatch::Function;
}

}  // namespace nord_driver::profibus
