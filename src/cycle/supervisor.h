// Carries out what users ask of the drives: which groups it concerns, whether it may begin, and when it is done.
#pragma once

#include <bitset>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cycle/command_watch.h"
#include "cycle/completion_queue.h"
#include "cycle/cycle_config.h"
#include "cycle/request.h"
#include "cycle/start_acknowledge.h"
#include "drive/drive.h"
#include "drive/drive_group.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Drives stand in groups: the base, and every other drive alone; each with the drives that follow it. A request for all drives is carried out for all
/// groups or for none. Each cycle: `handleRequest` for what has come, then after the exchange `update`, then
/// `pollCompletion`.
class Supervisor {
 public:
  /// `drives` must outlive the supervisor and not move. `auto_enable`: enable once, when every drive has first become
  /// ready and the commands have been quiet for long enough; a fault seen before is the end of it.
  /// `start`: a fault it may still acknowledge is not the end of that; it must outlive the supervisor.
  /// `watch`: tells which command moves one drive or the base alone; without it every command counts for every request.
  Supervisor(const CycleConfig& config, std::vector<drive::Drive>& drives, bool auto_enable,
             const StartAcknowledge* start = nullptr, CommandWatch* watch = nullptr);

  /// Enable, disable, quick stop and shut down. An enable that comes before the commands have been listened to for long
  /// enough waits for that; a stop meanwhile ends it.
  void handleRequest(const Request& request, const CommandState& commands, Instant now) noexcept;
  void update(const CommandState& commands, Instant now) noexcept;
  std::optional<Completion> pollCompletion() noexcept { return completions_.poll(); }

  /// The group of the base; nullptr without one.
  drive::DriveGroup* base() noexcept { return has_base_ ? &groups_.front().group : nullptr; }
  const drive::DriveGroup* base() const noexcept { return has_base_ ? &groups_.front().group : nullptr; }
  /// The group a drive belongs to.
  drive::DriveGroup& groupOf(DriveIndex drive) noexcept { return groups_[group_of_[drive]].group; }
  bool inBase(DriveIndex drive) const noexcept { return has_base_ && group_of_[drive] == 0; }
  /// Nothing is enabled, enabling or on its way to rest.
  bool settled() const noexcept;
  /// Why the base stands still against its user's will; empty when it does not.
  Sentence baseStopSentence() const noexcept;
  /// Why an enabling by auto_enable ended without success, once.
  std::optional<Sentence> takeAutoEnableFailure() noexcept { return std::exchange(auto_enable_failure_, std::nullopt); }

 private:
  struct Group {
    drive::DriveGroup group;
    std::vector<DriveIndex> members;
  };
  using Groups = std::bitset<256>;  // an id of a parameter access has 8 bits for the drive
  struct Job {
    Request request;
    Instant deadline{};
    bool begun = true;  // false: an enable that waits for commands to be listened to, or parameters
    std::optional<Instant> enabled_at = {};  // an enable of what was enabled then
    Groups to_enable = {};                   // what it brings up, and takes back when it fails
  };

  void addGroup(const std::vector<DriveIndex>& leaders, const CycleConfig& config);
  bool concerns(const Request& request, const Group& group) const noexcept;
  void startEnable(const Request& request, const CommandState& commands, Instant now) noexcept;
  /// All drives of the request, or none: false when one refuses, and answered.
  bool enableAll(const Request& request, Instant now) noexcept;
  bool awaitsParameters(const Request& request) const noexcept;
  static bool enabledOrEnabling(const Group& group) noexcept;
  Groups groupsToEnable(const Request& request) const noexcept;
  Sentence movingAgainst(const Request& request, const CommandState& commands, Instant now) noexcept;
  /// Everything that is against enabling what it asks for, `commands` included; empty when nothing is.
  Sentence reasonsAgainst(const Request& request, const Sentence& commands) noexcept;
  bool isEnabled(const Request& request) const noexcept;
  /// All it asks for is enabled, or on its way there.
  bool nothingToEnable(const Request& request) const noexcept;
  void stop(const Request& request, Instant now) noexcept;
  void endWaitingEnables(const Request& stop) noexcept;
  bool anyEnableWaits() const noexcept;
  void followUp(const Request& request, Instant now, bool begun = true,
                std::optional<Instant> enabled_at = std::nullopt) noexcept;
  /// These three: true when the job has ended.
  bool follow(Job& job, const CommandState& commands, Instant now) noexcept;
  bool followWaiting(Job& job, const CommandState& commands, Instant now) noexcept;
  bool followEnable(const Job& job, Instant now) noexcept;
  void endUndone(const Request& request, const Sentence& why) noexcept;
  bool followStop(const Job& job, Instant now) noexcept;
  void takeBack(const Groups& begun, Instant now) noexcept;
  Sentence refusalOf(const Group& group, const drive::GroupRefusal& refusal) const noexcept;
  /// Names the drives the request concerns and that do not answer; empty when all do.
  Sentence silentMembers(const Request& request) const noexcept;
  Sentence unsettled(const Job& job) const noexcept;
  void autoEnable(const CommandState& commands, Instant now) noexcept;

  std::vector<drive::Drive>& drives_;
  std::vector<std::string> names_;
  std::vector<std::optional<DriveIndex>> leaders_;  // of the drives that follow one
  std::vector<Group> groups_;                       // the base first
  std::vector<std::size_t> group_of_;
  std::vector<drive::Refusal> refusals_;  // one per drive, filled anew for each sentence
  bool has_base_ = false;
  bool auto_enable_;
  std::optional<Sentence> auto_enable_failure_;
  const StartAcknowledge* start_;
  CommandWatch* watch_;
  bool shutting_down_ = false;
  static constexpr std::size_t kMostJobs = 32;
  FixedVector<Job, kMostJobs + 1> jobs_;  // one place is kept for the end of the node, which has to be followed
  CompletionQueue<66> completions_;       // a full queue of requests refused, and every job ended
};

}  // namespace nord_driver::cycle
