// Whether two nodes answer with one id: then more answers come than questions were asked.
#pragma once

#include <cstdint>

namespace nord_driver::canopen {

class DoubleIdWatch {
 public:
  /// A question of ours was answered, or its time was over.
  void handleAnswer() noexcept { ++answers_; }
  /// Another master asks this node as well, or answers of ours may come late: nothing can be concluded any more.
  void giveUp() noexcept { conclusive_ = false; }
  /// An answer nobody waits for. True once: when there are so many of them that two nodes answer. `again`: it is the one
  /// before, once more. A frame may be received twice (ISO 11898-1: an error in its last bit but one), but not most of
  /// them; any other answer is one too many.
  bool handleSurplus(bool again) noexcept {
    if (!conclusive_ || found_) return false;
    ++surplus_;
    if (!again) ++others_;
    found_ = others_ >= kOfTwoNodes || (surplus_ >= kOfTwoNodes && 2 * surplus_ >= answers_);
    return found_;
  }
  /// Some answers were not those to our questions.
  bool mixed() const noexcept { return others_ != 0; }
  bool found() const noexcept { return found_; }

 private:
  /// A few may be late ones, to questions that were given up when the node booted up.
  static constexpr std::uint32_t kOfTwoNodes = 4;

  std::uint32_t answers_ = 0;
  std::uint32_t surplus_ = 0;
  std::uint32_t others_ = 0;  // of these, unlike the answer before
  bool conclusive_ = true;
  bool found_ = false;
};

}  // namespace nord_driver::canopen
