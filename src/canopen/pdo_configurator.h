// Makes one PDO of a node what it shall be, by SDO: compares everything first and writes only what differs.
//
// Written in the order CiA 301 7.5.2.36 demands: COB-ID with bit 31 set; number of mapped objects 0; the objects; their
// number; transmission type, inhibit time, event timer; COB-ID with bit 31 clear. A device with a mapping that cannot
// be changed is never written to when it already is as wanted.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/dictionary_text.h"
#include "canopen/node_config.h"
#include "canopen/sdo_request.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::canopen {

/// From the node's view.
enum class PdoDirection : std::uint8_t { kReceive, kTransmit };

class PdoConfigurator {
 public:
  /// `config` lives longer than the work on it.
  void begin(PdoDirection direction, const PdoConfig& config) noexcept;

  SdoRequest request() const noexcept;
  /// `answer`: to `request()`, and no time-out.
  Progress handle(const SdoAnswer& answer) noexcept;
  /// Why it failed: one sentence.
  const Sentence& reason() const noexcept { return reason_; }

 private:
  enum class Step : std::uint8_t {
    kReadCobId,
    kReadCount,
    kReadEntry,
    kReadType,
    kReadInhibit,
    kReadEvent,
    kSwitchOff,
    kClearCount,
    kWriteEntry,
    kWriteCount,
    kWriteType,
    kWriteInhibit,
    kWriteEvent,
    kSwitchOn
  };

  Progress compare(const SdoAnswer& answer) noexcept;
  Progress compareCobId(std::uint32_t value) noexcept;
  Progress compareTime(const SdoAnswer& answer, std::uint16_t wanted, bool& differs) noexcept;
  Progress written(const SdoAnswer& answer) noexcept;
  Progress goTo(Step step) noexcept;
  Progress afterMapping() noexcept;
  Progress afterType() noexcept;
  Progress afterInhibit() noexcept;
  Progress decide() noexcept;
  Progress beginWrites() noexcept;
  Progress writeType() noexcept;
  Progress writeInhibit() noexcept;
  Progress writeEvent() noexcept;
  Progress switchOn() noexcept;
  Progress fail(const SdoAnswer& answer) noexcept;
  std::uint16_t parameterIndex() const noexcept;
  std::uint16_t mappingIndex() const noexcept;
  std::uint32_t cobIdOn() const noexcept;

  PdoDirection direction_ = PdoDirection::kReceive;
  const PdoConfig* config_ = nullptr;
  Step step_ = Step::kReadCobId;
  std::uint8_t entry_ = 1;     // sub-index in the mapping
  std::uint32_t present_ = 0;  // COB-ID entry as the node holds it
  bool cob_id_differs_ = false;
  bool mapping_differs_ = false;
  bool type_differs_ = false;
  bool inhibit_differs_ = false;
  bool event_differs_ = false;
  bool stays_on_ = false;  // its COB-ID cannot be written, and need not be
  Sentence reason_;
};

}  // namespace nord_driver::canopen
