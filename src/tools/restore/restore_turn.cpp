#include "tools/restore/restore_turn.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "link/serial/lock_owner.h"
#include "tools/drive_parameters.h"

namespace nord_driver::tools {

RestoreTurn::RestoreTurn(const std::string& journal, const std::string& drive) {
  const std::string path = journal + ".run";
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code none;  // without the folder opening fails, and says why
  if (!folder.empty()) std::filesystem::create_directories(folder, none);
  // Only read: it may belong to another user.
  file_ = ::open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0644);
  const bool held = file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) == 0;
  if (held) return;
  const int why = errno;
  if (file_ >= 0) ::close(file_);
  if (file_ >= 0 && why == EWOULDBLOCK) {
    const auto owner = link::lockOwner(path.c_str());
    throw Trouble("another nord_param" + (owner ? " (process " + std::to_string(owner->process) + ")" : std::string()) +
                  " restores drive " + drive + " now: nothing was written");
  }
  throw Trouble(path + " cannot be locked (" + std::strerror(why) +
                "): nothing is written to the drive without it; --journal names another file");
}

RestoreTurn::~RestoreTurn() {
  ::close(file_);
}

}  // namespace nord_driver::tools
