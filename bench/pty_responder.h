// The stations at the far end of a pty, on a thread of their own.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "answers.h"
#include "core/baud_rate.h"

namespace nord_driver::bench {

class PtyResponder {
 public:
  PtyResponder(Answers answers, unsigned processor);
  ~PtyResponder();
  PtyResponder(const PtyResponder&) = delete;
  PtyResponder& operator=(const PtyResponder&) = delete;

  const std::string& path() const { return path_; }
  /// 0: answers at once. Else: after the time request, 11 bit times and answer take on a wire of that rate. The last of
  /// it is spent in a loop, not asleep, so that no lateness of its own is measured.
  void setWire(std::uint32_t bits_per_second) { wire_ = bits_per_second; }
  /// The last request that was answered, to be read while nothing is exchanged.
  const std::vector<std::uint8_t>& lastRequest() const { return last_request_; }
  std::size_t lastAnswerSize() const { return last_answer_size_; }

 private:
  void run();
  void answer(ByteView request, Instant arrived);

  Answers answers_;
  int far_ = -1;
  std::string path_;
  std::atomic<std::uint32_t> wire_{0};
  std::atomic<bool> stop_{false};
  std::vector<std::uint8_t> last_request_;
  std::size_t last_answer_size_ = 0;
  std::thread thread_;
};

}  // namespace nord_driver::bench
