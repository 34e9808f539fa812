// Store parameters (1010h) and restore default parameters (1011h) of a node: asked what it can do, then commanded by
// the signature "save" or "load" (CiA 301 7.5.2.13, 7.5.2.14).
#pragma once

#include <cstdint>

#include "canopen/dictionary_text.h"
#include "canopen/sdo_request.h"

namespace nord_driver::canopen {

enum class StoreAction : std::uint8_t {
  kStore,   ///< 1010h, "save"
  kRestore  ///< 1011h, "load"
};

/// One command to one node, in the manner of ComparedWrite: `request()` goes to the node's SDO server, its answer to
/// `handle()`, until that says done or failed. Only on request of a person: nothing in the driver begins one by itself.
///
/// What NORD's manuals say of it:
///  - Gateway SK CU4/TU4-CAO (BU 0260 p. 50): both objects are there, with sub-index 1. Stored are the settings of the
///    module's communication, its COB-IDs among them: after a change of the node id by DIP switch those that were
///    stored stay in force until 1011h. Parameters of the inverters are not: these have an EEPROM of their own (P560).
///  - Technology units SK TU1/2/3-CAO and the CAN port of the inverter (BU 0060): the objects are not listed; a node
///    without them answers 0602 0000h, which is told in words.
/// What is restored counts from the next reset of the node on (CiA 301).
class StoreCommand {
 public:
  /// `sub_index`: 1 all settings; a device may know further ones (2 communication, 3 application; CiA 301).
  explicit StoreCommand(StoreAction action, std::uint8_t sub_index = 1) noexcept
      : action_(action), sub_index_(sub_index) {}

  SdoRequest request() const noexcept;
  /// `answer`: to `request()`, time-outs included.
  Progress handle(const SdoAnswer& answer) noexcept;
  /// Why it failed, a clause without subject.
  const Sentence& reason() const noexcept { return reason_; }

 private:
  std::uint16_t index() const noexcept;
  Progress fail(const SdoAnswer& answer) noexcept;
  Progress handleAbility(const SdoAnswer& answer) noexcept;

  StoreAction action_;
  std::uint8_t sub_index_;
  bool commanding_ = false;  // it can, and is commanded now
  Sentence reason_;
};

}  // namespace nord_driver::canopen
