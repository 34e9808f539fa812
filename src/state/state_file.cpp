#include "state/state_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

namespace nord_driver::state {

namespace {

constexpr int kMode = 0644;
constexpr auto kLockTime = std::chrono::seconds{2};
constexpr auto kLockPause = std::chrono::milliseconds{5};

StateError errorOf(const std::string& path, const std::string& what, int number) {
  return StateError{path + " " + what + " (" + std::strerror(number) + ")"};
}

/// A file descriptor that is closed whatever happens.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) noexcept : number_(::open(path.c_str(), flags | O_CLOEXEC, kMode)) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool isOpen() const noexcept { return number_ >= 0; }
  int number() const noexcept { return number_; }
  bool close() noexcept {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

bool writeAll(int file, const std::string& text) noexcept {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

std::string folderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

StateFile::StateFile(std::string path) : path_(std::move(path)) {
  if (path_.empty())
    throw StateError("there is no place for it: no file is named, and neither ROS_HOME nor HOME is set");
  std::error_code none;  // without the folder opening fails, and says why
  std::filesystem::create_directories(folderOf(path_), none);
  // Only read: it may belong to another user.
  lock_ = ::open((path_ + ".lock").c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, kMode);
  if (lock_ < 0) throw errorOf(path_ + ".lock", "cannot be opened", errno);
  const auto end = std::chrono::steady_clock::now() + kLockTime;
  while (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    const int why = errno;
    if ((why == EWOULDBLOCK || why == EINTR) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(kLockPause);
      continue;
    }
    ::close(lock_);
    throw errorOf(path_, "is held by another program, see " + path_ + ".lock", why);
  }
}

StateFile::~StateFile() {
  ::close(lock_);
}

std::optional<std::string> StateFile::read() const {
  const Descriptor file{path_, O_RDONLY};
  if (!file.isOpen() && errno == ENOENT) return std::nullopt;
  if (!file.isOpen()) throw errorOf(path_, "cannot be read", errno);
  std::string text;
  char part[4096];
  for (;;) {
    const ssize_t got = ::read(file.number(), part, sizeof part);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw errorOf(path_, "cannot be read", errno);
    if (got == 0) return text;
    text.append(part, static_cast<std::size_t>(got));
  }
}

void StateFile::replace(const std::string& text) const {
  const std::string beside = path_ + ".new";
  Descriptor file{beside, O_WRONLY | O_CREAT | O_TRUNC};
  if (!file.isOpen()) throw errorOf(beside, "cannot be written", errno);
  if (!writeAll(file.number(), text) || ::fsync(file.number()) != 0 || !file.close()) {
    throw errorOf(beside, "cannot be written", errno);
  }
  if (std::rename(beside.c_str(), path_.c_str()) != 0) throw errorOf(path_, "cannot be replaced", errno);
  // The name, too, has to be on the disk before anything is done that it was to count. A file system that cannot do
  // that for a folder says EINVAL, and there is nothing better.
  const Descriptor folder{folderOf(path_), O_RDONLY | O_DIRECTORY};
  if (folder.isOpen() && ::fsync(folder.number()) != 0 && errno != EINVAL) {
    throw errorOf(path_, "cannot be written to the disk", errno);
  }
}

std::string stateFilePath(const char* ros_home, const char* home, const std::string& name) {
  const auto given = [](const char* value) { return value != nullptr && *value != '\0'; };
  if (given(ros_home)) return std::string(ros_home) + "/nord_driver/" + name;
  if (given(home)) return std::string(home) + "/.ros/nord_driver/" + name;
  return {};
}

}  // namespace nord_driver::state
