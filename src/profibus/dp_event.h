// What a DP master tells the layer above when it happens.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/event_ring.h"

namespace nord_driver::profibus {

enum class DpEventKind : std::uint8_t {
  kSlaveFound,           ///< answers FDL status
  kDataExchangeEntered,  ///< the next cycle exchanges data, with the outputs set by then
  kSlaveLost,            ///< was in data exchange and is no more: see `cause`
  // The start-up ended in a fault. It is tried again after a pause of at most 2 s; the event is not repeated.
  kWrongIdent,
  kParameterFault,
  kConfigurationFault,
  kLockedByMaster,        ///< `master` owns the slave
  kConfigurationDiffers,  ///< Get_Cfg: see `DpMaster::configurationText()`
  kConfigurationRead,     ///< Get_Cfg on demand was answered, or was refused: see `text`
  kServiceRefused,        ///< a negative answer to a service of the start-up, or to data exchange for too long
  kNotReady,              ///< parameterised and configured, but does not become ready
  kLeftRunning,           ///< a watchdog runs in it that is not ours, left by its master or unexplained, and we have
                          ///< none: asked again when that, however long, has run out
  // Not of one slave: `slave` is kNoSlave.
  kForeignMaster,  ///< `master` sent a token or a request. Our own address: a second master has it, or an adapter
                   ///< echoes
  kSyncReleased,   ///< a slave of the group did not exchange: UNSYNC is sent, until `setSynchronised()` is called again
  kLineBusy        ///< the line never falls silent: nothing can be sent
};

enum class LossCause : std::uint8_t {
  kNone,
  kSilence,              ///< no answer, retries included
  kWrongAnswers,         ///< something answered, but never a legal answer
  kRefused,              ///< answered each exchange for as long, and took no outputs or gave no inputs
  kLeftDataExchange,     ///< answered RS: its watchdog ran out, or it was switched off and on
  kParametersRequested,  ///< Slave_Diag shows Prm_Req, or is that of another master, or of another device
  kLinkRestarted,        ///< `DpMaster::restart()`
  kGivenWay              ///< to another master: see `BusParameters::gives_way`
};

constexpr std::size_t kNoSlave = static_cast<std::size_t>(-1);

struct DpEvent {
  DpEventKind kind = DpEventKind::kSlaveFound;
  std::size_t slave = kNoSlave;  ///< index as configured
  LossCause cause = LossCause::kNone;
  std::uint8_t master = 0xFF;  ///< LockedByMaster, ForeignMaster
  std::uint16_t ident = 0;     ///< WrongIdent: what the slave reports
  const char* text = "";       ///< a sentence for a technician, subject left out
};

using DpEvents = EventRing<DpEvent, 256>;

}  // namespace nord_driver::profibus
