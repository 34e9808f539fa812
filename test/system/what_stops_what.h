// "What stops what", held to its bounds in bus cycles of simulated time. Whoever simulates a bus instantiates it:
//
//     INSTANTIATE_TEST_SUITE_P(Profibus, WhatStopsWhat,
//                              ::testing::Combine(::testing::Values(bus), ::testing::ValuesIn(stopRows())),
//                              nameOfStop);
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <tuple>

#include "system/stop_rig.h"
#include "system/stop_rows.h"

namespace nord_driver::test {

class WhatStopsWhat : public ::testing::TestWithParam<std::tuple<StopBus, StopRow>> {
 public:
  static constexpr DriveIndex kLeft = 0, kRight = 1;

  StopRig& rig() { return *rig_; }
  DrivenRobot& robot() { return rig_->robot(); }
  void submit(cycle::RequestKind kind);
  /// From now on commands are no numbers.
  void commandNoNumbers() { no_numbers_ = true; }
  /// The driver is not run for longer than every time-out of the drives.
  void standStill();

 protected:
  void SetUp() override;

  const StopRow& row() const { return std::get<StopRow>(GetParam()); }
  Instant now() { return robot().transport().now(); }
  void step();
  /// Until the driver can know of the cause; it does not act before.
  void waitUntilKnown();
  void waitUntilItShows();
  Instant knownAt();
  /// As seen on the wire in the last cycle.
  bool reacted();
  void expectDown();
  void expectOneCycleDown();
  void expectDriveSideStop();
  void expectOnlyEnableMoves();
  void expectNothingMoves(Duration span);
  void expectMovesAgain();
  bool standsStill();
  bool allOnline();
  std::string words();

  std::unique_ptr<StopRig> rig_;
  Instant begun_{};         ///< of the cause
  Instant last_command_{};  ///< the last one that was a number
  Instant zeros_since_{};
  bool no_numbers_ = false;
  std::array<WireWords, StopRig::kDrives> before_{};  ///< of the cycle before, while it comes down
};

}  // namespace nord_driver::test
