// A node as a child process: started, signalled and killed by the test, its words and its end seen.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "rostest/topic.h"

namespace nord_driver::test {

/// Not to be used by several threads. Whatever happens to the test, the child does not outlive it.
class NodeProcess {
 public:
  struct End {
    int exit_code = -1;  ///< -1: ended by a signal
    int signal = 0;      ///< 0: ended by itself
  };

  /// Throws std::runtime_error when it cannot be started.
  NodeProcess(const std::string& program, const std::vector<std::string>& arguments);
  /// Kills what still runs.
  ~NodeProcess();
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;

  void signal(int number);
  /// Nothing: it still runs after `limit`.
  std::optional<End> waitEnd(Seconds limit);
  /// What it has written to stderr so far.
  std::string errorText() const;
  /// The lines of `errorText()` that are not empty.
  std::vector<std::string> errorLines() const;

 private:
  pid_t pid_ = -1;
  int alive_ = -1;   // read end of a pipe whose other end only the child holds: it hangs up when the child has ended
  int errors_ = -1;  // a file in memory
  std::optional<End> end_;
};

/// The programs of this build.
extern const char* const kDriverProgram;
extern const char* const kSimulatorProgram;

}  // namespace nord_driver::test
