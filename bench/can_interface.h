// A CAN interface of the kernel (vcan0): the far end is a raw socket, the near one that or the driver's own link.
#pragma once

#include <string>

#include "can_ends.h"

namespace nord_driver::bench {

class CanInterface final : public CanEnds {
 public:
  /// Throws std::runtime_error when there is no such interface.
  explicit CanInterface(const std::string& name);
  ~CanInterface() override;
  CanInterface(const CanInterface&) = delete;
  CanInterface& operator=(const CanInterface&) = delete;

  /// Opened with the first call: it gets every frame there is from then on.
  int near() override;
  int far() const override { return far_; }
  const char* interface() const override { return name_.c_str(); }
  link::CanSystem& system() override { return link::linuxCanSystem(); }

 private:
  int openSocket() const;

  std::string name_;
  int near_ = -1;
  int far_ = -1;
};

}  // namespace nord_driver::bench
