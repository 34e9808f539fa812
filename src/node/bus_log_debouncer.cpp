#include "node/bus_log_debouncer.h"

namespace nord_driver::node {

namespace {

constexpr Duration kPatience = std::chrono::seconds{1};

}  // namespace

std::optional<BusLogDebouncer::Line> BusLogDebouncer::poll(const std::string& text, bool good, Instant now) {
  if (!good && !troubled_) due_ = now + kPatience;
  troubled_ = !good;
  if (text == told_ || (troubled_ && now < due_)) return std::nullopt;
  due_ = now + kPatience;
  told_ = text;
  return Line{good, text};
}

}  // namespace nord_driver::node
