// One drive's parameters over the bus, for a program that comes, reads or writes, and goes.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "catalogue/parameter_access.h"
#include "cycle/bus_cycle.h"
#include "cycle/cycle_ports.h"
#include "nord_driver/transport/transport.h"
#include "tools/tool_config.h"

namespace nord_driver::tools {

/// It cannot be done now: one sentence.
class Trouble : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ParameterAnswer {
  bool success = false;
  bool refused = false;  ///< by inverter, catalogue or session; the drive is there
  bool unknown = false;  ///< refused: the inverter has no parameter of this number
  std::string message;   ///< why not; with success a note, or empty
  std::int32_t raw = 0;
  double value = 0.0;
  const catalogue::ParameterEntry* entry = nullptr;  ///< what the catalogue knows
  std::uint8_t set = 0;                              ///< that was meant, 1..4; 0 where the parameter has no sets
};

/// Master of the bus from `connect` on, by the same cycle as the driver's node (`CycleRole::kGuest`). Moves nothing and
/// stops nothing:
///  - Until a status word has told state and parameter set, the word is 0000, which the inverter ignores (BU 2700 6.4.1
///    note 2). A drive that runs then is left alone: `connect` refuses. One at rest gets the idle word 047E with its
///    own set, so that P513 or P151 > 0 does not trip it (7.1.1).
///  - The other drives of the bus are not talked to.
///  - Nothing in the module watches for the end of the program, and nothing is sent on the bus of another master: the
///    transport is told so (`serveParametersOnly()`).
class ParameterLink {
 public:
  /// Configures `transport`, and opens nothing. `catalogues` must outlive the link. Throws ConfigError; Trouble when
  /// `transport` does not serve parameters only.
  ParameterLink(const ToolConfig& config, Transport& transport, const catalogue::Catalogues& catalogues);
  /// Ends the exchange; what was not ended by `finish` ends as it stands.
  ~ParameterLink();
  ParameterLink(const ParameterLink&) = delete;
  ParameterLink& operator=(const ParameterLink&) = delete;

  /// Looks for the drive until `limit`. Throws Trouble when it does not answer, or runs, or `end_asked`.
  void connect(Duration limit, const std::atomic<bool>& end_asked);

  ParameterAnswer read(const catalogue::ParameterAddress& address);
  /// `access` is one to write. Compared before and read back after; see ParameterSession.
  ParameterAnswer write(const catalogue::ParameterAccess& access);

  /// Puts back what is not to stay (P560, orders of the parameter channel) and ends the exchange. Returns sentences on
  /// what the end means to the drive.
  std::vector<std::string> finish();

  const cycle::DriveSetup& drive() const noexcept { return config_.cycle.drives.front(); }
  DriveIdentity identity() const { return transport_.identity(0); }
  /// What is known of the drive.
  const catalogue::DriveCatalogue& known() const noexcept { return *known_; }

 private:
  void exchange() noexcept;
  /// Of the last cycle.
  const cycle::DriveSnapshot& snapshot() noexcept { return ports_.readSnapshot().drives.front(); }
  void idle(int cycles) noexcept;
  void refuseRunning() const;
  std::string silence() const;
  std::optional<cycle::Completion> run(cycle::Request& request);
  bool waitForDrive() noexcept;
  ParameterAnswer carryOut(const catalogue::ParameterAccess& access, cycle::RequestKind kind);

  const ToolConfig& config_;
  Transport& transport_;
  std::optional<catalogue::DriveCatalogue> known_;  // from the constructor on
  cycle::CyclePorts ports_;
  std::optional<cycle::BusCycle> cycle_;  // from the constructor on
  std::uint32_t last_id_ = 0;
  bool connected_ = false;
};

}  // namespace nord_driver::tools
