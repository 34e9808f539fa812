// What the benchmarks of protocols on CAN measure with: the two things the frames go over, and the bare exchange.
#pragma once

#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "can_interface.h"
#include "can_pair.h"
#include "can_responder.h"
#include "link/can/socket_can.h"
#include "measure.h"

namespace nord_driver::bench {

inline constexpr unsigned kProcessor = 0;
inline constexpr std::size_t kBlock = 20;

/// What the frames go over, and how long it is measured.
struct Course {
  std::function<std::unique_ptr<CanEnds>()> of_driver, of_bare;  ///< never the same at a time
  double share = 1.0;                                            ///< of the usual number of measurements
  int repeats = 5;
  bool bounded = true;

  std::size_t pairs(std::size_t usual) const {
    return std::max<std::size_t>(kBlock, static_cast<std::size_t>(static_cast<double>(usual) * share));
  }
  bool judge(const char* what, double value, double bound) const {
    if (bounded) return report(what, value, "", bound);
    std::printf("%-66s %9.3f\n", what, value);
    std::fflush(stdout);
    return true;
  }
};

/// Nodes at the far end, and a near end of its own for whoever talks to them: the driver does not wait in its calls.
struct FarEnd {
  FarEnd(const std::function<std::unique_ptr<CanEnds>()>& make, const CanAnswers& answers)
      : ends(make()), nodes(*ends, answers, kProcessor) {}
  std::unique_ptr<CanEnds> ends;
  CanResponder nodes;
};

/// The same frames with nothing but write() and read().
class Bare {
 public:
  Bare(CanEnds& ends, const std::vector<CanFrame>& frames, std::size_t answers)
      : near_(ends.near()), answers_(answers) {
    for (const CanFrame& frame : frames) frames_.push_back(toKernel(frame));
  }

  void exchange() const {
    for (const can_frame& frame : frames_) {
      if (::write(near_, &frame, sizeof frame) != static_cast<ssize_t>(sizeof frame)) fail();
    }
    can_frame answer;
    for (std::size_t i = 0; i < answers_; ++i) {
      if (::read(near_, &answer, sizeof answer) != static_cast<ssize_t>(sizeof answer)) fail();
    }
  }

 private:
  [[noreturn]] static void fail() { throw std::runtime_error("the far end is gone"); }

  int near_;
  std::size_t answers_;
  std::vector<can_frame> frames_;
};

/// The driver's SocketCAN link as the near end.
struct Line {
  Line(CanEnds& ends, const std::vector<std::uint32_t>& ids) : port({ends.interface(), ids}, ends.system()) {
    if (!port.open()) throw std::runtime_error(port.lastError());
  }
  link::SocketCan port;
};

/// The ratio of both, median of the repeats. `what` of the line printed for each, in which both are microseconds.
template <typename Driver, typename Other>
double ratioOf(const Course& course, std::size_t pairs, const char* what, Driver&& driver, Other&& bare) {
  measurePairs(course.pairs(pairs / 5), kBlock, driver, bare);  // warm-up
  std::vector<double> ratios;
  for (int i = 0; i < course.repeats; ++i) {
    const Pair medians = measurePairs(course.pairs(pairs), kBlock, driver, bare);
    ratios.push_back(medians.first / medians.second);
    std::printf("  %s %.2f us (%.0f per s), bare %.2f us, ratio %.3f\n", what, medians.first, 1e6 / medians.first,
                medians.second, ratios.back());
  }
  return median(ratios);
}

inline Course overPairs() {
  const auto pair = [] { return std::make_unique<CanPair>(); };
  return {pair, pair};
}

/// Where the kernel is an emulated one, the same takes ten times as long (`NORD_TIME_FACTOR` of
/// scripts/can_machine.sh).
inline Course overInterfaces(const std::string& of_driver, const std::string& of_bare) {
  const char* factor = std::getenv("NORD_TIME_FACTOR");
  Course course{[of_driver] { return std::make_unique<CanInterface>(of_driver); },
                [of_bare] { return std::make_unique<CanInterface>(of_bare); }};
  course.share = 1.0 / std::max(1.0, factor != nullptr ? std::atof(factor) : 1.0);
  course.repeats = 3;
  course.bounded = false;
  return course;
}

/// The program: what is measured, over what its arguments say. `name` as it was called.
inline int runOnCan(int argc, char** argv, const char* name, bool (*measure)(const Course&)) {
  if (argc != 1 && argc != 3) {
    std::fprintf(
        stderr,
        "usage: %s [INTERFACE OTHER_INTERFACE]\n"
        "Over AF_UNIX pairs, against bounds; or over two CAN interfaces on which nothing else is sent, one for\n"
        "the driver and one for the bare exchange: then the figures are printed, without a bound.\n",
        name);
    return 2;
  }
  try {
    pinTo(kProcessor);
    runUntilWaiting();
    prctl(PR_SET_TIMERSLACK, 1);  // like the thread of the bus cycle
    const BusyOthers busy{kProcessor};
    return measure(argc == 1 ? overPairs() : overInterfaces(argv[1], argv[2])) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  }
}

}  // namespace nord_driver::bench
