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
// boot-up was missed is found by asking.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "canopen/boot_script.h"
#include "canopen/nmt.h"
#include "canopen/node_config.h"
#include "canopen/node_report.h"
#include "canopen/release_script.h"
#include "canopen/sdo_port.h"
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
  NodeBoot(const NodeConfig& config, std::uint8_t own_id, Duration ask_interval, NodeReport& report,
           SdoPort& port) noexcept;

  void restart(Instant now) noexcept;
  /// Lets the node go: a reset of its communication where the configuration allows one; otherwise it is told not to
  /// watch us any more, which takes a second at most, and led to pre-operational.
  void release(Instant now) noexcept;
  /// Nothing is to be sent to it any more.
  bool released() const noexcept { return phase_ == Phase::kOff && !command_; }

  void handleBootUp(Instant now) noexcept;
  /// The node reported its state.
  void handleState(NmtState state, Instant now) noexcept;
  /// Error control failed, and why. Only while `watch()` is kWatch.
  void handleLoss(const Sentence& why, Instant now) noexcept;
  /// Another master told this node something.
  void handleForeignCommand(NmtCommand command, Instant now) noexcept;
  /// Another master asked this node by SDO: answers that come too often are for that master.
  void handleForeignRequest() noexcept { answers_are_ours_ = false; }
  /// The node's first SDO server sent an answer nobody waits for.
  void handleStrayAnswer(Instant now) noexcept;
  /// Takes SDO answers, and does what is due by time.
  void poll(Instant now) noexcept;

  std::optional<Instant> nextDeadline() const noexcept { return deadline_; }
  Watch watch() const noexcept;
  /// The node came with a boot-up frame: its toggle bit begins anew.
  bool fresh() const noexcept { return fresh_; }
  /// A node that was guarded before and has not been reset may count from its last question on: a life time that it
  /// gets now would be over at once. True once: it is to be asked first.
  bool takeGuardQuestion() noexcept { return std::exchange(guard_question_, false); }
  /// The NMT command to send, or none; a newer one replaces one that was not sent.
  std::optional<NmtCommand>& command() noexcept { return command_; }

 private:
  enum class Phase : std::uint8_t {
    kOff,
    kAwaitBootUp,
    kScript,
    kStart,
    kReadErrorRegister,
    kReadErrorField,
    kRunning,
    kSilent,   // pause between two questions
    kRefused,  // pause before the next attempt
    kRelease   // it is told not to watch us
  };

  void endRelease(NmtCommand command, Instant now) noexcept;
  void reset(Instant now) noexcept;
  void ask(Instant now) noexcept;
  void submit(const SdoRequest& request, Instant now) noexcept;
  void handleAnswer(const SdoAnswer& answer, Instant now) noexcept;
  void handleScriptAnswer(const SdoAnswer& answer, Instant now) noexcept;
  void handleNoAnswer(Instant now) noexcept;
  void handleDeadline(Instant now) noexcept;
  void found(Instant now) noexcept;
  void silent(const Sentence& why, Instant now) noexcept;
  void start(Instant now) noexcept;
  void run(Instant now) noexcept;
  void leadBack() noexcept;
  void leave(const Sentence& why, Instant now) noexcept;
  void diagnose(Instant now) noexcept;
  void refuseStart(Instant now) noexcept;
  void refuseBoth(Instant now) noexcept;
  void refuse(const Sentence& why, Instant now) noexcept;
  bool repeated(Instant now) noexcept;

  const NodeConfig& config_;
  Duration ask_interval_;
  NodeReport& report_;
  SdoPort& port_;
  BootScript script_;
  ReleaseScript release_script_;
  SdoRequest request_;  // under way
  Phase phase_ = Phase::kOff;
  std::optional<Instant> deadline_;
  std::optional<NmtCommand> command_;
  bool reset_due_ = false;  // it was not reset since it was lost
  bool fresh_ = false;
  bool guard_question_ = false;
  bool guards_ = false;    // releasing: error control goes on until the node does not watch us any more
  bool answered_ = false;  // in this attempt
  bool heard_ = false;     // after the start
  // In this attempt: whether there is one answer for each question.
  bool answers_are_ours_ = true;
  std::uint32_t answers_ = 0;
  std::uint32_t surplus_answers_ = 0;
  bool two_answer_ = false;
  bool doubled_ = false;  // it was started all the same, to be stopped
  bool was_operational_ = false;
  Sentence lost_why_;  // empty once it was found again
  std::uint8_t tries_left_ = 0;
  Duration ask_pause_{};
  Duration refuse_pause_{};
  std::optional<std::uint8_t> error_register_;
  std::optional<std::uint16_t> last_error_;
  std::optional<Instant> last_boot_up_;
  std::uint32_t boot_ups_in_a_row_ = 0;
};

}  // namespace nord_driver::canopen
