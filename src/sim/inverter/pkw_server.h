// The parameter channel (PKW) of a simulated inverter: one order at a time, answered late.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/inverter/parameter_store.h"
#include "sim/inverter/words.h"

namespace nord_driver::sim {

/// The four words of the parameter channel; one layout for orders and answers. BU 2700 6.5.1.
struct PkwWords {
  Word pke = 0;  ///< label in bits 12-15, parameter number + 1000 in bits 0-10
  Word ind = 0;
  Word pwe1 = 0;  ///< high word
  Word pwe2 = 0;  ///< low word, or the error number

  unsigned label() const noexcept { return pke >> 12; }
  friend bool operator==(const PkwWords& a, const PkwWords& b) noexcept {
    return a.pke == b.pke && a.ind == b.ind && a.pwe1 == b.pwe1 && a.pwe2 == b.pwe2;
  }
  friend bool operator!=(const PkwWords& a, const PkwWords& b) noexcept { return !(a == b); }
};

struct PkwSettings {
  unsigned delay = 1;      ///< further telegrams an order waits before it is executed
  bool ram_orders = true;  ///< labels 11-14 are known; BU 0020 7.5.1 and BU 2700 6.5.1.1 contradict each other on that
  bool double_word_answers = true;  ///< false: answers 2 and 5 "only for PPO 2 and PPO 4" (BU 0020 7.5.1), else 202
};

/// An answer an experimenter wants instead of the inverter's own.
struct PkwRefusal {
  Word error = 0;
  std::optional<unsigned> number;  ///< orders for this parameter only
};

/// "As long as an order has not been executed, the inverter sends the response for the previous order"
/// (BU 2700 6.5.1.1).
///
/// The error numbers and how to get them:
///
///     0    a number that does not exist, or a PNU below 1000
///     1    a write to P700
///     2    P507 = 5
///     3    P105 with element 2 (IND 0400), P701 with element 6
///     4    an array order to P513; element 1 of P700 before firmware V1.9
///     5    a double word order to P105, a word order to P613
///     201  a reserved label (4, 5, 10, 15); 11-14 when `ram_orders` is false
///     202  P613 with PPO 1 when `double_word_answers` is false
///     6, 7, 9, 101, 102, 103 and all others: `refuse()`. No parameter of this inverter gives them by itself: 101-103
///     are those of a bus module with several inverters, 7 and 9 of orders that the table does not have.
class PkwServer {
 public:
  PkwServer(ParameterStore& parameters, const PkwSettings& settings) noexcept
      : parameters_(parameters), settings_(settings) {}

  void setDelay(unsigned telegrams) noexcept { settings_.delay = telegrams; }
  /// From now on nothing is executed: the last answer stands for ever.
  void setSilent(bool silent) noexcept { silent_ = silent; }
  /// Orders are answered with this error instead of being executed; nullopt ends it.
  void refuse(const std::optional<PkwRefusal>& refusal) noexcept { refusal_ = refusal; }

  /// The order of one telegram. Its answer is seen in `answer()` at once or `delay` telegrams later.
  void receive(const PkwWords& order) noexcept;
  const PkwWords& answer() const noexcept { return answer_; }

  /// An order that came by another way than the parameter channel: carried out at once, next to it.
  PkwWords executeNow(const PkwWords& order) noexcept { return execute(order); }
  /// The answer "order cannot be executed" with this error number.
  static PkwWords refusal(const PkwWords& order, Word error) noexcept;

  /// True when `order` is the one executed last.
  bool hasAnswered(const PkwWords& order) const noexcept { return executed_ && order == order_; }

  /// Mains back: no order, no answer.
  void reset() noexcept;

 private:
  PkwWords execute(const PkwWords& order) noexcept;

  ParameterStore& parameters_;
  PkwSettings settings_;
  std::optional<PkwRefusal> refusal_;
  bool silent_ = false;
  PkwWords order_;
  PkwWords answer_;
  unsigned waiting_ = 0;
  bool executed_ = true;
};

}  // namespace nord_driver::sim
