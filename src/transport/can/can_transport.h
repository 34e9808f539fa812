// What transports on a CAN bus have in common: the interface and its coming back, the frames of a cycle and of the pause
// behind it, the trace, what the controller counts.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/can_engine.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "nord_driver/trace/telegram_trace.h"
#include "nord_driver/transport/transport.h"
#include "transport/can/can_bus_events.h"
#include "transport/can/can_listen_first.h"

namespace nord_driver {

/// Joins a CAN link and a protocol engine; who derives from it adds the drives, and what their bytes mean.
///
/// A cycle: what the engine has to send goes out, then the answers are taken in for the answer window at most, or until
/// each drive has answered. In the pause between two cycles frames go in and out as well: parameters, error control and
/// start-ups do not wait for the next cycle, nor does it for them.
class CanTransport : public Transport {
 public:
  using LinkFactory = std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>;

  bool serveParametersOnly() noexcept final;
  EndPoint endPoint() const noexcept final { return {"interface", "CAN interface", "can0"}; }
  Instant now() const noexcept final { return link_->now(); }
  void sleepUntil(Instant when) noexcept final;
  void exchange(const std::vector<profile::ProcessOutput>& outputs, std::vector<DriveExchange>& inputs) noexcept final;
  std::optional<BusEvent> pollEvent() noexcept final { return events_.poll(); }
  const TelegramTrace* trace() const noexcept final { return trace_ ? &*trace_ : nullptr; }
  /// Everybody who was commanded is released first.
  void close() noexcept final;

 protected:
  struct Setup {
    link::CanSettings link;  ///< for parameters only every frame there is is received
    Duration period{};       ///< of the cycle
    Duration answer_window{};
    Duration longest_release{};
    TelegramTrace::Describe describe;      ///< a frame in words
    std::optional<CanListenFirst> listen;  ///< none: it talks at once
  };

  /// An empty factory: an interface of the kernel, or a virtual bus.
  explicit CanTransport(LinkFactory make_link);

  /// The last that configure() does. Throws ConfigError naming `bus`'s key. `engine` lives as long as this, or until
  /// the next call.
  void prepare(const Settings& bus, Setup setup, CanEngine& engine);

  bool parametersOnly() const noexcept { return parameters_only_; }
  const LinkFactory& linkFactory() const noexcept { return make_link_; }
  const link::CanLink& link() const noexcept { return *link_; }
  CanBusEvents& events() noexcept { return events_; }
  const CanBusEvents& events() const noexcept { return events_; }
  /// As the interface told them last.
  const link::CanCounters& line() const noexcept { return line_; }

  /// Nothing is sent yet, or any more, for the sake of others.
  bool isSilent() const noexcept { return listen_first_ && listen_first_->isSilent(); }
  /// The interface is open and up, and the controller on the bus.
  bool linkWorks() const noexcept;
  /// Begins anew.
  void restart() noexcept;
  /// Tells `handleController()` what has changed.
  void watchController() noexcept;
  /// A frame was seen that only another master sends.
  void noteMaster(std::uint32_t id, Instant at) noexcept;
  /// Why none of the drives answers: the interface, or the silence of this transport; empty when neither is the reason.
  const char* linkNote() const noexcept;
  /// The same of the bus as a whole, in a sentence.
  Sentence linkText() const noexcept;

 private:
  /// The newest values to the engine, and what there is of the answers, for `allAnswered()`.
  virtual void putOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept = 0;
  virtual void takeInputs(Instant now, std::vector<DriveExchange>& inputs) noexcept = 0;
  virtual bool allAnswered() const noexcept = 0;
  /// Answers to parameter requests, and the next ones.
  virtual void runRequests(Instant now) noexcept = 0;
  virtual void takeEvents() noexcept = 0;
  /// The bus is begun anew.
  virtual void restartDrives() noexcept = 0;
  /// The interface was taken away in the middle of a cycle: nobody exchanges until it is back.
  virtual void handleGone() noexcept = 0;
  /// A driver has received a frame while it listens.
  virtual void handleWhileListening(const CanFrame& /*frame*/, Instant /*at*/) noexcept {}
  /// Listening is over, and the engine is about to begin.
  virtual void handleListened() noexcept {}
  /// The interface works again, or does not any more.
  virtual void handleController(bool /*works*/) noexcept {}

  bool linkReady() noexcept;
  bool mayTalk(Instant now) noexcept;
  /// `received`: what had come until then was received.
  void run(Instant received, Instant until, bool until_answered) noexcept;
  /// Takes in what has come; the moment before the first look.
  Instant receive() noexcept;
  void send(Instant until) noexcept;
  void takeLineCounters() noexcept;
  void release() noexcept;

  LinkFactory make_link_;
  bool parameters_only_ = false;
  std::string interface_;
  Duration period_{};
  Duration answer_window_{};
  Duration longest_release_{};
  CanEngine* engine_ = nullptr;
  std::unique_ptr<link::CanLink> link_;
  std::optional<CanListenFirst> listen_first_;
  std::optional<TelegramTrace> trace_;
  CanBusEvents events_;
  bool controller_works_ = true;  // as it was looked at last
  Instant cycle_start_{};
  Instant next_open_{};
  link::CanCounters line_;
  Instant next_line_counters_{};
};

}  // namespace nord_driver
