// One drive on a CANopen bus, as its master sees it: is it there, what did it send, and in which words.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/master.h"
#include "nord_driver/transport/transport.h"
#include "profile/cia402.h"
#include "profile/status_word.h"
#include "transport/canopen/canopen_config.h"
#include "transport/canopen/canopen_parameters.h"
#include "transport/canopen/module_link.h"
#include "transport/max_frequency_reads.h"

namespace nord_driver {

/// Each cycle: putOutput() before the exchange, takeInput() after it.
class CanopenDriveState {
 public:
  CanopenDriveState(const CanopenDrive& config, std::uint16_t tag);

  /// A drive that was found enabled gets the word that stops it, in its parameter set, whatever `output` is.
  void putOutput(const profile::ProcessOutput& output, canopen::Master& master) noexcept;
  /// What its last TPDO tells of a drive whose node was not begun with; `asked`: by SYNC it would tell.
  canopen::FoundMotion foundMotion(const canopen::Master& master, bool asked, Instant now) const noexcept;
  /// `bus_works`: frames can come and go at all.
  void takeInput(const canopen::Master& master, bool bus_works, Instant now, DriveExchange& input) noexcept;

  bool submit(const profile::ParameterRequest& request) noexcept;
  std::optional<profile::ParameterResult> pollResult() noexcept;
  CanopenParameters& parameters() noexcept { return parameters_; }
  /// The bus is begun anew.
  void handleRestart() noexcept;

  const CanopenDrive& config() const noexcept { return config_; }
  bool inverterAnswers() const noexcept { return inverter_answers_; }
  /// Why it does not answer; lives as long as this.
  const char* note() const noexcept { return note_.c_str(); }
  /// The emergency that stands, in words; empty when none does.
  const Sentence& emergency() const noexcept { return emergency_text_; }

 private:
  profile::StatusWord foundStatus(const canopen::Master& master) const noexcept;
  void put(const profile::ProcessOutput& output, canopen::Master& master) noexcept;
  bool decode(ByteView bytes, profile::ProcessInput& input) const noexcept;
  void takeEmergencies(const canopen::NodeStatus& status) noexcept;
  void forgetEmergency() noexcept;
  bool moduleMissesInverter(const canopen::NodeStatus& status, const canopen::PdoValue& pdo, Word status_word,
                            Instant now) noexcept;
  Interruption takeInterruption(const canopen::NodeStatus& status, bool bus_works) noexcept;
  void explain(const canopen::NodeStatus& status, bool bus_works, bool ever_sent, bool overdue) noexcept;

  CanopenDrive config_;
  CanopenParameters parameters_;
  profile::Cia402Scaling scaling_;
  MaxFrequencyReads<CanopenParameters::kCapacity> max_frequency_reads_;
  std::optional<std::uint64_t> start_;  // which start of the node it is operational from; none: it is not, or twice
  bool module_answers_ = false;
  bool inverter_answers_ = false;
  bool contested_ = false;  // another master commands it, too
  std::uint64_t emergencies_seen_ = 0;
  std::uint16_t emergency_code_ = 0;
  Instant emergency_at_{};
  ModuleLink module_link_;  // of an inverter behind a gateway
  Sentence emergency_text_;
  Sentence note_;
};

}  // namespace nord_driver
