#include "tools/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace nord_driver::tools {

namespace {

constexpr Duration kPatience = std::chrono::seconds{2};
constexpr Duration kInterval = std::chrono::milliseconds{200};
constexpr char kClear[] = "\r\x1b[K";
constexpr std::size_t kLongestBar = 40;

}  // namespace

ProgressBar::ProgressBar(Write write, unsigned columns) : write_(std::move(write)), columns_(columns) {}

ProgressBar::~ProgressBar() {
  end();
}

void ProgressBar::begin(const std::string& what, std::size_t total, Instant now) {
  end();
  what_ = what;
  total_ = total;
  done_ = 0;
  begun_ = now;
}

void ProgressBar::advance(Instant now) {
  done_ = std::min(done_ + 1, total_);
  if (columns_ == 0 || now - begun_ < kPatience || (visible_ && now - drawn_ < kInterval)) return;
  visible_ = true;
  drawn_ = now;
  write_("\r" + line() + "\x1b[K");
}

void ProgressBar::end() {
  if (visible_) write_(kClear);
  visible_ = false;
}

// "reading left [#########           ] 52 of 101"; without the bar where it does not fit.
std::string ProgressBar::line() const {
  const std::string count = std::to_string(done_) + " of " + std::to_string(total_);
  const std::string plain = what_ + " " + count;
  const std::size_t room = columns_ > plain.size() + 4 ? columns_ - plain.size() - 4 : 0;
  const std::size_t length = std::min(room, kLongestBar);
  if (length < 5) return plain.substr(0, columns_ > 1 ? columns_ - 1 : 0);
  const std::size_t full = total_ == 0 ? length : length * done_ / total_;
  return what_ + " [" + std::string(full, '#') + std::string(length - full, ' ') + "] " + count;
}

unsigned columnsOfStderr() {
  constexpr unsigned kUsual = 80;
  if (::isatty(STDERR_FILENO) == 0) return 0;
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
  return size.ws_col;
}

}  // namespace nord_driver::tools
