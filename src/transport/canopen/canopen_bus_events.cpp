#include "transport/canopen/canopen_bus_events.h"

namespace nord_driver {

void takeEvent(const canopen::CanopenEvent& event, unsigned node_id, CanBusEvents& events) noexcept {
  using Kind = canopen::CanopenEventKind;
  // Of nodes of others, by their own master: that is as it should be.
  if (event.kind == Kind::kForeignCommand) return;
  Sentence text;
  if (event.node == canopen::kNoNode) {
    text = event.text;
  } else if (event.kind == Kind::kToggleError || event.kind == Kind::kBootUpRepeated || event.kind == Kind::kDoubleId ||
             event.kind == Kind::kMalformed || event.kind == Kind::kNodeRefused) {
    text.format("node %u: %s", node_id, event.text.c_str());
  } else {
    return;
  }
  // Two nodes with one id have been told, and are refused for it.
  if (event.kind == Kind::kNodeRefused) return events.mention(text, event.at);
  events.warn(text, event.at, event.kind == Kind::kSecondMaster || event.kind == Kind::kDoubleId);
}

}  // namespace nord_driver
