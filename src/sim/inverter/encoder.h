// The encoder at the motor shaft and what the inverter makes of it: a position in revolutions.
#pragma once

#include "sim/inverter/posicon_settings.h"

namespace nord_driver::sim {

/// Keeps its place without mains when it is absolute (BU 2700 5.3: CANopen absolute encoder).
class Encoder {
 public:
  Encoder(EncoderKind kind, double position) noexcept
      : kind_(kind), zero_(-position), referenced_(kind == EncoderKind::kAbsolute) {}

  /// Mains on, with the shaft at this many revolutions since the simulation began.
  void powerOn(double shaft) noexcept {
    if (kind_ == EncoderKind::kAbsolute) return;
    zero_ = shaft;
    referenced_ = false;
  }
  /// "Here is `position`": reference point and reset.
  void setPosition(double shaft, double position) noexcept {
    zero_ = shaft - position;
    referenced_ = true;
  }

  /// Revolutions, for a shaft at `shaft`.
  double position(double shaft) const noexcept { return shaft - zero_; }
  /// Somebody has said where it is.
  bool referenced() const noexcept { return referenced_; }

 private:
  EncoderKind kind_;
  double zero_;
  bool referenced_;
};

}  // namespace nord_driver::sim
