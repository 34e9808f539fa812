// Which process has a device, as far as the kernel tells it.
#pragma once

#include <optional>

#include "nord_driver/core/fixed_text.h"

namespace nord_driver::link {

using ProgramName = FixedText<60>;

struct LockOwner {
  int process = 0;   ///< its id
  ProgramName name;  ///< of its program, without folders; empty where it is not known
};

/// The program of a process, without folders; empty when there is none of this id.
ProgramName programOf(int process) noexcept;

/// Who holds a lock (flock) on the file or device at `path`, which every program of this package takes on a serial
/// device. Nothing when nobody does, there is no such file, or the kernel does not tell.
std::optional<LockOwner> lockOwner(const char* path) noexcept;

/// "nord_driver_node (process 4242)".
Sentence toText(const LockOwner& owner) noexcept;

}  // namespace nord_driver::link
