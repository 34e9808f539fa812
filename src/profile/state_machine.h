// The inverter's status machine as a table, numbered as in BU 2700 6.4.3: what a control word does in a state.
//
// The driver never predicts the inverter with it; it explains to people why a word leads nowhere.
#pragma once

#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "profile/status_word.h"

namespace nord_driver::profile {

struct Transition {
  std::uint8_t number;  ///< 1..15 of BU 2700 6.4.3
  DriveState from;      ///< kUnknown: from every state
  DriveState to;
  Word mask;            ///< the control word's bits that matter; 0: the transition happens by itself
  Word value;           ///< their values
  const char* command;  ///< the manual's name of the command
};

/// Rows of the table; 7 and 10 have two commands, and therefore two rows. Within a state the commands stand in the
/// order of their priority (BU 2700 6.4.1).
struct TransitionTable {
  const Transition* rows;
  std::size_t size;
  const Transition* begin() const noexcept { return rows; }
  const Transition* end() const noexcept { return rows + size; }
};
TransitionTable transitions() noexcept;

/// The transition `now` triggers in `state`, or nullptr when it triggers none (or has bit 10 = 0 and is ignored).
/// `before` is the control word of the telegram before: the acknowledgement, no. 15, is an edge.
const Transition* transitionFor(DriveState state, Word now, Word before) noexcept;

}  // namespace nord_driver::profile
