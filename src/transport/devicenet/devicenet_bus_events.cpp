#include "transport/devicenet/devicenet_bus_events.h"

namespace nord_driver {

void takeEvent(const devicenet::DevicenetEvent& event, unsigned mac, CanBusEvents& events) noexcept {
  using Kind = devicenet::DevicenetEventKind;
  Sentence text;
  if (event.node == devicenet::kNoNode) {
    text = event.text;
  } else if (event.kind == Kind::kHeartbeat || event.kind == Kind::kShutdown || event.kind == Kind::kDoubleMac ||
             event.kind == Kind::kMalformed) {
    text.format("MAC id %u: %.220s", mac, event.text.c_str());
  } else {
    return;
  }
  if (event.kind == Kind::kOnline) return events.inform(text);
  events.warn(text, event.at, event.kind == Kind::kSecondScanner || event.kind == Kind::kDoubleMac);
}

}  // namespace nord_driver
