// A recording of a CAN bus as tshark reads it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "nord_driver/trace/telegram_trace.h"
#include "trace/pcap.h"

namespace nord_driver::test {

inline bool isTsharkThere() {
  return std::system("tshark --version >/dev/null 2>&1") == 0;
}

/// The whole trace in a file, as long as this lives.
class Recording {
 public:
  explicit Recording(const TelegramTrace& trace) : path_("/tmp/nord_recording_" + std::to_string(getpid()) + ".pcap") {
    trace::Pcap pcap{trace.linkType()};
    for (const TraceRecord& record : trace.copy()) {
      pcap.add(std::chrono::floor<std::chrono::microseconds>(record.time.time_since_epoch()), record.view());
    }
    std::ofstream{path_, std::ios::binary} << pcap.bytes();
  }
  ~Recording() { std::remove(path_.c_str()); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// A line for each frame: protocol, complaints, what it is.
  std::vector<std::string> decodedBy(const std::string& dissector) const {
    const std::string command = "tshark -n -r " + path_ + " -d can.subdissector," + dissector +
                                " -T fields -e _ws.col.Protocol -e _ws.malformed -e _ws.expert.message"
                                " -e _ws.col.Info 2>/dev/null";
    std::vector<std::string> lines;
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return lines;
    char line[4096];
    while (std::fgets(line, sizeof line, pipe) != nullptr) {
      lines.emplace_back(line);
      lines.back().erase(lines.back().find_last_not_of('\n') + 1);
    }
    EXPECT_EQ(0, pclose(pipe)) << command;
    return lines;
  }

 private:
  std::string path_;
};

}  // namespace nord_driver::test
