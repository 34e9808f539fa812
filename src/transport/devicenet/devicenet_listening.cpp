#include "transport/devicenet/devicenet_listening.h"

#include "devicenet/identifier.h"

namespace nord_driver {

using devicenet::Group1;
using devicenet::Group2;

const ListenRules kDevicenetListening{showsScanner, "another scanner has the bus: nothing is sent beside it",
                                      "it is listened for other scanners before anything is sent",
                                      "another scanner: end it"};

bool showsScanner(const CanFrame& frame) noexcept {
  const auto id = devicenet::readIdentifier(frame.id);
  if (frame.extended || frame.remote || !id) return false;
  if (id->group == 1) return id->message >= static_cast<std::uint8_t>(Group1::kMulticastPollResponse);
  if (id->group != 2) return false;
  // A slave's explicit response is also its heartbeat, which nobody need have asked for.
  const auto message = static_cast<Group2>(id->message);
  return message != Group2::kDuplicateMac && message != Group2::kSlaveExplicit;
}

}  // namespace nord_driver
