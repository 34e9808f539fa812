// How the programs are asked to end: the signals only leave a note, so that what is under way comes to its own end.
#pragma once

#include <signal.h>

#include <atomic>

namespace nord_driver::tools {

/// From the first call on SIGINT, SIGTERM and SIGHUP end nothing by themselves: the answer becomes true, for good. Where
/// whoever started the program had it ignore SIGHUP (`nohup`), it goes on ignoring it.
inline const std::atomic<bool>& catchEndSignals() noexcept {
  static std::atomic<bool> asked{false};
  struct sigaction action {};
  action.sa_handler = [](int) { asked = true; };
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, &action, &before);
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) sigaction(signal, &before, nullptr);
  }
  return asked;
}

}  // namespace nord_driver::tools
