// Whether a node still runs, by what comes from it and by its process.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace nord_driver::tools {

/// Somebody accepts a connection there, within a third of a second.
bool acceptsConnection(const std::string& host, std::uint32_t port);

/// The id of its process on its machine; nothing: it is not known to the ROS master, or does not answer there.
std::optional<int> processOf(const std::string& node);

/// Watches a node that is listened to. The connection to one that was killed looks like one to a node that is silent:
/// after a second of silence it is asked.
class NodeLife {
 public:
  /// Throws Trouble when no such node answers.
  explicit NodeLife(std::string node);

  /// Something came.
  void heard();
  /// `connected`: it publishes still, as far as ROS knows. Throws Trouble when the node has ended, another has taken its
  /// name, or nothing has come for longer than the slowest topic takes.
  void check(bool connected);

 private:
  using Clock = std::chrono::steady_clock;

  std::string node_;
  std::optional<int> process_;
  Clock::time_point heard_, asked_;
};

}  // namespace nord_driver::tools
