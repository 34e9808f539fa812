// One restore of a drive at a time.
#pragma once

#include <string>

namespace nord_driver::tools {

/// Held from before the journal is looked at until the restore has ended, the question to the user included: another one
/// would replace the journal of the first, or take it for broken off and write against it. A lock (flock) on
/// `<journal>.run`, which the kernel gives back however the program ends; the file stays, because removing it would let two
/// programs lock two files of one name.
class RestoreTurn {
 public:
  /// Makes the folders above that are missing. Throws Trouble when another program has it, naming `drive` and that
  /// program, and when the file cannot be made.
  RestoreTurn(const std::string& journal, const std::string& drive);
  ~RestoreTurn();
  RestoreTurn(const RestoreTurn&) = delete;
  RestoreTurn& operator=(const RestoreTurn&) = delete;

 private:
  int file_ = -1;
};

}  // namespace nord_driver::tools
