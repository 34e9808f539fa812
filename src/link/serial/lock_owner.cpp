#include "link/serial/lock_owner.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <memory>

namespace nord_driver::link {

namespace {

using ProcFile = std::unique_ptr<FILE, int (*)(FILE*)>;

ProcFile openedProc(const char* path) noexcept {
  return ProcFile{::fopen(path, "re"), [](FILE* file) { return file != nullptr ? ::fclose(file) : 0; }};
}

}  // namespace

// proc(5), /proc/PID/cmdline: the words end in zeros.
ProgramName programOf(int process) noexcept {
  ProgramName name;
  FixedText<40> path;
  path.format("/proc/%d/cmdline", process);
  const ProcFile file = openedProc(path.c_str());
  char words[1024] = {};
  if (!file || ::fread(words, 1, sizeof words - 1, file.get()) == 0) return name;
  const char* const slash = ::strrchr(words, '/');
  return slash != nullptr ? slash + 1 : words;
}

// proc(5), /proc/locks: "1: FLOCK  ADVISORY  WRITE 4242 00:05:123 0 EOF", the device in hexadecimal figures.
std::optional<LockOwner> lockOwner(const char* path) noexcept {
  struct stat status {};
  if (::stat(path, &status) != 0) return std::nullopt;
  FixedText<64> wanted;
  wanted.format("%02x:%02x:%llu", major(status.st_dev), minor(status.st_dev),
                static_cast<unsigned long long>(status.st_ino));
  const ProcFile locks = openedProc("/proc/locks");
  char line[256];
  while (locks && ::fgets(line, sizeof line, locks.get()) != nullptr) {
    char kind[16] = {}, process[16] = {}, where[64] = {};
    if (::sscanf(line, "%*s %15s %*s %*s %15s %63s", kind, process, where) != 3) continue;
    LockOwner owner;
    owner.process = static_cast<int>(::strtol(process, nullptr, 10));
    if (::strcmp(kind, "FLOCK") != 0 || ::strcmp(where, wanted.c_str()) != 0 || owner.process <= 0) continue;
    owner.name = programOf(owner.process);
    return owner;
  }
  return std::nullopt;
}

Sentence toText(const LockOwner& owner) noexcept {
  Sentence text;
  text.format("%s (process %d)", owner.name.empty() ? "a program" : owner.name.c_str(), owner.process);
  return text;
}

}  // namespace nord_driver::link
