// The far end of the benchmarks: what NORD modules with ident 7531h and PPO 1 answer, ready made, as fast as can be.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "profibus/slave_config.h"

namespace nord_driver::bench {

/// Stations `first` to `first + count - 1` on a segment with this master.
class Answers {
 public:
  Answers(std::uint8_t first, std::size_t count, std::uint8_t master = 1);

  /// What is answered to this telegram; empty: nothing.
  ByteView to(ByteView request);
  /// Bytes of the telegram that begins here; 0: not known yet.
  static std::size_t lengthOf(ByteView begun);

 private:
  struct Station {
    std::vector<std::uint8_t> here, wants_parameters, ready, inputs;
    bool configured = false;
  };
  std::uint8_t first_;
  std::vector<Station> stations_;
};

/// What the master is told of them.
std::vector<profibus::SlaveConfig> slaves(std::uint8_t first, std::size_t count);

}  // namespace nord_driver::bench
