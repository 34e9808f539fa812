// What is said of a node that is not operational, as clauses after its name.
#pragma once

#include "canopen/nmt.h"
#include "canopen/sdo_request.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::canopen {

Sentence doubleId() noexcept;
Sentence stoppedFirst() noexcept;
Sentence askedBySync() noexcept;
Sentence restarted() noexcept;
Sentence restartsAgainAndAgain() noexcept;
Sentence leftByItself(NmtState state) noexcept;
Sentence toldByAnother(NmtCommand command) noexcept;
Sentence stoppedAnswering(const SdoRequest& request) noexcept;
/// `lost_why`: what was said when it was lost; empty: nothing was.
Sentence doesNotAnswer(const Sentence& lost_why) noexcept;

}  // namespace nord_driver::canopen
