// The part of the bus cycle that hands targets to the drives that position.
#include <algorithm>

#include "cycle/bus_cycle.h"

namespace nord_driver::cycle {

namespace {

// Longer than that after it was chosen nobody expects the axis to start; but a slow cycle needs some of its own for the
// answer.
constexpr Duration kElementPatience = std::chrono::seconds{2};
constexpr int kElementCycles = 10;

}  // namespace

// One that came while it could not be followed is not kept for later; and what was asked for before is over.
void BusCycle::commandPosition(DriveIndex drive, Instant now) noexcept {
  Axis& axis = axes_[drive];
  drive::Drive& to = drives_[drive];
  while (const auto asked = axis.targets.poll(ports_.newestPosition(drive))) {
    ElementReader& elements = axis.parameters.elements();
    // The one that is read already: begun anew with each choice, the reading of one chosen all the time would never end.
    if (asked->kind == AskedPosition::Kind::kElement && elements.isAsked() && elements.asked() == asked->element)
      continue;
    elements.forget();
    switch (asked->kind) {
      case AskedPosition::Kind::kTarget:
        tellTarget(drive, *asked, to.setPosition(asked->value), now);
        break;
      case AskedPosition::Kind::kIncrement:
        tellTarget(drive, *asked, to.movePosition(asked->value), now);
        break;
      case AskedPosition::Kind::kElement:
        chooseElement(drive, asked->element, now);
        break;
    }
  }
  if (axis.parameters.elements().isAsked()) awaitElement(drive, now);
}

void BusCycle::tellTarget(DriveIndex drive, const AskedPosition& asked, drive::TargetRefusal refusal,
                          Instant now) noexcept {
  const double at = drives_[drive].report().position.refused_target;
  const auto told = axes_[drive].targets.handleAnswer(names_[drive].c_str(), asked, refusal, at, now);
  if (told) ports_.tell({true, *told});
}

void BusCycle::refuseElement(DriveIndex drive, std::uint8_t element, const Sentence& why, Instant now) noexcept {
  Sentence text;
  text.format("%s; element %u of its array is not taken", why.c_str(), unsigned{element});
  const auto told = axes_[drive].targets.refuse(text, now);
  if (told) ports_.tell({true, *told});
}

// Where it is, the drive is asked first; what is refused anyway is refused before that.
void BusCycle::chooseElement(DriveIndex drive, std::uint8_t element, Instant now) noexcept {
  Axis& axis = axes_[drive];
  const drive::DriveReport& report = drives_[drive].report();
  const char* const name = names_[drive].c_str();
  Sentence refusal;
  if (report.phase != drive::Phase::kEnabled) {
    refusal.format("drive %s: %s", name, drive::toString(drive::TargetRefusal::kNotEnabled));
  } else if (report.position.homing) {
    refusal.format("drive %s: %s", name, drive::toString(drive::TargetRefusal::kHoming));
  } else {
    refusal = axis.bits.elementRefusal(name, element, axis.parameters.device(), report.commanded_set);
  }
  if (!refusal.empty()) return refuseElement(drive, element, refusal, now);
  axis.parameters.askElement(element);
  axis.element_until = now + std::max(kElementPatience, kElementCycles * period_);
}

// A stop meanwhile has taken the target away, as any other.
void BusCycle::awaitElement(DriveIndex drive, Instant now) noexcept {
  Axis& axis = axes_[drive];
  ElementReader& elements = axis.parameters.elements();
  const std::uint8_t element = elements.asked();
  Sentence refusal;
  if (drives_[drive].report().phase != drive::Phase::kEnabled) {
    refusal.format("drive %s was stopped before P613[-%02u] was read", names_[drive].c_str(), unsigned{element});
  } else if (const auto read = elements.poll()) {
    if (!read->known) return refuseElement(drive, element, read->why, now);
    const AskedPosition asked{AskedPosition::Kind::kElement, axis.bits.inJoint(read->raw), element, read->raw};
    return tellTarget(drive, asked, drives_[drive].setElement(element, asked.value), now);
  }
  if (refusal.empty() && now >= axis.element_until) {
    refusal.format("drive %s: P613[-%02u] was not read in time", names_[drive].c_str(), unsigned{element});
  }
  if (refusal.empty()) return;
  elements.forget();
  refuseElement(drive, element, refusal, now);
}

}  // namespace nord_driver::cycle
