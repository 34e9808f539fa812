#include "link/serial/adapter_identity.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

namespace nord_driver::link {

namespace {

class Descriptor {
 public:
  Descriptor(const char* path, int flags) noexcept : value_(::open(path, flags | O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const noexcept { return value_; }

 private:
  int value_;
};

const char* lastPart(const char* path) noexcept {
  const char* slash = ::strrchr(path, '/');
  return slash != nullptr ? slash + 1 : path;
}

/// The first line of a small file; empty when it is not there.
FixedText<63> lineOf(const char* path) noexcept {
  FixedText<63> line;
  char text[64] = {};
  const Descriptor file{path, 0};
  if (file.value() < 0) return line;
  const ssize_t count = ::read(file.value(), text, sizeof text - 1);
  if (count <= 0) return line;
  text[::strcspn(text, "\n")] = '\0';
  line.format("%s", text);
  return line;
}

/// A USB device is the nearest folder above the tty that has an idVendor; its serial number, where it has one, lies
/// beside it.
bool hasSerialNumber(const DeviceTree& tree, const char* tty) noexcept {
  char path[PATH_MAX];
  char attribute[PATH_MAX + 16];
  ::snprintf(attribute, sizeof attribute, "%s/%s/device", tree.tty_class, tty);
  if (::realpath(attribute, path) == nullptr) return false;
  for (char* end = ::strrchr(path, '/'); end != nullptr && end != path; end = ::strrchr(path, '/')) {
    ::snprintf(attribute, sizeof attribute, "%s/idVendor", path);
    if (::access(attribute, F_OK) == 0) {
      ::snprintf(attribute, sizeof attribute, "%s/serial", path);
      return !lineOf(attribute).empty();
    }
    *end = '\0';
  }
  return false;
}

}  // namespace

int resolvePath(const char* path, DevicePath& target) noexcept {
  char resolved[PATH_MAX];
  if (::realpath(path, resolved) == nullptr) return -errno;
  if (::strlen(resolved) > kDevicePathLength) return -ENAMETOOLONG;
  target.format("%s", resolved);
  return 0;
}

int adapterLink(const DeviceTree& tree, const char* device, DevicePath& link) noexcept {
  DevicePath wanted;
  if (const int error = resolvePath(device, wanted)) return error;
  if (!hasSerialNumber(tree, lastPart(wanted.c_str()))) return -ENOENT;

  const Descriptor folder{tree.by_id, O_DIRECTORY};
  if (folder.value() < 0) return -errno;
  // getdents64 and not opendir(), which takes memory.
  alignas(dirent64) char entries[4096];
  for (;;) {
    const ssize_t count = ::getdents64(folder.value(), entries, sizeof entries);
    if (count <= 0) return count == 0 ? -ENOENT : -errno;
    for (ssize_t at = 0; at < count;) {
      const auto* entry = reinterpret_cast<const dirent64*>(entries + at);
      at += entry->d_reclen;
      char path[PATH_MAX];
      ::snprintf(path, sizeof path, "%s/%s", tree.by_id, entry->d_name);
      DevicePath target;
      if (resolvePath(path, target) != 0 || ::strcmp(target.c_str(), wanted.c_str()) != 0) continue;
      if (::strlen(path) > kDevicePathLength) return -ENAMETOOLONG;
      link.format("%s", path);
      return 0;
    }
  }
}

int latencyTimer(const DeviceTree& tree, const char* device) noexcept {
  DevicePath target;
  if (const int error = resolvePath(device, target)) return error;
  char path[PATH_MAX];
  ::snprintf(path, sizeof path, "%s/%s/device/latency_timer", tree.tty_class, lastPart(target.c_str()));
  const FixedText<63> line = lineOf(path);
  if (line.empty()) return -ENOENT;
  return static_cast<int>(::strtol(line.c_str(), nullptr, 10));
}

}  // namespace nord_driver::link
