#include "canopen/bus_watch.h"

namespace nord_driver::canopen {

void BusWatch::foreignNode(std::uint8_t id, Instant now) noexcept {
  ++counters_.foreign;
  if (!findings_.isNew(id)) return;
  Sentence text;
  text.format("node %u is on the bus, but is not configured", unsigned{id});
  findings_.tell(CanopenEventKind::kForeignNode, text, id, now);
}

BusWatch::Finding BusWatch::findingOf(CobIdUse::Kind kind) noexcept {
  switch (kind) {
    case CobIdUse::Kind::kNmt:
      return Finding::kSecondNmt;
    case CobIdUse::Kind::kReceivePdo:
      return Finding::kControlWord;
    default:
      return Finding::kSecondMaster;
  }
}

void BusWatch::secondMaster(const CanFrame& frame, CobIdUse::Kind kind, Instant now) noexcept {
  ++counters_.second_master;
  if (!findings_.mayTell(findingOf(kind), now)) return;
  Sentence text;
  if (kind == CobIdUse::Kind::kNmt) {
    FixedText<16> whom{"all nodes"};
    if (frame.data[1] != 0) whom.format("node %u", unsigned{frame.data[1]});
    text.format("another master sends NMT \"%s\" to %s", toText(static_cast<NmtCommand>(frame.data[0])), whom.c_str());
  } else {
    text.format("another master is on the bus: it sends %s (%03Xh), which only we should", toText(kind),
                static_cast<unsigned>(frame.id));
  }
  findings_.tell(CanopenEventKind::kSecondMaster, text, frame.id, now);
}

// Masters may share a bus as long as their nodes differ.
void BusWatch::foreignCommand(const CanFrame& frame, Instant now) noexcept {
  ++counters_.foreign;
  if (!findings_.mayTell(Finding::kForeignCommand, now)) return;
  Sentence text;
  text.format("another master sends NMT \"%s\" to node %u, which is not configured",
              toText(static_cast<NmtCommand>(frame.data[0])), unsigned{frame.data[1]});
  findings_.tell(CanopenEventKind::kForeignCommand, text, frame.id, now);
}

void BusWatch::ownIdUsed(const CanFrame& frame, Instant now) noexcept {
  ++counters_.own_id_used;
  if (!findings_.mayTell(Finding::kOwnIdUsed, now)) return;
  Sentence text;
  text.format("another node has our own node id %u", static_cast<unsigned>(frame.id - kErrorControlBase));
  findings_.tell(CanopenEventKind::kOwnIdUsed, text, frame.id - kErrorControlBase, now);
}

void BusWatch::malformedNmt(const CanFrame& frame, Instant now) noexcept {
  ++counters_.malformed;
  if (!findings_.mayTell(Finding::kMalformedNmt, now)) return;
  Sentence text;
  text.format("somebody sent a malformed NMT command (%u bytes%s)", unsigned{frame.size},
              frame.remote ? ", remote" : "");
  findings_.tell(CanopenEventKind::kMalformed, text, frame.id, now);
}

}  // namespace nord_driver::canopen
