// A directory of its own, two drives and a clock for the tests of traces.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "trace/trace_feed.h"
#include "trace/trace_writer.h"

namespace nord_driver::trace {

class TraceTest : public ::testing::Test {
 protected:
  TraceTest() {
    char name[] = "/tmp/nord_driver_trace_test.XXXXXX";
    directory_ = mkdtemp(name);
  }
  ~TraceTest() override { std::filesystem::remove_all(directory_); }

  static Instant at(int milliseconds) { return Instant{std::chrono::milliseconds{milliseconds}}; }
  /// Time 0 of the bus is 2023-11-14 22:13:20 UTC.
  static TraceClock clockAt(int milliseconds) {
    return {at(milliseconds), std::chrono::system_clock::time_point{std::chrono::seconds{1'700'000'000} +
                                                                    std::chrono::milliseconds{milliseconds}}};
  }
  static std::vector<TracedDrive> drives() { return {{"left", "PROFIBUS station 3"}, {"right", "PROFIBUS station 4"}}; }

  /// One cycle: both drives are sent 047F and setpoint `setpoint`; what they answer are `left` and `right` (0:
  /// nothing).
  void cycle(int milliseconds, Word left, Word right, std::int16_t setpoint = 0x2000) {
    std::vector<profile::ProcessOutput> outputs(2);
    std::vector<DriveExchange> inputs(2);
    snapshot_.time = at(milliseconds);
    for (std::size_t i = 0; i < 2; ++i) {
      const Word status = i == 0 ? left : right;
      outputs[i].control_word = 0x047F;
      outputs[i].setpoints[0] = setpoint;
      inputs[i].module_answers = inputs[i].inverter_answers = status != 0;
      inputs[i].input.status_word = status;
      inputs[i].input.actual_values[0] = status != 0 ? setpoint : std::int16_t{0};
      if (status == 0) continue;
      cycle::DriveSnapshot& drive = snapshot_.drives[i];
      const bool fault = profile::StatusWord{status}.fault();
      if (fault && !drive.fault) ++drive.faults;
      drive.fault = fault;
      drive.input = inputs[i].input;
    }
    feed_.handleCycle(outputs, inputs, snapshot_);
  }

  /// The names of the files that are there, in order.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{directory_}) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string read(const std::string& name) const {
    std::ifstream file{directory_ + "/" + name, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
  }

  std::string directory_;
  cycle::CycleSnapshot snapshot_{2};
  TraceFeed feed_{2};
};

}  // namespace nord_driver::trace
