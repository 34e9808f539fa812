// What a transport counts: named values, each with its meaning in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver {

/// The name of a counter and what it counts. Both texts are literals: they are shown as long as the driver runs.
struct CounterName {
  const char* name = "";     ///< of lower-case letters, digits and underscores; unlike the others of the same transport
  const char* meaning = "";  ///< a few words for a technician
};

struct NamedCounter : CounterName {
  std::uint64_t value = 0;  ///< since configure()
};

/// Counters most buses have. Those of these names also fill the fields of the same name in `~bus_status`: a transport
/// uses a name when its counter means what is said here, and a name of its own otherwise.
namespace bus_counter {

constexpr CounterName kCycles{"cycles", "bus cycles begun"};
constexpr CounterName kTelegramsSent{"telegrams_sent", "telegrams or frames sent, repeated ones included"};
constexpr CounterName kTelegramsReceived{"telegrams_received", "valid telegrams or frames received, whoever sent them"};
constexpr CounterName kRetries{"retries", "telegrams repeated"};
constexpr CounterName kTimeouts{"timeouts", "requests nobody answered in time"};
constexpr CounterName kChecksumErrors{"checksum_errors", "telegrams received with a wrong checksum"};
constexpr CounterName kParityErrors{"parity_errors", "characters received with a wrong parity bit"};
constexpr CounterName kOverruns{"overruns", "bytes or frames lost because this computer took them too late"};
constexpr CounterName kDiscardedBytes{"discarded_bytes", "bytes received that are part of no valid telegram"};
constexpr CounterName kUnexpected{"unexpected", "valid telegrams or frames nobody had asked for"};
constexpr CounterName kStale{"stale", "answers that came too late or match no request any more"};

}  // namespace bus_counter

/// The counters of one transport, in the order in which they are shown. Copied once per cycle: nothing here allocates.
class BusCounters {
 public:
  static constexpr std::size_t kCapacity = 32;

  /// A counter beyond kCapacity is left out.
  constexpr void add(const CounterName& name, std::uint64_t value) noexcept { counters_.push_back({name, value}); }

  /// 0 when the transport has no such counter.
  constexpr std::uint64_t value(const CounterName& name) const noexcept { return value(name.name); }
  constexpr std::uint64_t value(std::string_view name) const noexcept {
    for (const NamedCounter& counter : counters_) {
      if (name == counter.name) return counter.value;
    }
    return 0;
  }

  constexpr std::size_t size() const noexcept { return counters_.size(); }
  constexpr const NamedCounter* begin() const noexcept { return counters_.begin(); }
  constexpr const NamedCounter* end() const noexcept { return counters_.end(); }

 private:
  FixedVector<NamedCounter, kCapacity> counters_;
};

}  // namespace nord_driver
