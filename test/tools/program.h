// A program as a user runs it: its two streams and its exit code.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace nord_driver::test {

/// Started by the constructor, killed by the destructor when it still runs.
class Program {
 public:
  /// Throws std::runtime_error when it cannot be started.
  explicit Program(const std::vector<std::string>& command);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  /// Its exit code; -1: ended by a signal, -2: still running after `limit`.
  int wait(std::chrono::seconds limit);
  /// True when a whole line stands on its stdout within `limit`.
  bool saysSomething(std::chrono::seconds limit) const;
  std::string output() const;  ///< its stdout so far
  std::string errors() const;  ///< its stderr so far

 private:
  pid_t pid_ = -1;
  int output_ = -1;  // files in memory
  int errors_ = -1;
};

struct Ended {
  int code = 0;
  std::string output;
  std::string errors;
};

/// Runs `command` to its end.
Ended runProgram(const std::vector<std::string>& command, std::chrono::seconds limit = std::chrono::seconds{60});

}  // namespace nord_driver::test
