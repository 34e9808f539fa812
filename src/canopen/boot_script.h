// Everything that is read and written in the object dictionary of a node before it is started (CiA 302-2): device type,
// identity, set-up, PDOs, error control. One access after the other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "canopen/compared_write.h"
#include "canopen/dictionary_text.h"
#include "canopen/node_config.h"
#include "canopen/node_status.h"
#include "canopen/pdo_configurator.h"
#include "canopen/sdo_request.h"

namespace nord_driver::canopen {

class BootScript {
 public:
  /// `own_id`: ours, for 1016h. `config` lives longer than this.
  BootScript(const NodeConfig& config, std::uint8_t own_id) noexcept;

  /// From the beginning: the first access asks for 1000h, which every node has.
  void begin() noexcept;
  /// The access that comes next. Not when done.
  SdoRequest request() const noexcept;
  /// `answer`: to `request()`, and no time-out. What was read of the identity is noted in `status`.
  Progress handle(const SdoAnswer& answer, NodeStatus& status) noexcept;
  /// Why it failed: one sentence.
  const Sentence& reason() const noexcept { return reason_; }

 private:
  enum class Stage : std::uint8_t { kDeviceType, kIdentity, kSetup, kReceivePdo, kTransmitPdo, kErrorControl, kDone };

  Progress handleDeviceType(const SdoAnswer& answer, NodeStatus& status) noexcept;
  Progress handleIdentity(const SdoAnswer& answer, NodeStatus& status) noexcept;
  Progress next() noexcept;
  bool beginStep() noexcept;
  const std::optional<std::uint32_t>& wantedIdentity() const noexcept;
  Progress differs(const char* what, std::uint32_t found, std::uint32_t wanted) noexcept;
  template <typename Part>
  Progress handlePart(Part& part, const SdoAnswer& answer) noexcept;

  const NodeConfig& config_;
  FixedVector<SetupWrite, 3> error_control_;
  Stage stage_ = Stage::kDeviceType;
  std::size_t step_ = 0;  // within the stage
  ComparedWrite write_;
  PdoConfigurator pdo_;
  Sentence reason_;
};

}  // namespace nord_driver::canopen
