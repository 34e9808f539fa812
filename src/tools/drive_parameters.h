// One drive's parameters, whichever way they are reached: over the bus itself, or through the node that has the bus.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>

#include "catalogue/drive_catalogue.h"
#include "catalogue/parameter_access.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::tools {

/// It cannot be done now: one sentence.
class Trouble : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ParameterAnswer {
  bool success = false;
  bool refused = false;  ///< by inverter, catalogue or session; the drive is there
  bool used_up = false;  ///< refused: the EEPROM's budget does not allow it now; the drive was not asked
  bool unknown = false;  ///< refused: the inverter has no parameter of this number
  bool passing =
      false;  ///< refused: may be granted a moment later, and says nothing of the parameter; see askPatiently()
  std::string message;  ///< why not; with success a note, or empty
  std::int32_t raw = 0;
  double value = 0.0;
  const catalogue::ParameterEntry* entry = nullptr;  ///< what the catalogue knows
  std::uint8_t set = 0;                              ///< that was meant, 1..4; 0 where the parameter has no sets
};

class DriveParameters {
 public:
  virtual ~DriveParameters() = default;

  virtual ParameterAnswer read(const catalogue::ParameterAddress& address) = 0;
  /// `access` is one to write. Compared before and read back after.
  virtual ParameterAnswer write(const catalogue::ParameterAccess& access) = 0;
  /// Nothing is asked for so long, while somebody thinks: what the drive has to hear meanwhile it goes on hearing.
  virtual void pass(Duration time) { std::this_thread::sleep_for(time); }

  /// As the configuration calls the drive.
  virtual const std::string& name() const = 0;
  virtual profile::Series series() const = 0;
  /// Where it is on the bus, and what module it hangs on.
  virtual DriveIdentity identity() const = 0;
  /// What is known of the drive.
  virtual const catalogue::DriveCatalogue& known() const = 0;
  /// Why this number is not to be written, a sentence; empty: nothing here forbids it.
  virtual std::string whyNotWritten(std::uint16_t /*number*/) const { return {}; }
  /// Why many parameters are not to be written now, a sentence; empty: the drive is at rest. Default: it was brought there.
  virtual std::string notAtRest() { return {}; }
  /// Whether a value that the drive has already is saved in the EEPROM when it is written so.
  virtual bool savesSame() const { return true; }
  /// What coming to the drive has changed in it, a sentence. Default: nothing.
  virtual std::string changedByReading() { return {}; }

 protected:
  DriveParameters() = default;
  DriveParameters(const DriveParameters&) = default;
  DriveParameters& operator=(const DriveParameters&) = default;
};

}  // namespace nord_driver::tools
