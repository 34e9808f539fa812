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
  bool any = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i]->status().stops_first || !nodes_[i]->status().fellSilent()) continue;
    const std::vector<ReceivePdoSlot>& pdos = nodes_[i]->receivePdos();
    for (std::size_t pdo = 0; pdo < pdos.size(); ++pdo) {
      if (!pdos[pdo].ready()) continue;
      process_.add({static_cast<std::uint8_t>(i), static_cast<std::uint16_t>(pdo), true});
      any = true;
    }
  }
  if (any && config_.sync_cob_id) process_.add(kSyncOfCycle);
}

bool Master::released() const noexcept {
  return process_.empty() &&
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
  if (any && config_.sync_cob_id) process_.add(kSyncOfCycle);
  if (waits_) process_.beginWith(*waits_);
  waits_.reset();
}

void Master::dropProcessData() noexcept {
  while (!process_.empty()) drop(process_.take());
  process_.clear();
}

void Master::drop(ProcessFrame frame) noexcept {
  ++counters_.superseded;
  stuck_ = true;
  if (!waits_) waits_ = frame;
  if (frame.sync) return;
  ++nodes_[frame.node]->report().status().counters.superseded;
  if (frame.unheard) nodes_[frame.node]->handleUntold();
}

bool Master::pollProcessData() noexcept {
  while (!process_.empty()) {
    const ProcessFrame due = process_.take();
    if (due.sync ? giveSync() : giveReceivePdo(due)) return true;
  }
  return false;
}

bool Master::giveSync() noexcept {
  ++counters_.syncs;
  give(Given::Kind::kSync, 0, 0, dataFrame(*config_.sync_cob_id, ByteView{}));
  return true;
}

// It may have been lost since the cycle began, or be back.
bool Master::giveReceivePdo(ProcessFrame pdo) noexcept {
  Node& node = *nodes_[pdo.node];
  const ReceivePdoSlot& slot = node.receivePdos()[pdo.pdo];
  if (!(pdo.unheard ? node.status().fellSilent() : node.operational()) || !slot.ready()) return false;
  ++node.report().status().counters.receive_pdos;
  give(Given::Kind::kReceivePdo, pdo.node, pdo.pdo, slot.frame());
  given_.unheard = pdo.unheard;
  return true;
}

}  // namespace nord_driver::canopen
