// A CANopen node for tests, written from CiA 301 and BU 0060 with literal bytes, not from the engine's encoders. It
// also is a referee: what a master must not do is noted in `violations`.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

class ScriptedNode {
 public:
  struct Entry {
    std::uint32_t value = 0;
    std::uint8_t size = 4;
    bool read_only = false;
  };

  explicit ScriptedNode(std::uint8_t id);

  void powerOn(Instant now);
  void powerOff();
  void receive(const CanFrame& frame, Instant now);
  void tick(Instant now);
  /// The next frame that is due.
  bool next(Instant now, CanFrame& frame);
  void say(const std::string& candump, Instant at);
  Entry& object(std::uint16_t index, std::uint8_t sub) { return dictionary_[{index, sub}]; }
  void remove(std::uint16_t index, std::uint8_t sub) { dictionary_.erase({index, sub}); }

  std::uint8_t state = 0x7F;  // as heartbeat and guarding tell it
  bool powered = false;
  // How it behaves.
  Duration sdo_delay = std::chrono::milliseconds{1};
  Duration boot_time = std::chrono::milliseconds{20};
  bool sends_boot_up = true;
  bool refuses_start = false;
  bool hears_sdo = true;
  bool sends_heartbeat = true;
  bool answers_guarding = true;
  bool toggles = true;
  // What it saw.
  std::vector<std::string> writes;  // "1800:01=C00001B2"
  std::vector<std::string> received_pdos;
  std::vector<std::string> violations;
  int reads = 0;
  int resets = 0;
  int syncs = 0;
  int guards = 0;

 private:
  void handleNmt(std::uint8_t command, Instant now);
  void handleSdo(const CanFrame& frame, Instant now);
  void read(std::uint16_t index, std::uint8_t sub, Instant now);
  void write(std::uint16_t index, std::uint8_t sub, std::uint32_t value, std::uint8_t size, Instant now);
  void abort(std::uint16_t index, std::uint8_t sub, std::uint32_t code, Instant now);
  void judge(std::uint16_t index, std::uint8_t sub, std::uint32_t value);
  void handlePdo(const CanFrame& frame);
  void sendTransmitPdo(Instant at);

  using Key = std::pair<std::uint16_t, std::uint8_t>;
  std::uint8_t id_;
  std::map<Key, Entry> dictionary_;
  std::deque<std::pair<Instant, CanFrame>> out_;
  Instant next_heartbeat_{};
  std::uint8_t toggle_ = 0;
};

}  // namespace nord_driver::canopen
