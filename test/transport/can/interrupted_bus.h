// A simulated CAN bus whose interface stops to work in the middle of a scan.
#pragma once

#include <functional>
#include <utility>

#include "sim/can/timed_can_bus.h"
#include "sim/sim_config.h"

namespace nord_driver::test {

struct Interruption {
  unsigned last = 0;  ///< with this answer the interface stops to work
  bool bus_off = false;
  bool comes_back = false;  ///< it works again after three frames it did not take
};

/// `Bus`: one of sim::TimedCanBus.
template <typename Bus>
class InterruptedBus final : public Bus {
 public:
  using Sender = sim::TimedCanBus::Sender;

  /// `is_answer`: which of the frames are counted.
  InterruptedBus(const sim::SimConfig& config, const Interruption& interruption,
                 std::function<bool(const CanFrame&, Sender)> is_answer)
      : Bus(config), comes_back_(interruption.comes_back) {
    this->setTap([this, interruption, is_answer = std::move(is_answer), answers = 0u](const CanFrame& frame,
                                                                                      Sender sender, Instant) mutable {
      if (!is_answer(frame, sender) || ++answers != interruption.last) return;
      interruption.bus_off ? this->setBusOff() : this->setInterfaceUp(false);
    });
  }
  link::CanSend send(const CanFrame& frame) noexcept override {
    const link::CanSend result = Bus::send(frame);
    if (result == link::CanSend::kFailed && ++failed_ == 3 && comes_back_) {
      this->setInterfaceUp(true);
      this->restart();
    }
    return result;
  }

 private:
  bool comes_back_;
  unsigned failed_ = 0;
};

}  // namespace nord_driver::test
