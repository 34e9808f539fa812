// The end of the node, whatever goes on. Whoever simulates a bus instantiates it with a rig of "What stops what":
//
//     INSTANTIATE_TEST_SUITE_P(Profibus, NodeEnds,
//                              ::testing::Combine(::testing::Values(bus), ::testing::ValuesIn(endMoments())),
//                              nameOfEnd);
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "system/stop_rig.h"

namespace nord_driver::test {

/// What is going on when the node is asked to end. The robot drives before.
struct EndMoment {
  const char* name;
  void (*bring)(StopRig&);
  bool all_seen = true;  ///< every drive can be seen to rest
};

class NodeEnds : public ::testing::TestWithParam<std::tuple<StopBus, EndMoment>> {
 protected:
  void SetUp() override;

  std::unique_ptr<StopRig> rig_;
};

const std::vector<EndMoment>& endMoments();
void PrintTo(const EndMoment& moment, std::ostream* out);
std::string nameOfEnd(const ::testing::TestParamInfo<std::tuple<StopBus, EndMoment>>& info);

}  // namespace nord_driver::test
