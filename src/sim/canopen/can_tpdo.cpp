#include "sim/canopen/can_tpdo.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kInhibitUnit = std::chrono::microseconds{100};
constexpr unsigned kLongestSynchronous = 240;
constexpr unsigned kFirstImmediate = 254;

}  // namespace

bool CanTpdo::due(const PdoSettings& pdo, const PdoData& now) const noexcept {
  if (pdo.type < kFirstImmediate) return false;
  if (!sent_once_) return true;
  if (since_sent_ < pdo.inhibit * kInhibitUnit) return false;
  return now != last_ || (pdo.event > 0 && since_sent_ >= std::chrono::milliseconds{pdo.event});
}

bool CanTpdo::dueOnSync(const PdoSettings& pdo, const PdoData& now) noexcept {
  if (pdo.type > kLongestSynchronous) return false;
  if (pdo.type == 0) return !sent_once_ || now != last_;
  if (++syncs_ < pdo.type) return false;
  syncs_ = 0;
  return true;
}

void CanTpdo::sent(const PdoData& data) noexcept {
  sent_once_ = true;
  last_ = data;
  since_sent_ = Duration::zero();
}

}  // namespace nord_driver::sim
