// Station 1 on the simulator's pty: a master of a few lines, talking to station 8 in real time.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace nord_driver::sim_node {

class BusClient {
 public:
  /// Throws std::runtime_error when the link cannot be opened.
  explicit BusClient(const std::string& device);
  ~BusClient();
  BusClient(const BusClient&) = delete;
  BusClient& operator=(const BusClient&) = delete;

  /// The answer in hexadecimal; "" when none came within the limit.
  std::string ask(const std::vector<std::uint8_t>& telegram,
                  std::chrono::milliseconds limit = std::chrono::milliseconds{5000});
  /// FDL status: "is there a station?"
  std::string askStatus(std::chrono::milliseconds limit = std::chrono::milliseconds{5000});
  /// Slave_Diag, Set_Prm without a watchdog, Chk_Cfg: the drive keeps what it was told last.
  void startUp();
  /// Data_Exchange with PPO 1; parameter channel and process data of the answer.
  std::string exchange(const std::string& pkw, const std::string& pzd);
  /// The process data of the answer alone.
  std::string pzd(const std::string& words);
  /// Repeats `words` until the drive answers `expected`, for at most ten seconds; the last answer.
  std::string pzdUntil(const std::string& words, const std::string& expected);

 private:
  unsigned frameCount();

  int file_ = -1;
  bool first_ = true;
  bool fcb_ = false;
};

}  // namespace nord_driver::sim_node
