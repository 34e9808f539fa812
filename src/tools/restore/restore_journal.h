// What a restore has done to a drive and is about to do, in a file that outlives the program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/restore/restore_plan.h"

namespace nord_driver::tools {

enum class RestoreState : std::uint8_t {
  kWriting,     ///< or broken off while it was
  kTakingBack,  ///< the same, the other way
  kVerified,    ///< written and verified
  kTakenBack,
};
const char* toString(RestoreState state) noexcept;

enum class ChangeState : std::uint8_t {
  kPending,
  kBegun,  ///< the drive may have it, or not
  kWritten,
  kTakenBack,
};
const char* toString(ChangeState state) noexcept;

struct RestoreRecord {
  struct Change : RestoreChange {
    ChangeState state = ChangeState::kPending;
  };

  std::string drive;    ///< as the configuration calls it
  std::string address;  ///< on the bus, for people
  profile::Series series = profile::Series::kSk5xxe;
  std::string file;  ///< the dump
  bool persistent = false;
  RestoreState state = RestoreState::kWriting;
  std::string why;                            ///< it is taken back: a sentence; empty: not, or because a user said so
  std::optional<std::int32_t> eeprom_switch;  ///< P560 before the first write; none: not read yet, or there is none
  std::vector<Change> changes;                ///< in the order of writing
  std::vector<Dump::Value> same;              ///< not written, but verified

  bool isUnfinished() const noexcept { return state == RestoreState::kWriting || state == RestoreState::kTakingBack; }
};

/// Of a plan nothing of which is done yet.
RestoreRecord recordOf(const RestorePlan& plan, const DriveParameters& drive, const std::string& file, bool persistent);

std::string recordText(const RestoreRecord& record);
/// The other way round. Throws UsageError naming `file` and what is wrong.
RestoreRecord recordFrom(const std::string& text, const std::string& file);

class RestoreJournal {
 public:
  explicit RestoreJournal(std::string path) : path_(std::move(path)) {}

  const std::string& path() const noexcept { return path_; }
  /// Nothing: there is none. Throws UsageError when it cannot be read or is none.
  std::optional<RestoreRecord> read() const;
  /// On the disk when it returns, whole: a power failure leaves the one before or this one. Throws Trouble.
  void write(const RestoreRecord& record) const;

 private:
  std::string path_;
};

/// `$ROS_HOME/nord_driver/restore/<drive>.journal`, without ROS_HOME below `$HOME/.ros`; both as the environment has
/// them, nullptr: not at all. Throws UsageError when neither is set.
std::string journalPath(const char* ros_home, const char* home, const std::string& drive);

}  // namespace nord_driver::tools
