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
  /// An answer nobody waits for. True once: when there are so many of them that two nodes answer.
  bool handleSurplus() noexcept {
    if (!conclusive_ || found_) return false;
    ++surplus_;
    found_ = surplus_ >= kSurplusOfTwoNodes && 2 * surplus_ >= answers_;
    return found_;
  }
  bool found() const noexcept { return found_; }

 private:
  /// A frame may be received twice (ISO 11898-1: an error in its last bit but one), but not most of the answers.
  static constexpr std::uint32_t kSurplusOfTwoNodes = 4;

  std::uint32_t answers_ = 0;
  std::uint32_t surplus_ = 0;
  bool conclusive_ = true;
  bool found_ = false;
};

}  // namespace nord_driver::canopen
