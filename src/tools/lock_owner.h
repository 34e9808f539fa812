// Which process has a device, as far as the kernel tells it.
#pragma once

#include <optional>
#include <string>

namespace nord_driver::tools {

struct LockOwner {
  int process = 0;   ///< its id
  std::string name;  ///< of its program, without folders
};

/// The program of a process, without folders; empty when there is none of this id.
std::string programOf(int process);

/// Who holds a lock (flock) on the file or device at `path`, which every program of this package takes on a serial
/// device. Nothing when nobody does, there is no such file, or the kernel does not tell.
std::optional<LockOwner> lockOwner(const std::string& path);

}  // namespace nord_driver::tools
