// The referee of the segment: counts every rule of the bus the master breaks.
//
// It sees what the master sends and which answers reach it, and judges by what the master can know: a station that lost
// power is no mistake of the master, talking on as if nothing had happened is.
#pragma once

#include <array>
#include <cstdint>

#include "nord_driver/core/time.h"
#include "sim/inverter/pkw_server.h"
#include "sim/profibus/telegram.h"
#include "sim/rule_counts.h"

namespace nord_driver::sim {

enum class Rule : std::uint8_t {
  kShortPause,   ///< judged only where the time is simulated
  kCollision,    ///< judged only where the time is simulated
  kEarlyAnswer,  ///< judged only where the time is simulated
  kNoTelegram,
  kNotARequest,
  kUnknownFunction,
  kFrameCountOnUnacknowledged,
  kFirstRequestWithoutFcb,
  kFcvBeforeFirstRequest,
  kFcbReused,
  kFcbToggledWithoutAnswer,
  kDiagnosisWithData,
  kWrongParameterLength,
  kParameterisedWithoutLock,
  kConfiguredBeforeParameterised,
  kDataExchangeBeforeReady,
  kWrongDataLength,
  kWriteOrderLeftStanding,
  kZeroControlWord,
  kRecordBeforeReady,
  kRecordWhileOutstanding,
  kCount,
};

/// One sentence on the rule, with its source.
const char* toString(Rule rule) noexcept;

class Referee : public RuleCounts<Rule> {
 public:
  static constexpr unsigned kStations = 128;
  static constexpr unsigned kInverters = 4;
  /// How often a parameter write order may still be seen after its answer: the master learns of the answer a cycle
  /// late.
  static constexpr unsigned kStandingTolerance = 3;

  /// A telegram of the master.
  void request(const Telegram& telegram) noexcept;
  /// The answer to the last request reached the master: a telegram, or SC.
  void answer(const Telegram& telegram) noexcept;
  /// Bytes of outputs a station was built for.
  void outputLength(std::uint8_t station, std::size_t expected) noexcept {
    stations_[station].output_length = expected;
  }
  /// `answered`: this very order had been executed before it came once more. `inverter`: 0-3 behind one module.
  void parameterChannel(std::uint8_t station, const PkwWords& order, bool answered, unsigned inverter = 0) noexcept;

 private:
  /// What the master can know of a station.
  enum class View : std::uint8_t { kUnknown, kParameterised, kConfigured, kReady };
  struct Station {
    View view = View::kUnknown;
    bool first_request_sent = false;
    bool answered = true;  // the last request that carried a frame count bit
    Telegram last;
    std::size_t output_length = 0;  // 0 = not known
    std::array<unsigned, kInverters> standing{};
    bool record_outstanding = false;
  };

  /// False: the last telegram once more.
  bool frameCount(Station& station, const Telegram& telegram) noexcept;
  void service(Station& station, const Telegram& telegram, bool repeated) noexcept;

  std::array<Station, kStations> stations_{};
  Telegram pending_;
  bool awaiting_ = false;
};

}  // namespace nord_driver::sim
