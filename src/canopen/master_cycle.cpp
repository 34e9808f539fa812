// What a CANopen master sends by cycles: RPDOs and SYNC, and what becomes of those that found no place.
#include <algorithm>

#include "canopen/master.h"

namespace nord_driver::canopen {

void Master::releaseAll(Instant now) noexcept {
  now_ = now;
  process_.clear();
  stuck_ = false;
  for (const auto& node : nodes_) {
    node->release(now);
    touched(*node);
  }
  addLastWords();
}

// A node that is left as it was found, driven: what stops it once more, whatever has gone out before.
void Master::addLastWords() noexcept {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i]->status().stops_first || !nodes_[i]->status().fellSilent()) continue;
    const std::vector<ReceivePdoSlot>& pdos = nodes_[i]->receivePdos();
    for (std::size_t pdo = 0; pdo < pdos.size(); ++pdo) {
      if (!pdos[pdo].ready()) continue;
      process_.add({static_cast<std::uint8_t>(i), static_cast<std::uint16_t>(pdo), true});
      if (config_.sync_cob_id) process_.addSync();
    }
  }
}

bool Master::released() const noexcept {
  return !process_.hasPdo() && !process_.syncDue() &&
         std::all_of(nodes_.begin(), nodes_.end(), [](const auto& node) { return node->released(); });
}

void Master::startCycle(Instant now) noexcept {
  now_ = now;
  ++counters_.cycles;
  dropProcessData();
  stuck_ = false;
  bool any = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i]->handleCycle();
    const bool unheard = nodes_[i]->status().fellSilent();
    // SYNC is what a synchronous TPDO waits for, and an RPDO that stops a drive that is not heard.
    any = any || nodes_[i]->operational() || unheard;
    const bool heard = nodes_[i]->operational() && nodes_[i]->takesReceivePdos(now);
    std::vector<ReceivePdoSlot>& pdos = nodes_[i]->receivePdos();
    for (std::size_t pdo = 0; pdo < pdos.size(); ++pdo) {
      const bool takes = pdos[pdo].takeTellUnheard() && unheard;
      if (!pdos[pdo].ready() || (!heard && !takes)) continue;
      process_.add({static_cast<std::uint8_t>(i), static_cast<std::uint16_t>(pdo), unheard});
    }
  }
  if (waits_) process_.beginWith(*waits_);
  waits_.reset();
  if (any && config_.sync_cob_id) process_.addSync();
}

void Master::dropProcessData() noexcept {
  while (process_.hasPdo()) drop(process_.takePdo());
  if (process_.syncDue()) dropSync();
  process_.clear();
}

void Master::drop(PdoReference pdo) noexcept {
  ++counters_.superseded;
  ++nodes_[pdo.node]->report().status().counters.superseded;
  if (pdo.unheard) nodes_[pdo.node]->handleUntold();
  stuck_ = true;
  if (!waits_) waits_ = pdo;
}

void Master::dropSync() noexcept {
  ++counters_.superseded;
  stuck_ = true;
}

bool Master::pollReceivePdo() noexcept {
  while (process_.hasPdo()) {
    const PdoReference due = process_.takePdo();
    Node& node = *nodes_[due.node];
    const ReceivePdoSlot& slot = node.receivePdos()[due.pdo];
    // It may have been lost since the cycle began, or be back.
    if (!(due.unheard ? node.status().fellSilent() : node.operational()) || !slot.ready()) continue;
    ++node.report().status().counters.receive_pdos;
    give(Given::Kind::kReceivePdo, due.node, due.pdo, slot.frame());
    given_.unheard = due.unheard;
    return true;
  }
  return false;
}

bool Master::pollSync() noexcept {
  if (!process_.takeSync()) return false;
  ++counters_.syncs;
  give(Given::Kind::kSync, 0, 0, dataFrame(*config_.sync_cob_id, ByteView{}));
  return true;
}

}  // namespace nord_driver::canopen
