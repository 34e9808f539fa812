// Writes a plan to a drive, or takes it back; whatever ends it, the journal says where it stands.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/restore/restore_journal.h"

namespace nord_driver::tools {

enum class RestoreEnd : std::uint8_t {
  kVerified,         ///< written, read back, and everything verified at the end
  kDiffers,          ///< written, and at the end not everything was as it should be; the notes tell what
  kTakenBack,        ///< what was there before is there again
  kTakenBackInPart,  ///< the notes tell what is not
};

class RestoreRun {
 public:
  /// Keeps the record on the disk; throws Trouble when it cannot.
  using Save = std::function<void(const RestoreRecord&)>;

  /// All must outlive it. The record is kept before each write.
  RestoreRun(DriveParameters& drive, RestoreRecord& record, Save save, const std::atomic<bool>& end_asked);

  /// For a record of an earlier run: what it does not know for certain, and what the drive has lost since, is found by
  /// reading. Throws as below.
  void lookAgain();

  /// Writes what is pending, verifies everything. What a drive refuses ends it: then everything is taken back. Throws
  /// Trouble when the drive stops answering, or `end_asked`, which is looked at between two accesses; the sentence says
  /// how to go on.
  RestoreEnd write();
  /// Puts back what was written, the last first, and leaves alone what somebody else has changed meanwhile. Throws as
  /// above.
  RestoreEnd takeBack();

  /// What users have to know of it, a sentence each.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

 private:
  enum class TakenBack : std::uint8_t { kYes, kLeft, kRefused };  // kLeft: somebody else has changed it

  ParameterAnswer asked(const std::function<ParameterAnswer()>& access);
  ParameterAnswer read(const catalogue::ParameterAddress& address);
  ParameterAnswer write(const catalogue::ParameterAddress& address, std::int32_t raw, bool persistent);
  /// Why the drive refused it; empty: it is written.
  std::string carryOut(RestoreRecord::Change& change);
  RestoreEnd takeBackBecause(const std::string& why);
  TakenBack takeBack(RestoreRecord::Change& change);
  bool verify();
  void lookAtEepromSwitch();
  [[noreturn]] void breakOff(const std::string& why) const;
  void requireRest() const;
  bool same(const catalogue::ParameterAddress& address, std::int32_t first, std::int32_t second) const;
  std::string text(const catalogue::ParameterAddress& address, std::int32_t raw) const;
  std::string title(const catalogue::ParameterAddress& address) const;

  DriveParameters& drive_;
  RestoreRecord& record_;
  Save save_;
  const std::atomic<bool>& end_asked_;
  std::vector<std::string> notes_;
};

/// The accesses write() will make at most, for a progress bar.
std::size_t accessesOf(const RestoreRecord& record);

}  // namespace nord_driver::tools
