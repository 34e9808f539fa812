// The plugin interface: one class per way to reach the inverters.
//
// A transport moves the process data of a fixed list of drives over one bus, once per bus cycle, and answers parameter
// requests beside it. It knows nothing of commands, states or stops: it carries words. Whoever owns a bus card with a
// driver of its own writes one class of these and declares it to pluginlib (doc/plugins.md).
#pragma once

#include <vector>

#include "nord_driver/config/settings.h"
#include "nord_driver/transport/bus_report.h"
#include "nord_driver/transport/cyclic_exchange.h"
#include "nord_driver/transport/parameter_channel.h"

namespace nord_driver {

/// Calling order, one call at a time: constructed without arguments, and opens nothing; endPoint() and
/// serveParametersOnly(), if asked; configure() once; the rest of BusReport; then, from one thread, cycle after cycle:
/// exchange(), pollResult() and submit(), the noexcept part of BusReport, sleepUntil(); last close(), when that thread
/// has ended. A transport may be destroyed at any point of this.
///
/// A class of its own has to write exchange(), configure(), connected() and identity(); everything else has a default.
/// The drives are addressed by their index in the list of configure(). What is handed over by reference is the caller's
/// and good for the call only (DriveSettings may be kept); what is returned is a copy, but for trace() and note().
class Transport : public CyclicExchange, public ParameterChannel, public BusReport {
 public:
  /// Reads the `bus` settings and the drives' own (address, ppo_type, ...): whatever is asked for is a known key.
  /// `cycle_rate` in Hz. Opens nothing that may be missing: a device that is not there is no wrong configuration.
  /// Throws ConfigError naming key and value; nothing else throws after it.
  virtual void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) = 0;

  /// Ends the exchange: closes the device. The drives must have been stopped before. Also called before configure(),
  /// and more than once. Default: does nothing.
  virtual void close() noexcept {}
};

}  // namespace nord_driver
