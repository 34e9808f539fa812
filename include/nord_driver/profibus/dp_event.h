// What a DP master tells the layer above when it happens.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nord_driver/core/event_ring.h"

namespace nord_driver::profibus {

enum class DpEventKind : std::uint8_t {
  SlaveFound,           ///< answers FDL status
  DataExchangeEntered,  ///< the next cycle exchanges data, with the outputs set by then
  SlaveLost,            ///< was in data exchange and is no more: see `cause`
  // The start-up ended in a fault. It is tried again after a pause of at most 2 s; the event is not repeated.
  WrongIdent,
  ParameterFault,
  ConfigurationFault,
  LockedByMaster,  ///< `master` owns the slave
  ServiceRefused,  ///< a negative answer to a service of the start-up
  NotReady,        ///< parameterised and configured, but does not become ready
  // Not of one slave: `slave` is kNoSlave.
  ForeignMaster,  ///< `master` sent a token or a request. Our own address: a second master has it, or an adapter echoes
  LineBusy        ///< the line never falls silent: nothing can be sent
};

enum class LossCause : std::uint8_t {
  None,
  Silence,              ///< no answer, retries included
  WrongAnswers,         ///< something answered, but never a legal answer
  LeftDataExchange,     ///< answered RS: its watchdog ran out, or it was switched off and on
  ParametersRequested,  ///< Slave_Diag shows Prm_Req, or is that of another master, or of another device
  LinkRestarted         ///< `DpMaster::restart()`
};

constexpr std::size_t kNoSlave = static_cast<std::size_t>(-1);

struct DpEvent {
  DpEventKind kind = DpEventKind::SlaveFound;
  std::size_t slave = kNoSlave;  ///< index as configured
  LossCause cause = LossCause::None;
  std::uint8_t master = 0xFF;  ///< LockedByMaster, ForeignMaster
  std::uint16_t ident = 0;     ///< WrongIdent: what the slave reports
  const char* text = "";       ///< a sentence for a technician, subject left out
};

using DpEvents = EventRing<DpEvent, 256>;

}  // namespace nord_driver::profibus
