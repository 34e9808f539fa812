// How far a program has come, on one line of a terminal that goes away again.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "nord_driver/core/time.h"

namespace nord_driver::tools {

/// Drawn only for what takes longer than two seconds. Knows no clock: the time is an argument.
class ProgressBar {
 public:
  using Write = std::function<void(const std::string&)>;

  /// `columns`: of the terminal that `write` writes to; 0: it is none, and nothing is drawn.
  ProgressBar(Write write, unsigned columns);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `what` is done in `total` steps from now on.
  void begin(const std::string& what, std::size_t total, Instant now);
  /// One step more is done.
  void advance(Instant now);
  /// Takes the line away.
  void end();

 private:
  std::string line() const;

  Write write_;
  unsigned columns_;
  std::string what_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  Instant begun_{};
  Instant drawn_{};
  bool visible_ = false;
};

/// The columns of the terminal that stderr is; 0: it is none.
unsigned columnsOfStderr();

}  // namespace nord_driver::tools
