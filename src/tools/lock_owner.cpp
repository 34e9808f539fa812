#include "tools/lock_owner.h"

#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace nord_driver::tools {

// proc(5), /proc/PID/cmdline: the words end in zeros.
std::string programOf(int process) {
  std::string first;
  std::getline(std::ifstream("/proc/" + std::to_string(process) + "/cmdline"), first, '\0');
  return first.substr(first.rfind('/') + 1);  // npos + 1 is 0
}

// proc(5), /proc/locks: "1: FLOCK  ADVISORY  WRITE 4242 00:05:123 0 EOF", the device in hexadecimal figures.
std::optional<LockOwner> lockOwner(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  char file[64];
  std::snprintf(file, sizeof file, "%02x:%02x:%llu", major(status.st_dev), minor(status.st_dev),
                static_cast<unsigned long long>(status.st_ino));
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, mode, access, where;
    LockOwner owner;
    if (!(words >> number >> kind >> mode >> access >> owner.process >> where)) continue;
    if (kind != "FLOCK" || where != file || owner.process <= 0) continue;
    owner.name = programOf(owner.process);
    return owner;
  }
  return std::nullopt;
}

}  // namespace nord_driver::tools
