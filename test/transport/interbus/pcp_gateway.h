// The two register blocks of a gateway that offers Compact PCP, as the manuals say: one service at a time, whose result
// stands until service 0 is written; services written meanwhile wait. It fails as it is told.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "link/modbus/register_order.h"
#include "transport/interbus/interbus_parameters.h"

namespace nord_driver::test {

constexpr Word kPcpRead = 0x0081, kPcpWrite = 0x0082, kPcpInitiate = 0x008B, kPcpAborted = 0x01AD;

class PcpGateway {
 public:
  struct Refusal {
    Word service = 0;
    Word class_and_code = 0;
  };

  /// What becomes of the next services, each waiting for one of its kind; 0: it is granted.
  std::deque<Refusal> refusals;
  bool stalls = false;  ///< what it has taken is not confirmed
  bool aborts = false;  ///< what it has taken is answered with an abort of the connection
  bool drops = false;   ///< service 0 ends what it has not confirmed
  /// All services confirmed: service, and the number of the parameter.
  std::vector<std::pair<Word, unsigned>> served;

  static PcpMap map(bool initiate) {
    PcpMap map;
    map.invoke_address = 500;
    map.result_address = 600;
    map.initiate = initiate;
    return map;
  }
  /// The raw value of a parameter is ten times its number.
  link::RegisterAnswer carryOut(const link::RegisterOrder& order) {
    link::RegisterAnswer answer;
    answer.good = true;
    if (order.write) {
      invoke_ = order.values;
    } else {
      answer.values = result_;
    }
    return answer;
  }
  void advance() {
    if (!taken_) {
      if (invoke_[0] != 0) taken_ = invoke_;
    } else if (result_[0] == 0) {
      if (drops && invoke_[0] == 0) taken_.reset();
      if (taken_ && !stalls) confirm();
    } else if (invoke_[0] == 0) {
      result_ = {};
      taken_.reset();
    }
  }
  long count(Word service) const {
    long found = 0;
    for (const auto& one : served) found += one.first == service ? 1 : 0;
    return found;
  }

 private:
  using Block = std::array<Word, link::RegisterOrder::kMostWords>;

  void confirm() {
    const Block& order = *taken_;
    const unsigned number = order[2] & 0x0FFFu;
    served.emplace_back(order[0], number);
    result_[0] = static_cast<Word>(order[0] + 0x0100u);
    result_[1] = order[1];
    if (aborts) {
      result_[0] = kPcpAborted;
      return;
    }
    if (!refusals.empty() && refusals.front().service == order[0]) {
      result_[2] = refusals.front().class_and_code;
      refusals.pop_front();
    }
    if (result_[2] != 0) return;
    if (order[0] == kPcpRead) {
      result_[4] = 2;
      result_[5] = static_cast<Word>(10u * number);
    }
  }

  Block invoke_{}, result_{};
  std::optional<Block> taken_;
};

}  // namespace nord_driver::test
