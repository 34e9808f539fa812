// The CAN bus between processes itself: whoever owns it hears every frame and brings it to all members.
#pragma once

#include <array>
#include <cstdint>

#include "link/can/virtual_can_end.h"

namespace nord_driver::link {

/// To its owner (the simulator) a CAN link like any other. Frames move between the members only while the owner calls
/// receive() or waitReadable(): what waits meanwhile is kept by the kernel. A member that does not read loses frames,
/// as a SocketCAN socket that is not read does; one that has lost kLostToDisconnect in a row is disconnected.
class VirtualCanHub final : public VirtualCanEnd {
 public:
  static constexpr std::size_t kMostMembers = 16;
  static constexpr std::uint32_t kLostToDisconnect = 1000;

  struct Counters {
    std::uint64_t joined = 0;
    std::uint64_t left = 0;
    std::uint64_t refused = 0;    ///< more than kMostMembers
    std::uint64_t stuck = 0;      ///< disconnected: did not read
    std::uint64_t malformed = 0;  ///< disconnected: sent what is no frame
    std::uint64_t lost = 0;       ///< frames a member had no room for
  };

  explicit VirtualCanHub(const CanSettings& settings);
  ~VirtualCanHub() override;

  /// Makes the bus. False when there is one of this name already.
  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return listener_ >= 0; }
  /// To every member.
  CanSend send(const CanFrame& frame) noexcept override;
  bool waitReadable(Instant until) noexcept override;
  CanCounters counters() const noexcept override;

  std::size_t members() const noexcept;
  const Counters& hubCounters() const noexcept { return hub_counters_; }

 private:
  struct Member {
    int descriptor = -1;
    std::uint16_t next_number = 0;
    std::uint32_t lost_in_a_row = 0;
  };

  void takeNewMembers() noexcept;
  void join(int descriptor) noexcept;
  void disconnect(Member& member, std::uint64_t& reason) noexcept;
  void deliver(const CanFrame& frame, const Member* sender) noexcept;
  void deliverTo(Member& member, const CanFrame& frame) noexcept;
  bool takeFrom(Member& member, CanFrame& frame) noexcept;
  bool takeNext(ReceivedCanFrame& received) noexcept override;

  int listener_ = -1;
  std::array<Member, kMostMembers> members_;
  std::size_t turn_ = 0;  // whose frames are taken next, so that nobody starves
  Counters hub_counters_;
};

}  // namespace nord_driver::link
