#include "profibus/fdl_request.h"

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
  if (!request.data_legal) return Mismatch::kFunction;
  if (!mirrorsAccessPoints(request, telegram)) return Mismatch::kAccessPoint;
  if (telegram.data.size() < request.min_data || telegram.data.size() > request.max_data) return Mismatch::kLength;
  answer.kind = FdlAnswer::Kind::kData;
  answer.data = telegram.data;
  return Mismatch::kNone;
}

// Captured slaves refuse with SD1, without service access points, also where the request had them.
Mismatch matchWithoutData(const FdlRequest& request, const Telegram& telegram, FdlAnswer::Kind kind,
                          FdlAnswer& answer) noexcept {
  if (!withoutAccessPoints(telegram) && !mirrorsAccessPoints(request, telegram)) return Mismatch::kAccessPoint;
  if (!telegram.data.empty()) return Mismatch::kLength;
  answer.kind = kind;
  return Mismatch::kNone;
}

}  // namespace

Mismatch matchAnswer(const FdlRequest& request, std::uint8_t master, const Telegram& telegram,
                     FdlAnswer& answer) noexcept {
  answer = FdlAnswer{};
  if (telegram.kind == TelegramKind::kSc) {
    return request.short_acknowledge_legal ? Mismatch::kNone : Mismatch::kAcknowledge;
  }
  if (telegram.kind == TelegramKind::kSd4 || isRequest(telegram.fc)) return Mismatch::kStranger;
  if (telegram.da != master || telegram.sa != request.station) return Mismatch::kStranger;

  answer.code = responseCode(telegram.fc);
  answer.station_type = stationType(telegram.fc);
  if (answer.station_type != StationType::kSlave && !request.any_station_type) return Mismatch::kFunction;

  switch (answer.code) {
    case ResponseCode::kDataLow:
    case ResponseCode::kDataHigh:
      return matchData(request, telegram, answer);
    case ResponseCode::kOk:
      if (!request.acknowledge_legal) return Mismatch::kAcknowledge;
      return matchWithoutData(request, telegram, FdlAnswer::Kind::kAcknowledge, answer);
    case ResponseCode::kNoData:
      return matchWithoutData(request, telegram,
                              request.acknowledge_legal ? FdlAnswer::Kind::kAcknowledge : FdlAnswer::Kind::kRefusal,
                              answer);
    case ResponseCode::kUserError:
    case ResponseCode::kNoResource:
    case ResponseCode::kNotActivated:
      return matchWithoutData(request, telegram, FdlAnswer::Kind::kRefusal, answer);
    case ResponseCode::kDataLowNoResource:
    case ResponseCode::kDataHighNoResource:
      // The slave did not take what was sent: whatever data come with it, this was no exchange.
      answer.kind = FdlAnswer::Kind::kRefusal;
      return mirrorsAccessPoints(request, telegram) ? Mismatch::kNone : Mismatch::kAccessPoint;
  }
  return Mismatch::kFunction;
}

}  // namespace nord_driver::profibus
