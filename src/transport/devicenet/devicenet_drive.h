// One drive on a DeviceNet bus, as the scanner sees it: is it there, what did it send, and in which words.
#pragma once

#include <cstdint>
#include <optional>

#include "devicenet/scanner.h"
#include "nord_driver/transport/transport.h"
#include "profile/ac_drive.h"
#include "transport/devicenet/devicenet_config.h"
#include "transport/devicenet/devicenet_parameters.h"
#include "transport/devicenet/motor_probe.h"
#include "transport/devicenet/state_probe.h"
#include "transport/max_frequency_reads.h"

namespace nord_driver {

/// Each cycle: putOutput() before the exchange, takeInput() after it.
class DevicenetDriveState {
 public:
  /// Tags of the explicit requests: `tag` of the parameters, with kProbeTag of the probe for the state, with kMotorTag of the
  /// one for the motor.
  static constexpr std::uint16_t kProbeTag = 0x8000;
  static constexpr std::uint16_t kMotorTag = 0x4000;

  /// `guest`: no process data are exchanged. `period`: of the bus cycle.
  DevicenetDriveState(const DevicenetDrive& config, const devicenet::IoConfig& io, Duration period, std::uint16_t tag,
                      bool guest);

  /// Into the outputs of its module, which are zeros.
  void putOutput(const profile::ProcessOutput& output, const devicenet::Scanner& scanner,
                 devicenet::IoBytes& bytes) const noexcept;
  /// A fault was found that is told in this cycle: its number can be asked for before the first word ends it.
  bool holdsBack(const devicenet::Scanner& scanner) const noexcept;
  /// `bus_works`: frames can come and go at all.
  void takeInput(const devicenet::Scanner& scanner, bool bus_works, Instant now, DriveExchange& input) noexcept;
  /// It has sent data since `count`, or none can be expected of it.
  bool answered(const devicenet::Scanner& scanner, std::uint64_t count) const noexcept;

  bool submit(const profile::ParameterRequest& request) noexcept;
  std::optional<profile::ParameterResult> pollResult() noexcept;
  /// The explicit requests to start next.
  void runRequests(devicenet::Scanner& scanner, Instant now) noexcept;
  void handleAnswer(const devicenet::ExplicitAnswer& answer, Instant now) noexcept;
  /// The bus is begun anew.
  void handleRestart() noexcept;
  /// What was found to be configured wrongly, told once.
  std::optional<Sentence> takeFinding() noexcept { return motor_.takeFinding(); }

  const DevicenetDrive& config() const noexcept { return config_; }
  bool moduleAnswers() const noexcept { return module_answers_; }
  bool inverterAnswers() const noexcept { return inverter_answers_; }
  /// Why it does not answer; lives as long as this.
  const char* note() const noexcept { return note_.c_str(); }

 private:
  bool decode(ByteView bytes, profile::ProcessInput& input) const noexcept;
  bool tellsFault(ByteView bytes) const noexcept;
  std::optional<Word> faultFound(const devicenet::NodeStatus& status) const noexcept;
  bool takeProcessData(const devicenet::Scanner& scanner, const devicenet::NodeStatus& status, Instant now,
                       DriveExchange& input) noexcept;
  Interruption takeInterruption(const devicenet::NodeStatus& status, bool bus_works, Instant now) noexcept;
  void watchOthers(const devicenet::NodeStatus& status, Instant now) noexcept;
  void explain(const devicenet::NodeStatus& status, bool bus_works) noexcept;

  DevicenetDrive config_;
  devicenet::IoConfig io_;
  Duration period_;
  bool guest_;
  DevicenetParameters parameters_;
  StateProbe probe_;
  MotorProbe motor_;
  profile::AcDriveScaling scaling_;
  MaxFrequencyReads<DevicenetParameters::kCapacity> max_frequency_reads_;
  std::optional<std::uint64_t> connection_;  // which connection of the module it exchanges by; none: it does not
  std::uint64_t foreign_seen_ = 0;
  std::optional<Instant> contested_at_;
  bool contested_ = false;  // another scanner works with it, too
  bool module_answers_ = false;
  bool inverter_answers_ = false;
  bool told_ = false;  // on this connection it has answered to the layers above
  bool met_ = false;   // on any
  Sentence note_;
};

}  // namespace nord_driver
