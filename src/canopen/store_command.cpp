#include "canopen/store_command.h"

#include "canopen/sdo_abort.h"

namespace nord_driver::canopen {

namespace {

constexpr std::uint16_t kStoreIndex = 0x1010, kRestoreIndex = 0x1011;
// Least significant byte first on the wire: 73 61 76 65 and 6C 6F 61 64.
constexpr std::uint32_t kSave = 0x65766173, kLoad = 0x64616F6C;
// What a device answers when it is asked.
constexpr std::uint32_t kOnCommand = 0x1, kByItself = 0x2;

}  // namespace

std::uint16_t StoreCommand::index() const noexcept {
  return action_ == StoreAction::kStore ? kStoreIndex : kRestoreIndex;
}

SdoRequest StoreCommand::request() const noexcept {
  if (!commanding_) return sdoRead(0, index(), sub_index_);
  return sdoWrite(0, index(), sub_index_, action_ == StoreAction::kStore ? kSave : kLoad, 4);
}

Progress StoreCommand::handle(const SdoAnswer& answer) noexcept {
  if (!answer.ok()) return fail(answer);
  return commanding_ ? Progress::kDone : handleAbility(answer);
}

// A device that does not say what it can do is asked to do it: it refuses by itself what it cannot.
Progress StoreCommand::handleAbility(const SdoAnswer& answer) noexcept {
  const std::uint32_t ability = numberOf(answer, 4).value_or(kOnCommand);
  commanding_ = (ability & kOnCommand) != 0;
  if (commanding_) return Progress::kGoOn;
  if (action_ == StoreAction::kRestore) {
    reason_.format("restores nothing on command (1011h:%u = %u)", unsigned{sub_index_}, unsigned{ability});
  } else if ((ability & kByItself) != 0) {
    reason_.format("stores its settings by itself, and not on command (1010h:%u = %u): there is nothing to do",
                   unsigned{sub_index_}, unsigned{ability});
  } else {
    reason_.format("stores nothing on command (1010h:%u = %u)", unsigned{sub_index_}, unsigned{ability});
  }
  return Progress::kFailed;
}

Progress StoreCommand::fail(const SdoAnswer& answer) noexcept {
  const bool store = action_ == StoreAction::kStore;
  const char* const verb = store ? "store" : "restore";
  if (answer.abort_code == sdo_abort::kNoObject) {
    reason_.format(
        "has no object %04Xh: it cannot %s its settings on command (BU 0260 names it of SK CU4/TU4-CAO only)",
        unsigned{index()}, verb);
  } else if (answer.abort_code == sdo_abort::kNoSubIndex) {
    reason_.format("has no sub-index %u of %04Xh: it cannot %s that part of its settings alone", unsigned{sub_index_},
                   unsigned{index()}, verb);
  } else {
    reason_ = refusalText(store ? "store parameters" : "restore default parameters", request(), answer);
  }
  return Progress::kFailed;
}

}  // namespace nord_driver::canopen
