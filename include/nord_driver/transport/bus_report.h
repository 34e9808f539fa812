// The part of a transport that tells users about the bus and the drives on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/trace/telegram_trace.h"
#include "nord_driver/transport/bus_counters.h"
#include "nord_driver/transport/cyclic_exchange.h"

namespace nord_driver {

/// What a transport opens, and which key of the configuration's group `bus` says so. Texts are literals.
struct EndPoint {
  const char* key = "";      ///< "device", "interface", "gateway", of a text; empty: this transport opens nothing
  const char* kind = "";     ///< in words: "serial device"
  const char* example = "";  ///< a value a configuration may have: "/dev/ttyUSB0"
  /// Key of a second way to the same bus, which some configurations have; empty: there is none. Whoever is told another
  /// bus than the configuration's takes this one there as well.
  const char* second_key = "";

  bool isNone() const noexcept { return *key == '\0'; }
};

/// Whose time-outs decide whether the inverter heeds a lost bus (BU 2700 8.1).
enum class TimeoutOwner : std::uint8_t {
  kInverter,  ///< P513
  kModule,    ///< P151 in the bus module (SK CU4/TU4), and P120 in the inverter for the way between them
};

/// What a transport tells about a drive once it is configured.
struct DriveIdentity {
  std::string address;                     ///< "PROFIBUS station 3"
  std::uint8_t process_values = 1;         ///< setpoints and actual values carried: 1 or 3; 0: no process data
  std::string parameter_channel = "none";  ///< "PKW", "SDO"; "none": the configuration has to name max_frequency
  std::string protected_by;  ///< what of this bus stops the drive when this computer dies, in words; empty: nothing
  /// s until that acts; 0: not known. Of a transport that serves parameters only: for how long it listens before it
  /// sends anything, and what another driver may have left behind has acted by then.
  double protection_time = 0.0;
  TimeoutOwner timeout_owner = TimeoutOwner::kInverter;
  /// False: something between this computer and the drive may repeat the last words for ever, so that the time-out of
  /// the drive does not notice by itself that this computer is dead; `protected_by` has to end the words first.
  bool timeout_notices = true;
  bool timeout_needed = false;  ///< `protected_by` stops the drive only together with a time-out of the drive above 0
  /// False: a profile of others (CiA 402, DRIVECOM, AC drive) has its one word for a speed, and no free control and
  /// status bits.
  bool nord_profile = true;
  /// How many parameter sets the control word of this drive can command: 4, or 1 where its profile has no bits for them.
  std::uint8_t parameter_sets = 4;
  /// False: its profile has no words for OFF2 and OFF3, an ordinary stop stands in their place.
  bool has_quick_stop = true;
  /// False: its profile has no rotation to the left, a negative setpoint is 0.
  bool reverses = true;
  std::uint8_t inverter = 1;  ///< 1..4 behind a bus module that serves several
  /// Drives with the same number are behind the same bus module; nothing: this one has a module of its own.
  std::optional<std::size_t> shared_module = std::nullopt;
  /// Digital outputs and inputs of the bus module itself travel with its process data.
  bool module_io = false;
  /// The longest cycle there may be, with one slave silent: a time-out that stops a drive must be longer. 0: not known.
  double worst_cycle = 0.0;
  /// s, the longest pause between two telegrams with output words to this drive where they are not sent in each cycle;
  /// 0: they are. It says nothing about how long a cycle takes.
  double longest_pause = 0.0;
  /// The parameters of its bus module (P150 to P199) cannot be written without saving them.
  bool module_saves = false;
  /// Each telegram says that control word and setpoint come from this bus, and P509 and P510 are not asked for that.
  bool sources_by_telegram = false;
  /// False: of a transport that serves parameters only, and sends no control words then: none end with the program.
  bool sends_words = true;
  /// False: of a transport that serves parameters only, exchanges no process data then and asks for the state alone. Its
  /// status words are made of that, "not ready to switch on" where it is not told either, and it has no actual values.
  bool tells_words = true;
};

/// Something that happened on the bus, told once: a sentence for a technician.
struct BusEvent {
  bool warning = true;  ///< false: for information
  Sentence text = {};
};

/// Why a drive does not answer, or what it needs: a sentence for a technician. The text belongs to the transport and is
/// copied before the next cycle.
struct DriveNote {
  const char* text = "";
};

/// All but endPoint() from configure() on. What is noexcept is called once per cycle by the thread of the bus cycle,
/// after exchange(), and does not allocate; the rest is called by the thread that has configured the transport, before
/// the first cycle.
class BusReport {
 public:
  virtual ~BusReport() = default;

  /// Where the bus is; known from construction on, and always the same. Default: it opens nothing.
  virtual EndPoint endPoint() const noexcept { return {}; }

  virtual DriveIdentity identity(DriveIndex drive) const = 0;
  /// What is accepted in the configuration and still doubtful; sentences. Default: none.
  virtual std::vector<std::string> warnings() const { return {}; }

  /// The bus device is open and at least one station answers.
  virtual bool connected() const noexcept = 0;
  /// Default: none.
  virtual BusCounters counters() const noexcept { return {}; }
  /// Default: nothing to say.
  virtual DriveNote note(DriveIndex /*drive*/) const noexcept { return {}; }
  /// What the bus module says it is: PROFIBUS ident number, or vendor << 16 | product. Default: 0, not known (yet).
  virtual std::uint32_t identNumber(DriveIndex /*drive*/) const noexcept { return 0; }
  /// One sentence for a technician on the bus as a whole ("/dev/ttyUSB0: no such file"). Default: empty, it is fine.
  virtual Sentence busText() const noexcept { return {}; }
  /// What happened since the last call, oldest first; called until there is nothing. Default: nothing ever.
  virtual std::optional<BusEvent> pollEvent() noexcept { return std::nullopt; }

  /// The last telegrams. Lives as long as the transport and may be copied by any thread. Default: nullptr, this
  /// transport sees none.
  virtual const TelegramTrace* trace() const noexcept { return nullptr; }
};

}  // namespace nord_driver
