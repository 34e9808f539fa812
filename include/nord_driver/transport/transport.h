// The plugin interface: one class per way to reach the inverters.
//
// A transport moves the process data of a fixed list of drives over one bus, once per bus cycle, and answers parameter
// requests beside it. It knows nothing of commands, states or stops: it carries words. Whoever owns a bus card with a
// driver of its own writes one class of these and declares it to pluginlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/config/settings.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/process_data.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/trace/telegram_trace.h"

namespace nord_driver {

using DriveIndex = std::size_t;

/// How the connection to an inverter ended, where the bus itself tells.
enum class Interruption : std::uint8_t {
  kNone,
  kUnasked,  ///< it was reset, or left the state in which data are exchanged, without being asked
  kSilent,   ///< what watches it (guarding, heartbeat) has not heard it in time
};

/// What the last cycle brought from one inverter.
struct DriveExchange {
  profile::ProcessInput input;
  bool module_answers = false;    ///< the bus module took part in data exchange in this cycle
  bool inverter_answers = false;  ///< ... and the inverter behind it is on: `input` is fresh
  /// In this cycle, said once, also when data are exchanged again already.
  Interruption interruption = Interruption::kNone;
  bool inverter_missing = false;  ///< the bus module answers, and the inverter behind it does not: it hears nothing
};

/// Whose time-outs decide whether the inverter heeds a lost bus (BU 2700 8.1).
enum class TimeoutOwner : std::uint8_t {
  kInverter,  ///< P513
  kModule,    ///< P151 in the bus module (SK CU4/TU4), and P120 in the inverter for the way between them
};

/// What a transport tells about a drive once it is configured.
struct DriveIdentity {
  std::string address;              ///< "PROFIBUS station 3"
  std::uint8_t process_values = 1;  ///< setpoints and actual values carried: 1 or 3
  std::string parameter_channel;    ///< "PKW", "SDO", "none"
  std::string protected_by;      ///< what of this bus stops the drive when this computer dies, in words; empty: nothing
  double protection_time = 0.0;  ///< s until that acts; 0: not known
  TimeoutOwner timeout_owner = TimeoutOwner::kInverter;
  std::uint8_t inverter = 1;  ///< 1..4 behind a bus module that serves several
  /// Drives with the same number are behind the same bus module; nothing: this one has a module of its own.
  std::optional<std::size_t> shared_module = std::nullopt;
  /// The longest cycle there may be, with one slave silent: a time-out that stops a drive must be longer. 0: not known.
  double worst_cycle = 0.0;
};

/// Something that happened on the bus, told once: a sentence for a technician.
struct BusEvent {
  bool warning = true;  ///< false: for information
  Sentence text = {};
};

/// Counters since start-up and the state of the bus. Copied once per cycle: no strings of variable length.
struct BusCounters {
  std::uint64_t cycles = 0;
  std::uint64_t telegrams_sent = 0;
  std::uint64_t telegrams_received = 0;
  std::uint64_t retries = 0;
  std::uint64_t timeouts = 0;
  std::uint64_t checksum_errors = 0;
  std::uint64_t parity_errors = 0;
  std::uint64_t framing_errors = 0;
  std::uint64_t overruns = 0;  ///< bytes this computer was too slow to take
  std::uint64_t discarded_bytes = 0;
  std::uint64_t unexpected = 0;
  std::uint64_t stale = 0;  ///< parameter answers that did not match the order
};

/// Why a drive does not answer, or what it needs: a sentence for a technician. Fixed strings, safe to copy in the
/// cycle.
struct DriveNote {
  const char* text = "";
};

/// Calling order: configure() once, then open() and exchange() for ever, from one thread. After configure() nothing
/// throws; after the first cycles nothing allocates. A transport whose device is gone keeps answering `exchange()` with
/// drives that are silent, and tries to reopen by itself at least every 2 s.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Reads the `bus` settings and the drives' own (address, ppo_type, ...). Throws ConfigError naming key and value.
  virtual void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) = 0;

  /// Told once, after configure(): silence of a drive that is shorter stops nothing. A transport that can tries for as
  /// long to go on as if nothing had happened.
  virtual void setDriveTimeout(Duration /*timeout*/) noexcept {}

  /// Time of this bus (the steady clock, or a simulated one in tests).
  virtual Instant now() const noexcept = 0;
  /// Waits without bus traffic.
  virtual void sleepUntil(Instant when) noexcept = 0;

  /// One bus cycle: sends every drive its output, collects the inputs; both have one element per drive, in the order of
  /// `configure()`. Returns when all have answered, were given up, or the device is closed.
  virtual void exchange(const std::vector<profile::ProcessOutput>& outputs,
                        std::vector<DriveExchange>& inputs) noexcept = 0;

  /// Queues a parameter access; it runs beside the process data. False: the queue of this drive is full.
  virtual bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept = 0;
  /// The next finished access, whichever drive it was of.
  virtual std::optional<profile::ParameterResult> pollResult() noexcept = 0;
  /// What the parameter channel of this drive can do; from configure() on, and always the same. As it stands here: what
  /// PKW can.
  virtual profile::ParameterCapabilities parameterCapabilities(DriveIndex /*drive*/) const noexcept { return {}; }

  /// The bus device is open and at least one station answers.
  virtual bool connected() const noexcept = 0;
  virtual BusCounters counters() const noexcept = 0;
  virtual DriveNote note(DriveIndex drive) const noexcept = 0;
  /// What the bus module says it is: PROFIBUS ident number, or vendor << 16 | product; 0 = not known yet.
  virtual std::uint32_t identNumber(DriveIndex drive) const noexcept = 0;
  /// One sentence for a technician on the bus as a whole ("/dev/ttyUSB0: no such file"), empty when it is fine.
  virtual Sentence busText() const noexcept = 0;
  virtual DriveIdentity identity(DriveIndex drive) const = 0;
  /// What is accepted in the configuration and still doubtful; sentences, known from configure() on.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// What happened since the last call, oldest first.
  virtual std::optional<BusEvent> pollEvent() noexcept { return std::nullopt; }
  /// The last telegrams, from configure() on; nullptr when this transport sees none. Lives as long as the transport and
  /// may be copied by any thread.
  virtual const TelegramTrace* trace() const noexcept { return nullptr; }

  /// Ends the exchange: closes the device. The drives must have been stopped before.
  virtual void close() noexcept = 0;
};

}  // namespace nord_driver
