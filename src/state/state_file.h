// A file that several processes change, and that a power failure leaves as it was before or as it is after.
#pragma once

#include <optional>
#include <string>

#include "state/state_error.h"

namespace nord_driver::state {

/// Opened for one change: read, decide, replace. Others wait meanwhile, threads of this process included. They wait by
/// `<file>.lock`, because the file itself is another one after each change.
class StateFile {
 public:
  /// Makes the folders above `path` that are missing. Waits for others, two seconds at most. Throws StateError.
  explicit StateFile(std::string path);
  ~StateFile();
  StateFile(const StateFile&) = delete;
  StateFile& operator=(const StateFile&) = delete;

  /// Its text; nothing when there is no such file yet. Throws StateError.
  std::optional<std::string> read() const;
  /// On the disk when it returns: written beside it, then renamed. Throws StateError; the file is then as it was.
  void replace(const std::string& text) const;

 private:
  std::string path_;
  int lock_ = -1;
};

/// `$ROS_HOME/nord_driver/<name>`, without ROS_HOME `$HOME/.ros/nord_driver/<name>`; both as the environment has them,
/// nullptr: not at all. Empty, which no StateFile takes, when neither is set.
std::string stateFilePath(const char* ros_home, const char* home, const std::string& name);

}  // namespace nord_driver::state
