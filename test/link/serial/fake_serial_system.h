// A kernel with one UART, made of plain fields: what an adapter can do, what it hears, how it fails.
#pragma once

#include <errno.h>

#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "link/serial/serial_system.h"

namespace nord_driver::link {

class FakeSerialSystem final : public SerialSystem {
 public:
  using Bytes = std::vector<std::uint8_t>;

  // The world: paths of devices and where links lead.
  std::map<std::string, DeviceKind> devices{{"/dev/ttyUSB0", DeviceKind::kSerial}};
  std::map<std::string, std::string> links;
  std::map<std::string, std::string> serial_links;  ///< device -> its link, of adapters with a serial number
  std::map<std::string, int> latency_timers;        ///< ms

  // What the UART makes of what it is told.
  std::uint32_t real_rate = 0;  ///< 0: the wanted one
  bool has_parity = true;
  bool has_eight_bits = true;
  bool has_low_latency = true;
  int set_line_error = 0;
  int lock_error = 0;
  std::string lock_owner;
  int rs485_error = 0;
  Rs485Settings rs485_mask{true, true, true, true, 100, 100};  ///< what it can take at most
  int counters_error = 0;
  RawLineCounters counters;

  // The line. An element of `incoming` is what one read brings; `read_errors` come first.
  std::deque<Bytes> incoming;
  int open_error = 0;  ///< of a device that is there
  std::deque<int> read_errors;
  std::deque<int> poll_errors;
  std::deque<long> write_results;  ///< instead of taking everything
  bool hung_up = false;
  bool echoes = false;

  // What was done.
  std::vector<std::string> opened;
  std::vector<Bytes> written;
  int open_descriptors = 0;
  int output_flushes = 0;
  int low_latency_requests = 0;
  int rs485_requests = 0;
  Rs485Settings rs485;
  BaudRate rate{1};
  mutable Instant time{};

  int open(const char* path) noexcept override {
    DevicePath target;
    if (resolve(path, target) != 0) return -ENOENT;
    if (open_error != 0) return -open_error;
    opened.push_back(target.c_str());
    kind_ = devices.at(target.c_str());
    ++open_descriptors;
    return 7;
  }
  void close(int) noexcept override { --open_descriptors; }
  DeviceKind kind(int) noexcept override { return kind_; }
  int lock(int) noexcept override { return -lock_error; }

  int setLine(int, BaudRate wanted) noexcept override {
    rate = wanted;
    return -set_line_error;
  }
  int readLine(int, LineState& state) noexcept override {
    state.output_rate = state.input_rate = real_rate != 0 ? real_rate : rate.bitsPerSecond();
    state.even_parity = has_parity;
    state.eight_data_bits = has_eight_bits;
    state.one_stop_bit = true;
    return 0;
  }
  int setRs485(int, const Rs485Settings& settings) noexcept override {
    ++rs485_requests;
    rs485 = settings;
    return -rs485_error;
  }
  int readRs485(int, Rs485Settings& settings) noexcept override {
    settings.enabled = rs485.enabled && rs485_mask.enabled;
    settings.rts_on_send = rs485.rts_on_send && rs485_mask.rts_on_send;
    settings.rts_after_send = rs485.rts_after_send && rs485_mask.rts_after_send;
    settings.rx_during_tx = rs485.rx_during_tx && rs485_mask.rx_during_tx;
    settings.delay_before_ms = std::min(rs485.delay_before_ms, rs485_mask.delay_before_ms);
    settings.delay_after_ms = std::min(rs485.delay_after_ms, rs485_mask.delay_after_ms);
    return 0;
  }
  int requestLowLatency(int) noexcept override {
    ++low_latency_requests;
    return has_low_latency ? 0 : -ENOTTY;
  }
  int readCounters(int, RawLineCounters& to) noexcept override {
    to = counters;
    return -counters_error;
  }
  int flushInput(int) noexcept override {
    incoming.clear();
    return 0;
  }
  int flushOutput(int) noexcept override {
    ++output_flushes;
    return open_descriptors > 0 ? 0 : -EBADF;
  }

  long read(int, std::uint8_t* buffer, std::size_t capacity) noexcept override {
    if (!read_errors.empty()) return -takeFirst(read_errors);
    if (incoming.empty()) return hung_up ? 0 : -EAGAIN;
    Bytes& chunk = incoming.front();
    const std::size_t count = std::min(capacity, chunk.size());
    std::copy_n(chunk.begin(), count, buffer);
    chunk.erase(chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
    if (chunk.empty()) incoming.pop_front();
    return static_cast<long>(count);
  }
  long write(int, ByteView bytes) noexcept override {
    if (!write_results.empty()) return takeFirst(write_results);
    written.emplace_back(bytes.begin(), bytes.end());
    if (echoes) incoming.push_back(written.back());
    return static_cast<long>(bytes.size());
  }
  /// Time passes only here: to the deadline, when nothing is there.
  PollResult poll(int, Duration timeout) noexcept override {
    PollResult result;
    if (!poll_errors.empty()) {
      result.error = takeFirst(poll_errors);
      return result;
    }
    result.readable = !incoming.empty() || !read_errors.empty();
    result.hung_up = hung_up;
    if (!result.readable && !hung_up) time += timeout;
    return result;
  }
  Instant now() const noexcept override { return time; }
  void sleepUntil(Instant when) noexcept override { time = std::max(time, when); }

  int resolve(const char* path, DevicePath& target) noexcept override {
    const auto link = links.find(path);
    const std::string device = link != links.end() ? link->second : path;
    if (devices.count(device) == 0) return -ENOENT;
    target.format("%s", device.c_str());
    return 0;
  }
  int adapterLink(const char* device, DevicePath& link) noexcept override {
    const auto at = serial_links.find(device);
    if (at == serial_links.end()) return -ENOENT;
    link.format("%s", at->second.c_str());
    return 0;
  }
  int latencyTimer(const char* device) noexcept override {
    const auto at = latency_timers.find(device);
    return at != latency_timers.end() ? at->second : -ENOENT;
  }
  Sentence lockOwner(const char*) noexcept override { return lock_owner.c_str(); }

  /// An adapter with a serial number is plugged in: device, and udev's link.
  void plugIn(const std::string& device, const std::string& link) {
    devices[device] = DeviceKind::kSerial;
    links[link] = device;
    serial_links[device] = link;
    hung_up = false;
  }
  void unplug(const std::string& device) {
    devices.erase(device);
    links.erase(serial_links[device]);
    serial_links.erase(device);
    hung_up = true;
  }

 private:
  template <typename T>
  static T takeFirst(std::deque<T>& list) {
    const T first = list.front();
    list.pop_front();
    return first;
  }

  DeviceKind kind_ = DeviceKind::kSerial;
};

}  // namespace nord_driver::link
