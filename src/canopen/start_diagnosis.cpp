#include "canopen/start_diagnosis.h"

namespace nord_driver::canopen {

Sentence startRefusal(const StartDiagnosis& diagnosis, NmtState state, ErrorControlMode mode) noexcept {
  Sentence why;
  if (diagnosis.heard) {
    why.format("does not become operational after NMT start: it stays %s", toText(state));
  } else {
    why.format("was started, but is not heard by %s", mode == ErrorControlMode::kHeartbeat ? "heartbeat" : "guarding");
  }
  if (diagnosis.error_register) {
    const Sentence so_far = why;
    why.format("%s, error register %02Xh", so_far.c_str(), unsigned{*diagnosis.error_register});
  }
  if (diagnosis.last_error) {
    const Sentence so_far = why;
    why.format("%s, last error %04Xh", so_far.c_str(), unsigned{*diagnosis.last_error});
  }
  return why;
}

}  // namespace nord_driver::canopen
