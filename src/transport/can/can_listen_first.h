// Listens on a CAN bus before anything is sent: a start-up would take the nodes away from the master that has them, or
// be in its way.
#pragma once

#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// What listening means on one bus. Texts are literals.
struct ListenRules {
  /// Such a frame is only there when somebody else works with the bus.
  bool (*shows_other)(const CanFrame&) noexcept;
  const char* heard_note;      ///< why a drive does not answer: somebody else was heard
  const char* listening_note;  ///< ... it is still listened
  const char* beside;          ///< beside whom nothing is sent, and what helps: "another scanner: end it"
};

/// Who listens.
enum class CanListener : std::uint8_t {
  kGuest,  ///< a program for parameters: keeps off for good where anybody works with the bus, and gives way later
  kDriver  ///< of these nodes: waits until another master has ended, and then holds them against everybody
};

/// Silent from the first `restart()` on for as long as it listens, and for as long as somebody else has the bus.
class CanListenFirst {
 public:
  /// A driver's other master has ended when it was silent for so long: an RPDO or a question each second at least is
  /// what can be expected of one.
  static constexpr std::chrono::seconds kGone{2};

  CanListenFirst(const ListenRules& rules, Duration time, CanListener who = CanListener::kGuest) noexcept
      : rules_(rules), time_(time), who_(who) {}

  /// The bus was opened. A driver that has begun to talk goes on: it has had the nodes, which may turn, and must hear
  /// from it at once.
  void restart(Instant now) noexcept;
  /// A guest, while it listens: whatever was received.
  void handle(const CanFrame& frame) noexcept;
  /// At any time: a frame that only a master sends. A driver that has begun to talk does not mind.
  void handleMaster(std::uint32_t id, Instant at) noexcept;
  /// The interface is away, down or bus-off: nobody can be heard, so that this time does not count as listening.
  void postpone(Instant now) noexcept;
  /// After everything received until `now` was handled. Once true, it stays so; for a guest until a master is heard or
  /// `restart()`.
  bool mayTalk(Instant now) noexcept;

  CanListener who() const noexcept { return who_; }
  /// As `mayTalk()` has told it last.
  bool isSilent() const noexcept { return listening_ || heard_; }
  /// The identifier heard first; of a driver last.
  std::optional<std::uint32_t> heard() const noexcept { return heard_; }
  /// When listening is over; for a guest not once somebody was heard.
  std::optional<Instant> nextDeadline() const noexcept;
  /// Why a drive does not answer, while it is silent; a literal.
  const char* note() const noexcept;
  /// Why nothing is sent: one sentence; empty when it may talk.
  Sentence text() const noexcept;

 private:
  ListenRules rules_;
  Duration time_;
  CanListener who_;
  bool listening_ = true;
  Instant end_{};
  std::optional<std::uint32_t> heard_;
};

}  // namespace nord_driver
