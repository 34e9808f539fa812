// The far end of a scanner, written from BU 0280 and from the rules of the predefined master/slave connection set: a
// Group-2-only server that lets itself be allocated, answers explicit messages 8/8, exchanges process data, times out,
// and notes what a scanner must not do. It uses no encoder of the scanner.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

class FakeDevice {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Address = std::tuple<unsigned, unsigned, unsigned>;  // class, instance, attribute

  explicit FakeDevice(std::uint8_t mac);

  // What it is.
  std::uint8_t mac;
  std::uint16_t vendor = 389, type = 2, product = 7;
  std::size_t produced = 5, consumed = 5;
  unsigned rate_step = 10;   ///< ms: rounds the expected packet rate up to such steps
  Duration timeout_step{};   ///< it notices its time-out so much later
  bool answers_rate = true;  ///< to the write itself
  bool keeps_rate = false;   ///< of process data that run
  bool tells_sizes = true;
  bool tells_owner = true;   ///< on the unconnected port
  bool tells_choice = true;  ///< beside its owner; else that nothing is allocated
  bool strict_about_sizes = true;
  bool obeys_anybody = false;  ///< a release, whoever's it is
  /// Change of state and cyclic: our data are consumed by connection object 2, and 4 consumes acknowledges alone (Eaton
  /// DX-NET-DEVICENET table 10, INFICON Composer Elite tables 5-7 and 5-9); else 4 does both (Rockwell 193-UM006A).
  bool consumes_at_2 = true;
  std::size_t acknowledge_size = 0;     ///< what 4 then says that it consumes; at Eaton 8
  std::map<Address, Bytes> attributes;  ///< beside identity and connections
  std::uint8_t error = 0x14;            ///< to a question for an attribute it does not have
  // What goes wrong.
  bool powered = true;
  bool deaf_to_explicit = false;
  bool deaf_to_io = false;
  bool unheard = false;            ///< it hears, and nothing it says arrives
  bool mute_acknowledges = false;  ///< of fragments and of change of state

  // What happened.
  std::uint8_t held = 0;  ///< allocation choice
  std::uint8_t master = 0xFF;
  bool established = false;
  bool timed_out = false;
  Bytes output;
  Bytes input;
  std::size_t outputs = 0, polls = 0, produced_count = 0, repeated_productions = 0;
  std::size_t explicit_requests = 0, explicit_deaths = 0, io_deaths = 0, io_before_explicit = 0;
  std::uint8_t allocated_last = 0, released_last = 0;
  unsigned rate = 0, explicit_rate = 2500;
  std::vector<std::string> violations;

  /// Was allocated before, by whom.
  void belongsTo(std::uint8_t whom, std::uint8_t choice, Instant now);
  /// And was polled just now, for the last time: it goes on with what it was told until its time-out has run out.
  void wasPolledBy(std::uint8_t whom, unsigned packet_rate, Instant now);
  void powerOff();
  void powerOn();
  void receive(const CanFrame& frame, Instant now);
  void tick(Instant now);
  bool next(CanFrame& frame);
  /// Something to send as it is.
  void say(const CanFrame& frame) { out_.push_back(frame); }
  void sendFragmented(const Bytes& body, bool xid);

 private:
  void unconnected(const CanFrame& frame, Instant now);
  void explicitRequest(const CanFrame& frame, Instant now);
  void answer(const Bytes& body, bool xid, Instant now);
  Bytes serve(const Bytes& body);
  Bytes getAttribute(const Address& address) const;
  Bytes setAttribute(const Address& address, const Bytes& data);
  void ioCommand(const CanFrame& frame, Instant now);
  void takeOutput(Instant now);
  void produce(unsigned message);
  void fragments(std::uint32_t id, const Bytes& message);
  void nextAnswerFragment(Instant now);
  void put(std::uint32_t id, const Bytes& bytes);
  void violation(const std::string& what) { violations.push_back("MAC " + std::to_string(mac) + ": " + what); }
  bool byChange() const { return (held & 0x30) != 0; }
  /// There is this connection object for process data.
  bool has(unsigned instance) const {
    const unsigned second = 0x02u | (consumes_at_2 ? 0x30u : 0u);
    return (held & (instance == 2 ? second : instance == 3 ? 0x04u : instance == 4 ? 0x30u : 0u)) != 0;
  }
  unsigned producedBy(unsigned instance) const;
  unsigned consumedBy(unsigned instance) const;

  std::deque<CanFrame> out_;
  Instant now_{};
  Instant explicit_at_{}, io_at_{}, strobe_at_{}, produced_at_{}, answer_at_{};
  std::array<bool, 5> rated_{};  // by instance: it has its expected packet rate
  Bytes request_;                // fragments of a request
  int request_count_ = -1;
  Bytes answer_;  // fragmented answer under way
  std::size_t answer_offset_ = 0;
  unsigned answer_count_ = 0, answer_tries_ = 0;
  bool answer_xid_ = false;
  Bytes io_;  // fragments of an output
  int io_count_ = -1;
  Bytes last_produced_;
  bool acknowledge_awaited_ = false, repeated_ = false;
};

}  // namespace nord_driver::devicenet
