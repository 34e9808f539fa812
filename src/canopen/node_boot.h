// The life of one node as its NMT master sees it (CiA 302-2, "boot slave"): found, reset, checked, configured, started,
// seen operational; and what follows when a step fails.
//
//     restart -> reset? -> await boot-up -> ask 1000h -> script -> start -> running
//                                            ^  |          |        |        |
//                            nobody answers  |  v          v        v        | lost, boot-up, left the state
//                                           pause <---- refused <- diagnose  v
//                                                                           ask 1000h
//
// A boot-up frame leads to the script at once, from everywhere. It is never waited for without an end: a node whose
// boot-up was missed is found by asking. One that is found with a drive enabled is stopped before all that.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "canopen/boot_script.h"
#include "canopen/boot_times.h"
#include "canopen/boot_up_watch.h"
#include "canopen/double_id_watch.h"
#include "canopen/nmt.h"
#include "canopen/node_config.h"
#include "canopen/node_report.h"
#include "canopen/node_timers.h"
#include "canopen/release_script.h"
#include "canopen/script_repeats.h"
#include "canopen/sdo_port.h"
#include "canopen/start_diagnosis.h"
#include "core/growing_pause.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

class NodeBoot {
 public:
  /// What error control has to do.
  enum class Watch : std::uint8_t {
    kOff,
    kVerify,  ///< the node was started, or is being released: its state is of interest, its silence is no loss
    kWatch    ///< it is operational: its silence is a loss
  };

  /// The references live longer than this. `port`: the node's first SDO server.
  NodeBoot(const NodeConfig& config, std::uint8_t own_id, Duration ask_interval, NodeReport& report, SdoPort& port,
           NodeTimers& timers) noexcept;

  /// One that may still be operational is first told what stops its drive, as after a loss; one that was found driven
  /// until it rests, for `NodeConfig::only_asked` at most.
  void restart(Instant now) noexcept;
  /// Before the `restart()` that begins, and while `NodeStatus::stops_first`.
  void handleMotion(FoundMotion motion) noexcept;
  /// A bus cycle begins; what is sent to a node that is lost went out before.
  void handleCycle() noexcept {
    if (past_.cycles_to_tell > 0) --past_.cycles_to_tell;
  }
  /// What is sent to a node that is lost did not go out before the cycle that begins: all from the beginning.
  void handleUntold() noexcept {
    if (past_.cycles_to_tell > 0) past_.cycles_to_tell = kCyclesToTell;
  }
  /// Lets the node go: a reset of its communication where the configuration allows one; otherwise it is told not to
  /// watch us any more, which takes a second at most, and led to pre-operational. One that is driven by somebody else's
  /// words, or may be, is left as it was found: who it watches may stop it, and it hears what stops it.
  void release(Instant now) noexcept;
  /// Nothing is to be sent to it any more.
  bool released() const noexcept { return isIn<Off>() && !command_; }

  void handleBootUp(Instant now) noexcept;
  /// The node reported its state.
  void handleState(NmtState state, Instant now) noexcept;
  /// Error control failed, and why. Only while `watch()` is kWatch.
  void handleLoss(const Sentence& why, Instant now) noexcept;
  /// Another master told this node something.
  void handleForeignCommand(NmtCommand command, Instant now) noexcept;
  /// Another master asked this node by SDO: answers that come too often are for that master.
  void handleForeignRequest() noexcept;
  /// The node's first SDO server sent an answer nobody waits for; `again`: the same bytes as just before.
  void handleStrayAnswer(bool again, Instant now) noexcept;
  /// In operation it answers each question twice, or sends twice as many heartbeats as one node does.
  void handleDoubleAnswers(Instant now) noexcept;
  /// Takes SDO answers, and does what is due by time.
  void poll(Instant now) noexcept;

  Watch watch() const noexcept;
  /// The node came with a boot-up frame: its toggle bit begins anew.
  bool fresh() const noexcept { return past_.fresh; }
  /// A node that was guarded before and has not been reset counts from its last question on: a life time that it gets
  /// now would be over at once, and the one it has goes on while it is configured. True once: it is to be asked.
  bool takeGuardQuestion() noexcept { return std::exchange(guard_question_, false); }
  /// The NMT command to send, or none; a newer one replaces one that was not sent.
  std::optional<NmtCommand>& command() noexcept { return command_; }

 private:
  // The phases, each with what belongs to it alone.
  struct Off {};
  struct AwaitBootUp {};
  struct Script {
    std::uint8_t tries_left = 0;
    bool answered = false;
    bool missed = false;  // an answer, since the first one
    DoubleIdWatch ids;
  };
  struct Start {
    bool heard = false;
  };
  struct Running {};
  struct Silent {};      // pause between two questions
  struct Refused {};     // pause before the next attempt
  struct Release {       // it is told not to watch us
    bool error_control;  // goes on until then
  };
  using Phase = std::variant<Off, AwaitBootUp, Script, Start, StartDiagnosis, Running, Silent, Refused, Release>;

  /// What is known of the node from one phase to the next.
  struct Past {
    bool reset_due = false;  // it was not reset since it was lost
    bool fresh = false;      // see fresh()
    bool was_operational = false;
    ScriptRepeats repeats;
    bool doubled = false;             // two nodes answered: it was started all the same, to be stopped
    Sentence lost_why;                // empty once it was found again
    Instant lost_at{};                // or taken back last
    std::uint8_t cycles_to_tell = 0;  // before it is asked, or reset
    BootUpWatch boot_ups;
  };

  template <typename P>
  bool isIn() const noexcept {
    return std::holds_alternative<P>(phase_);
  }
  void endRelease(NmtCommand command, Instant now) noexcept;
  void reset(Instant now) noexcept;
  void ask(Instant now) noexcept;
  void submit(const SdoRequest& request, Instant now) noexcept;
  bool missesQuestions() const noexcept;
  void handleAnswer(const SdoAnswer& answer, Instant now) noexcept;
  void handleScriptAnswer(Script& script, const SdoAnswer& answer, Instant now) noexcept;
  void handleDiagnosis(StartDiagnosis& diagnose, const SdoAnswer& answer, Instant now) noexcept;
  void handleNoAnswer(Instant now) noexcept;
  void handleDeadline(Instant now) noexcept;
  void found(Instant now) noexcept;
  void silent(const Sentence& why, Instant now) noexcept;
  void start(bool doubled, Instant now) noexcept;
  void run(Instant now) noexcept;
  void leadBack() noexcept;
  void tellFirst(Instant now) noexcept;
  bool isTold(Instant now) const noexcept;
  bool isStillDriven() const noexcept;
  void begin(Instant now) noexcept;
  void endStopFirst(Instant now) noexcept;
  void leaveAsFound() noexcept;
  void askAgain(Instant now) noexcept;
  void leave(const Sentence& why, Instant now) noexcept;
  void diagnose(bool heard, Instant now) noexcept;
  void refuseStart(const StartDiagnosis& diagnosis, Instant now) noexcept;
  void refuseBoth(Instant now) noexcept;
  void refuse(const Sentence& why, Instant now) noexcept;

  const NodeConfig& config_;
  NodeReport& report_;
  SdoPort& port_;
  NodeTimers& timers_;
  BootScript script_;
  ReleaseScript release_script_;
  SdoRequest request_;  // under way
  Phase phase_;
  Past past_;
  GrowingPause ask_pause_;
  GrowingPause refuse_pause_;
  std::optional<NmtCommand> command_;
  bool guard_question_ = false;
  FoundMotion motion_ = FoundMotion::kRests;
};

}  // namespace nord_driver::canopen
