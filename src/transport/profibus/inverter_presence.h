// Which of the inverters behind a bus module are on. The module exchanges data for those that are off, too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// Four witnesses (BU 0020 2.1.3, 8.2; BU 2700 6.5.1.1, 7.1.3): a status word of zeros; the diagnosis 02 04 of the
/// module, which does not say whose link is broken; the parameter errors 101 and 102; P173, which says it of each
/// inverter, and is asked for only when the others leave it open. In doubt an inverter is off. A parameter error passes
/// where P173 cannot be asked for, or is not answered, and useful status words come.
class InverterPresence {
 public:
  static constexpr std::size_t kMaxInverters = 4;

  /// `asks`: P173 can be read.
  InverterPresence(std::size_t inverters, bool asks) noexcept : count_(inverters), asks_(asks) {}

  /// Each exchange: `useful[i]` for a status word of inverter i that is one.
  void handleExchange(bool link_broken, const std::array<bool, kMaxInverters>& useful, Instant now) noexcept;
  /// The module is not in data exchange.
  void handleSilence() noexcept;
  /// Parameter error 101 or 102 on behalf of an inverter.
  void handleAbsence(std::size_t inverter, Instant now) noexcept;
  /// P173; `number[i]` is the number 1..4 of inverter i behind the module.
  void handleModuleStatus(Word status, const std::array<std::uint8_t, kMaxInverters>& number) noexcept;

  bool wantsModuleStatus(Instant now) noexcept;
  /// The diagnosis contradicts the status words: it may be an old one.
  bool doubtsDiagnosis(Instant now) noexcept;

  bool answers(std::size_t inverter) const noexcept;
  bool linkBroken() const noexcept { return link_broken_; }

 private:
  struct Inverter {
    bool useful = false;
    bool absent = false;  // by a parameter error
    Instant absent_since{};
    bool online = false;  // by P173, since there is a doubt
  };
  bool isOpen() const noexcept;

  std::size_t count_;
  bool asks_;
  bool link_broken_ = false;
  std::array<Inverter, kMaxInverters> inverters_{};
  Instant next_status_{};
  std::optional<Instant> unanswered_since_;  // P173 was asked for then, and not told since
  Instant next_diagnosis_{};
};

}  // namespace nord_driver
