// The parameter channels of a PROFIBUS segment: a PKW per inverter that has one, records for the others and for the
// modules.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/transport/transport.h"
#include "profibus/class2_master.h"
#include "profibus/dp_master.h"
#include "profile/pkw_channel.h"
#include "transport/profibus/profibus_dp_config.h"
#include "transport/profibus/record_parameter_channel.h"

namespace nord_driver {

/// P150 to P199 belong to the bus module wherever it has an acyclic channel; the number decides which way a request
/// takes. All drives behind a module share the module's channel.
class ProfibusParameters {
 public:
  /// `config` must outlive the object. Where it is used for records only no PKW is exchanged.
  ProfibusParameters(const ProfibusDpConfig& config, Duration answer_timeout);
  ProfibusParameters(const ProfibusParameters&) = delete;
  ProfibusParameters& operator=(const ProfibusParameters&) = delete;

  /// False: full. What has no channel is refused by a result.
  bool submit(DriveIndex drive, const profile::ParameterRequest& request, Instant now) noexcept;
  std::optional<profile::ParameterResult> pollResult() noexcept;
  std::uint64_t stale() const noexcept;

  /// PKW of the next exchange of a drive that has one, and of its answer.
  profile::PkwWords pollWords(DriveIndex drive, Instant now) noexcept { return drives_[drive].pkw.pollWords(now); }
  void handleWords(DriveIndex drive, const profile::PkwWords& words, Instant now) noexcept {
    drives_[drive].pkw.handleWords(words, now);
  }
  /// `why`: for who waits for a parameter; empty: it does not answer.
  void handleInverterOffline(DriveIndex drive, const Sentence& why, Instant now) noexcept;
  void handleStationOffline(std::size_t station, const Sentence& why, Instant now) noexcept;

  /// Before a cycle: what is to go beside it. After it: what came of it.
  void submitRecords(profibus::DpMaster& master, Instant now) noexcept;
  void takeRecords(profibus::DpMaster& master, Instant now) noexcept;
  void submitRecords(profibus::Class2Master& master, Instant now) noexcept;
  void takeRecords(profibus::Class2Master& master, Instant now) noexcept;

  struct StatusAnswer {
    Word word = 0;  ///< 0: it could not be read
    Sentence why;
  };
  /// Reads P741 [-01], the status word an inverter shows, where nobody exchanges data with it. Not by PKW.
  void requestStatusWord(DriveIndex drive, Instant now) noexcept;
  std::optional<StatusAnswer> pollStatusWord(DriveIndex drive) noexcept;

  /// Reads P173 of a module.
  void requestModuleStatus(std::size_t station, Instant now) noexcept;
  std::optional<Word> pollModuleStatus(std::size_t station) noexcept;
  /// A drive for which the module answered that its inverter does not exist (101, 102), once for each time.
  std::optional<DriveIndex> pollAbsence() noexcept;

 private:
  struct DriveChannel {
    explicit DriveChannel(Duration answer_timeout) : pkw(answer_timeout) {}
    profile::PkwChannel pkw;
    std::optional<RecordParameterChannel> records;
    bool status_asked = false;
    std::optional<StatusAnswer> status;
  };
  struct StationChannels {
    std::optional<RecordParameterChannel> module;
    std::vector<RecordParameterChannel*> users;  // of the one record at a time; the module's first
    std::size_t user = 0;
    bool status_asked = false;
    std::optional<Word> status;
  };

  bool recordsOnly() const noexcept { return config_.use == ProfibusUse::kRecordsOnly; }
  template <typename Master>
  void submitTo(Master& master, Instant now) noexcept;
  static void takeStatusWord(DriveChannel& channel, const profile::ParameterResult& result) noexcept;
  std::optional<profile::ParameterResult> pollDrive(DriveIndex drive) noexcept;
  std::optional<profile::ParameterResult> pollModule(StationChannels& station) noexcept;

  const ProfibusDpConfig& config_;
  std::vector<DriveChannel> drives_;
  std::vector<StationChannels> stations_;
  FixedVector<profile::ParameterResult, 16> refused_;
  FixedVector<DriveIndex, 32> absent_;
  std::size_t cursor_ = 0;
};

}  // namespace nord_driver
