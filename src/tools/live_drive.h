// One drive while a node works with it: what the node tells of it, as it comes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nord_driver/profile/process_data.h"
#include "tools/scope_record.h"

namespace nord_driver::tools {

struct LiveStatus {
  bool online = false;
  profile::ProcessOutput output;   ///< as sent last
  profile::ProcessInput input;     ///< as received last
  double frequency = 0.0;          ///< Hz
  std::uint16_t fault_number = 0;  ///< as P700 gives it; 0: none, 65535: not known
  std::string fault_text{};        ///< may be empty
};

class StatusFeed {
 public:
  virtual ~StatusFeed() = default;

  /// The newest. Waits for the first one. Throws Trouble when the node has ended, or tells nothing.
  virtual LiveStatus newest() = 0;

 protected:
  StatusFeed() = default;
  StatusFeed(const StatusFeed&) = default;
  StatusFeed& operator=(const StatusFeed&) = default;
};

struct LiveCycle {
  std::uint64_t number = 0;  ///< of the bus cycle, counted by the node
  ScopeSample sample;
};

class CycleFeed {
 public:
  virtual ~CycleFeed() = default;

  /// What has come since the last call, in its order; waits a moment when nothing has. Throws as newest().
  virtual std::vector<LiveCycle> take() = 0;

 protected:
  CycleFeed() = default;
  CycleFeed(const CycleFeed&) = default;
  CycleFeed& operator=(const CycleFeed&) = default;
};

}  // namespace nord_driver::tools
