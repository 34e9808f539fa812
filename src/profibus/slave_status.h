// What a DP master knows of a slave.
#pragma once

#include <cstdint>
#include <optional>

#include "profibus/counters.h"
#include "profibus/diagnosis.h"
#include "profibus/slave_config.h"

namespace nord_driver::profibus {

/// Where a slave stands, in the order of its start-up (EN 50170-8, master state machine per slave).
enum class SlavePhase : std::uint8_t {
  kSilent,             ///< asked for its FDL status now and then
  kFirstDiagnosis,     ///< is it the right device, and free?
  kReadConfiguration,  ///< Get_Cfg is next, where it is wanted
  kParameters,         ///< Set_Prm is next
  kConfiguration,      ///< Chk_Cfg is next
  kAwaitReady,         ///< asked for its diagnosis until it is ready
  kDataExchange,
  kBackOff  ///< the start-up ended in a fault; waits to try again
};

struct SlaveStatus {
  SlavePhase phase = SlavePhase::kSilent;
  /// Outputs were taken and fresh, valid inputs came in the cycle that `startCycle()` began last.
  bool exchanged_this_cycle = false;
  std::optional<std::uint16_t> ident;  ///< as the slave reported it, since it was found
  Diagnosis diagnosis;                 ///< the last one; `empty()` before the first
  bool heard = false;                  ///< it answered its last request, whatever it said
  const char* note = "";               ///< what it needs or waits for, for a technician; empty in data exchange
  SlaveCounters counters;
  /// What Get_Cfg said last: configuration bytes; empty when it was not asked.
  FixedBytes<kMaxIoLength> configuration;

  /// The module answers, and reports that its inverter does not: only in data exchange is that known.
  bool inverterLinkBroken() const noexcept {
    return phase == SlavePhase::kDataExchange && diagnosis.inverterLinkBroken();
  }
};

}  // namespace nord_driver::profibus
