// Drives over the bus, for a program that comes, reads or writes parameters, looks on, and goes.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cycle/bus_cycle.h"
#include "cycle/cycle_ports.h"
#include "nord_driver/transport/transport.h"
#include "state/drive_eeprom.h"
#include "tools/drive_parameters.h"
#include "tools/tool_config.h"

namespace nord_driver::tools {

/// Master of the bus from `connect` on, by the same cycle as the driver's node (`CycleRole::kGuest`). Moves nothing and
/// stops nothing:
///  - Until a status word has told state and parameter set, the word is 0000, which the inverter ignores (BU 2700 6.4.1
///    note 2). A drive that runs then is left alone: `connect` refuses. One at rest gets the idle word 047E with its
///    own set, so that P513 or P151 > 0 does not trip it (7.1.1). Likewise when the bus was left to another master.
///  - The other drives of the bus are not talked to. One of them that runs refuses only where the words get to it, too.
///  - Nothing in the module watches for the end of the program, and nothing is sent on the bus of another master: the
///    transport is told so (`serveParametersOnly()`).
class ParameterLink final : public DriveParameters {
 public:
  /// Configures `transport`, and opens nothing. `catalogues` must outlive the link. Throws ConfigError; Trouble when
  /// `transport` does not serve parameters only.
  ParameterLink(const ToolConfig& config, Transport& transport, const catalogue::Catalogues& catalogues);
  /// Ends the exchange; what was not ended by `finish` ends as it stands.
  ~ParameterLink() override;
  ParameterLink(const ParameterLink&) = delete;
  ParameterLink& operator=(const ParameterLink&) = delete;

  /// Looks for the drive until `limit`, which begins when the transport has listened (DriveIdentity::protection_time).
  /// Throws Trouble when it does not answer, or runs, or `end_asked`. `tell` is told once, in a sentence, when this takes
  /// long: whom it waits for, how long at most, and why.
  void connect(Duration limit, const std::atomic<bool>& end_asked,
               const std::function<void(const std::string&)>& tell = {});

  ParameterAnswer read(const catalogue::ParameterAddress& address) override;
  /// Of one of the drives that were asked for, in this order; asked once, so that the others need not wait for one that
  /// is silent.
  ParameterAnswer read(DriveIndex drive, const catalogue::ParameterAddress& address);
  /// `access` is one to write. Compared before and read back after; see ParameterSession. Refused past the EEPROM's
  /// budget, and what whyNotWritten() forbids.
  ParameterAnswer write(const catalogue::ParameterAccess& access) override;
  /// The bus cycle goes on: a drive with P513 > 0 would trip without its words.
  void pass(Duration time) noexcept override;

  /// Goes on with the exchange until `when`, or `end_asked`. Throws Trouble as `connect` does when a drive runs that another
  /// master has had meanwhile; so do the accesses.
  void exchangeUntil(Instant when, const std::atomic<bool>& end_asked);
  Instant now() const noexcept { return transport_.now(); }
  Duration period() const noexcept { return cycle_->period(); }  ///< of a cycle
  /// Looks on at every cycle from now on; must outlive the link.
  void setObserver(cycle::CycleObserver* observer) noexcept { ports_.setObserver(observer); }

  // Of the drives that were asked for.
  std::size_t driveCount() const noexcept { return config_.asked; }
  const std::string& name(DriveIndex drive) const noexcept { return config_.cycle.drives[drive].name; }
  DriveIdentity identity(DriveIndex drive) const { return transport_.identity(drive); }
  const catalogue::DriveCatalogue& known(DriveIndex drive) const noexcept { return known_[drive]; }
  /// `mode: position`: its first words may be no frequencies.
  bool positions(DriveIndex drive) const noexcept { return config_.cycle.drives[drive].position.has_value(); }
  /// Of the last cycle; the reference holds until the next one.
  const cycle::DriveSnapshot& snapshot(DriveIndex drive) noexcept { return ports_.readSnapshot().drives[drive]; }
  /// False: its bus module does not tell whether it is at rest.
  bool isStateKnown(DriveIndex drive);
  /// Why nothing comes from it, a clause; may be empty.
  std::string note(DriveIndex drive) const { return transport_.note(drive).text; }

  /// Puts back what is not to stay (P560, orders of the parameter channel) and ends the exchange. Returns sentences on
  /// what the end means to the drive.
  std::vector<std::string> finish();

  const std::string& name() const noexcept override { return drive().name; }
  profile::Series series() const noexcept override { return drive().series; }
  DriveIdentity identity() const override { return transport_.identity(0); }
  const catalogue::DriveCatalogue& known() const noexcept override { return known_.front(); }
  std::string whyNotWritten(std::uint16_t number) const override { return config_.writable_parameters.refusal(number); }
  std::string notAtRest() override;
  /// A fault that the first idle word has acknowledged: it takes the enable away (BU 0020 8).
  std::string changedByReading() override;
  std::string changedByReading(DriveIndex drive);

 private:
  const cycle::DriveSetup& drive() const noexcept { return config_.cycle.drives.front(); }
  /// False: no word of this program gets to the drive, so that none acknowledges and none is missed after its end.
  bool sendsWords(DriveIndex drive) const;
  void exchange() noexcept;
  /// Of the last cycle.
  const cycle::DriveSnapshot& snapshot() noexcept { return snapshot(0); }
  void idle(int cycles) noexcept;
  void refuseRunning() const;
  /// The first drive that was asked for and does not answer.
  DriveIndex silent() const;
  /// What to say of it; and ": " with why it does not, a clause, may be empty.
  std::string silence() const;
  std::string whySilent() const;
  std::optional<cycle::Completion> run(cycle::Request& request);
  /// Again where only the line was lost, `attempts` times in all.
  std::optional<cycle::Completion> runAndRepeat(cycle::Request& request, int attempts);
  bool waitForDrive();
  ParameterAnswer carryOut(const catalogue::ParameterAccess& access, cycle::RequestKind kind, DriveIndex drive,
                           int attempts);

  const ToolConfig& config_;
  Transport& transport_;
  std::vector<catalogue::DriveCatalogue> known_;  // of the drives that were asked for
  state::EepromBudget budget_;
  std::optional<state::DriveEeprom> eeprom_;  // from the constructor on
  cycle::CyclePorts ports_;
  std::optional<cycle::BusCycle> cycle_;  // from the constructor on
  std::uint32_t last_id_ = 0;
  bool connected_ = false;
  // Nothing is sent meanwhile, perhaps: what stops the drives of a driver that was killed acts first.
  Duration listening_{};
};

}  // namespace nord_driver::tools
