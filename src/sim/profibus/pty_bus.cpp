#include "sim/profibus/pty_bus.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sim/model_clock.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
/// A telegram whose rest did not come for that long never will be one.
constexpr Duration kPartialLife = std::chrono::milliseconds(100);

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

}  // namespace

PtyBus::PtyBus(const SimConfig& config, const std::string& link_path)
    : robot_(config), stations_(robot_), link_path_(link_path) {
  try {
    openPty();
    putLink();
  } catch (...) {
    closePty();
    throw;
  }
  stations_.advance(std::chrono::steady_clock::now());
  thread_ = std::thread([this] { serve(); });
}

PtyBus::~PtyBus() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  // The link may have been taken over by another simulator in the meantime.
  std::array<char, 256> target{};
  const ssize_t length = ::readlink(link_path_.c_str(), target.data(), target.size() - 1);
  if (length > 0 && device_path_ == target.data()) ::unlink(link_path_.c_str());
  closePty();
}

void PtyBus::openPty() {
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0) fail("cannot open a pseudo-terminal");
  if (::grantpt(master_) != 0 || ::unlockpt(master_) != 0) fail("cannot unlock the pseudo-terminal");
  std::array<char, 128> name{};
  if (::ptsname_r(master_, name.data(), name.size()) != 0) fail("cannot name the pseudo-terminal");
  device_path_ = name.data();
  slave_ = ::open(device_path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (slave_ < 0) fail("cannot open " + device_path_);
  termios settings{};
  if (::tcgetattr(slave_, &settings) != 0) fail("cannot read the settings of " + device_path_);
  ::cfmakeraw(&settings);  // no echo, no line editing, all bytes as they are
  if (::tcsetattr(slave_, TCSANOW, &settings) != 0) fail("cannot make " + device_path_ + " raw");
}

void PtyBus::putLink() {
  struct stat info {};
  if (::lstat(link_path_.c_str(), &info) == 0) {
    if (!S_ISLNK(info.st_mode)) {
      throw std::runtime_error("bus/device: " + link_path_ +
                               " exists and is no symbolic link; expected a path where the simulator may put one");
    }
    ::unlink(link_path_.c_str());
  }
  if (::symlink(device_path_.c_str(), link_path_.c_str()) != 0) {
    fail("bus/device: cannot put a symbolic link at " + link_path_);
  }
}

void PtyBus::closePty() noexcept {
  if (slave_ >= 0) ::close(slave_);
  if (master_ >= 0) ::close(master_);
  slave_ = master_ = -1;
}

void PtyBus::serve() noexcept {
  becomeRealTime();
  ModelClock clock{std::chrono::steady_clock::now()};
  Instant last_input{};  // in the time of the models: what comes while they stand still is not late
  while (!stop_) {
    pollfd descriptor{master_, POLLIN, 0};
    const timespec timeout{0, kStep.count()};
    const int ready = ::ppoll(&descriptor, 1, &timeout, nullptr);

    const std::lock_guard<InheritingMutex> lock(mutex_);
    const Instant model_now = modelTime(clock, std::chrono::steady_clock::now());
    if (ready > 0 && (descriptor.revents & POLLIN) != 0) {
      takeInput(model_now);
      last_input = model_now;
    } else if (stations_.hasPartial() && model_now - last_input > kPartialLife) {
      stations_.forgetPartial();
    }
    stations_.advance(model_now);
    sendDue(model_now);
  }
}

void PtyBus::takeInput(Instant model_now) noexcept {
  std::array<std::uint8_t, 256> buffer{};  // fits beside the longest unfinished telegram
  const ssize_t count = ::read(master_, buffer.data(), buffer.size());
  if (count <= 0) return;
  answer_from_ = model_now;
  stations_.receive(ByteView{buffer.data(), static_cast<std::size_t>(count)}, model_now, Judge::kYes, *this);
}

void PtyBus::answer(const WireBytes& bytes, Duration delay) noexcept {
  if (delay <= Duration::zero()) {
    send(bytes);
  } else {
    delayed_.push_back({answer_from_ + delay, bytes});
  }
}

void PtyBus::sendDue(Instant now) noexcept {
  while (!delayed_.empty() && delayed_[0].due <= now) {
    send(delayed_[0].bytes);
    delayed_.eraseFront(1);
  }
}

void PtyBus::send(const WireBytes& bytes) noexcept {
  // A full buffer means that nobody reads: an answer more or less does not matter then.
  if (::write(master_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size())) stations_.delivered(bytes);
}

}  // namespace nord_driver::sim
