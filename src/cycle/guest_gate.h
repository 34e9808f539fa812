// Keeps a program that only reads and writes parameters from stopping a drive that runs.
#pragma once

#include <optional>
#include <vector>

#include "nord_driver/profile/process_data.h"
#include "nord_driver/transport/transport.h"
#include "profile/status_word.h"

namespace nord_driver::cycle {

/// The cycle's first word that acts, 047E, stops a drive. A driver is there to do that; a guest is not: until the first
/// drive has answered for a while and no drive was seen running, all words are 0000, which inverters ignore (BU 2700
/// 6.4.1 note 2), and the drive layer hears nothing. One that runs keeps the gate closed for ever. Once the bus was left to
/// another master, nothing is known of the drives any more, and the gate is closed again.
class GuestGate {
 public:
  struct Running {
    DriveIndex drive = 0;
    profile::DriveState state = profile::DriveState::kUnknown;
  };

  /// `guest` false: open from the beginning.
  explicit GuestGate(bool guest) noexcept : guest_(guest), open_(!guest) {}

  /// Begins anew: nothing is known of the drives any more. The first `awaited` of them, 1 at least, have to be heard.
  /// `reaches_others`: the guest's words get to those behind them, too; where they do not, these may run.
  void close(std::size_t awaited = 1, bool reaches_others = true);
  /// Before the exchange.
  void holdBack(std::vector<profile::ProcessOutput>& outputs) const noexcept;
  /// After it; while the gate is closed the drives look silent from here on.
  void handleInputs(std::vector<DriveExchange>& inputs) noexcept;

  bool isOpen() const noexcept { return open_; }
  /// All that have to be heard answered in the last cycle with the gate closed.
  bool heard() const noexcept { return heard_; }
  /// This one of them answered in the last cycle with the gate closed.
  bool hears(DriveIndex drive) const noexcept { return drive < heard_each_.size() && heard_each_[drive]; }
  /// This one of them was in fault while the gate was closed: the words behind it may acknowledge that.
  bool faultSeen(DriveIndex drive = 0) const noexcept { return drive < fault_seen_.size() && fault_seen_[drive]; }
  /// A drive that is not at rest.
  const std::optional<Running>& running() const noexcept { return running_; }

 private:
  void look(const std::vector<DriveExchange>& inputs) noexcept;
  void closeAgain() noexcept;

  bool guest_;
  bool open_;
  bool reaches_others_ = true;
  bool heard_ = false;
  std::vector<bool> heard_each_ = std::vector<bool>(1);  // of those that have to be
  std::vector<bool> fault_seen_ = std::vector<bool>(1);  // likewise, ever
  int cycles_heard_ = 0;
  std::optional<Running> running_;
};

}  // namespace nord_driver::cycle
