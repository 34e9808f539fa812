// The frame count bit: how a slave tells a new request from a repeated one.
#pragma once

#include <cstdint>

namespace nord_driver::profibus {

/// EN 50170-4: the first request to a station, or the first after it was given up, carries FCV = 0 and FCB = 1; after
/// that FCV = 1 and FCB toggles with every new request. A retry repeats the very same bytes and therefore never asks
/// this class.
class FrameCount {
 public:
  /// FCB (20h) and FCV (10h) of the next request.
  constexpr std::uint8_t bits() const noexcept {
    if (first_) return kFcb;
    return fcb_ ? kFcb | kFcv : kFcv;
  }
  /// The request was answered: the next one is a new one.
  constexpr void answered() noexcept {
    fcb_ = first_ ? false : !fcb_;
    first_ = false;
  }
  /// The station was given up, or starts from the beginning.
  constexpr void reset() noexcept { first_ = true; }

 private:
  static constexpr std::uint8_t kFcb = 0x20;
  static constexpr std::uint8_t kFcv = 0x10;

  bool first_ = true;
  bool fcb_ = false;
};

}  // namespace nord_driver::profibus
