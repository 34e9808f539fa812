#include "canopen/compared_write.h"

#include "canopen/sdo_abort.h"

namespace nord_driver::canopen {

void ComparedWrite::begin(const char* what, const SetupWrite& entry, bool zero_may_miss) noexcept {
  what_ = what;
  entry_ = entry;
  zero_may_miss_ = zero_may_miss;
  writing_ = false;
  reason_.clear();
}

SdoRequest ComparedWrite::request() const noexcept {
  return writing_ ? sdoWrite(0, entry_.index, entry_.sub_index, entry_.value, entry_.size)
                  : sdoRead(0, entry_.index, entry_.sub_index);
}

Progress ComparedWrite::handle(const SdoAnswer& answer) noexcept {
  const bool missing = answer.abort_code == sdo_abort::kNoObject || answer.abort_code == sdo_abort::kNoSubIndex;
  if (!answer.ok() && missing && zero_may_miss_ && entry_.value == 0) return Progress::kDone;
  if (writing_) {
    if (answer.ok()) return Progress::kDone;
    reason_ = refusalText(what_, request(), answer);
    return Progress::kFailed;
  }
  if (answer.ok() && numberOf(answer, entry_.size) == entry_.value) return Progress::kDone;
  if (!answer.ok() && missing) {
    reason_ = refusalText(what_, request(), answer);
    return Progress::kFailed;
  }
  // What cannot be read may still be written.
  writing_ = true;
  return Progress::kGoOn;
}

}  // namespace nord_driver::canopen
