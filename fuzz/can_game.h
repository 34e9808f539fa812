// A protocol engine on a CAN bus against a fuzzer: what is played with every one of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/can_engine.h"
#include "fuzz.h"

namespace nord_driver::fuzz {

class CanGame {
 public:
  virtual ~CanGame() = default;

  /// Until the fuzzer's bytes are used up; then silence, in which what is still asked for is answered within the
  /// time-outs.
  void play() {
    well_behaved_ = false;
    while (!choices_.empty()) {
      now_ += std::chrono::milliseconds{choices_.below(60)};
      act();
      settle();
    }
    for (int i = 0; pending_ > 0; ++i) {
      require(i < 5000 && engine_.nextDeadline());
      now_ = std::max(now_, *engine_.nextDeadline());
      settle();
    }
    checkEnd();
  }

 protected:
  /// `engine` need not be constructed yet.
  CanGame(Choices& choices, CanEngine& engine) : choices_(choices), engine_(engine) {}

  void begin(const std::vector<std::uint32_t>& ids, std::uint32_t highest) {
    highest_id_ = highest;
    require(std::is_sorted(ids.begin(), ids.end()) && ids.back() <= highest);
    engine_.restart(now_);
  }

  void hear(const CanFrame& frame) { engine_.handleFrame(frame, now_); }
  void hearAnything() {
    CanFrame frame = dataFrame((choices_.byte() << 3u | choices_.below(8)) & 0x7FFu, choices_.bytes(choices_.below(9)));
    frame.remote = choices_.below(16) == 0;
    frame.extended = choices_.below(16) == 0;
    hear(frame);
  }

  void settle() {
    for (int i = 0; i == 0 || (engine_.nextDeadline() && *engine_.nextDeadline() <= now_); ++i) {
      require(i < 100);
      engine_.poll(now_);
      if (!send()) break;
    }
    takeAnswers();
  }

  Choices& choices_;
  Instant now_{std::chrono::hours{1}};
  std::size_t pending_ = 0;  // requests without an answer
  bool well_behaved_ = true;

 private:
  /// One turn of the fuzzer's.
  virtual void act() = 0;
  /// The engine has sent it.
  virtual void handleSent(const CanFrame& frame) = 0;
  /// Events, and the answers to requests.
  virtual void takeAnswers() = 0;
  virtual void checkEnd() = 0;

  /// False when the link took no more.
  bool send() {
    CanFrame frame;
    for (int i = 0; engine_.pollTransmit(frame); ++i) {
      require(i < 100 && !frame.extended && frame.id <= highest_id_ && frame.size <= 8);
      if (!well_behaved_ && choices_.below(64) == 63) {
        engine_.notSent();
        return false;
      }
      handleSent(frame);
    }
    return true;
  }

  CanEngine& engine_;
  std::uint32_t highest_id_ = 0;
};

/// `Engine` has nodeCount() and status().
template <typename Engine, typename State>
bool allAre(const Engine& engine, State state) {
  for (std::size_t i = 0; i < engine.nodeCount(); ++i) {
    if (engine.status(i).state != state) return false;
  }
  return true;
}

}  // namespace nord_driver::fuzz
