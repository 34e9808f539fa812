// The parameter channel (PKW) of a simulated inverter: one order at a time, answered late.
#pragma once

#include <cstdint>

#include "nord_driver/sim/parameter_store.h"
#include "nord_driver/sim/words.h"

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

/// "As long as an order has not been executed, the inverter sends the response for the previous order" (BU
/// 2700 6.5.1.1).
class PkwServer {
 public:
  /// `delay`: further telegrams an order has to wait before it is executed. `ram_orders`: order labels 11-14 are known;
  /// the manuals contradict each other on which inverters know them (BU 0020 7.5.1, BU 2700 6.5.1.1).
  PkwServer(ParameterStore& parameters, unsigned delay, bool ram_orders) noexcept
      : parameters_(parameters), delay_(delay), ram_orders_(ram_orders) {}

  void setDelay(unsigned telegrams) noexcept { delay_ = telegrams; }

  /// The order of one telegram. Its answer is seen in `answer()` at once or `delay` telegrams later.
  void receive(const PkwWords& order) noexcept;
  const PkwWords& answer() const noexcept { return answer_; }

  /// True when `order` is the one executed last.
  bool hasAnswered(const PkwWords& order) const noexcept { return executed_ && order == order_; }

  /// Mains back: no order, no answer.
  void reset() noexcept;

 private:
  PkwWords execute(const PkwWords& order) noexcept;

  ParameterStore& parameters_;
  unsigned delay_;
  bool ram_orders_;
  PkwWords order_;
  PkwWords answer_;
  unsigned waiting_ = 0;
  bool executed_ = true;
};

}  // namespace nord_driver::sim
