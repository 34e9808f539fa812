// The CAN bus between processes itself: whoever owns it hears every frame and brings it to all members.
#pragma once

#include <array>
#include <string>

#include "link/can/can_id_filter.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"

namespace nord_driver::link {

/// To its owner (the simulator) a CAN link like any other. Frames move between the members only while the owner calls
/// receive() or waitReadable(): what waits meanwhile is kept by the kernel. A member that does not read loses frames,
/// as a SocketCAN socket that is not read does; one that has lost kLostToPartWith in a row is parted with.
class VirtualCanHub final : public CanLink {
 public:
  static constexpr std::size_t kMostMembers = 16;
  static constexpr std::uint32_t kLostToPartWith = 1000;

  struct Counters {
    std::uint64_t joined = 0;
    std::uint64_t left = 0;
    std::uint64_t refused = 0;    ///< more than kMostMembers
    std::uint64_t stuck = 0;      ///< parted with: did not read
    std::uint64_t malformed = 0;  ///< parted with: sent what is no frame
    std::uint64_t lost = 0;       ///< frames a member had no room for
  };

  explicit VirtualCanHub(const CanSettings& settings);
  ~VirtualCanHub() override;
  VirtualCanHub(const VirtualCanHub&) = delete;
  VirtualCanHub& operator=(const VirtualCanHub&) = delete;

  /// Makes the bus. False when there is one of this name already.
  bool open() noexcept override;
  void close() noexcept override;
  bool isOpen() const noexcept override { return listener_ >= 0; }
  /// To every member.
  CanSend send(const CanFrame& frame) noexcept override;
  bool receive(ReceivedCanFrame& received) noexcept override;
  bool waitReadable(Instant until) noexcept override;
  /// Nothing moves on the bus meanwhile.
  void sleepUntil(Instant when) noexcept override;
  Instant now() const noexcept override;
  CanState state() const noexcept override { return CanState::kUnknown; }
  CanCounters counters() const noexcept override;
  const std::string& lastError() const noexcept override { return error_; }
  const char* advice() const noexcept override { return ""; }

  std::size_t members() const noexcept;
  const Counters& hubCounters() const noexcept { return hub_counters_; }

 private:
  struct Member {
    int descriptor = -1;
    std::uint16_t next_number = 0;
    std::uint32_t lost_in_a_row = 0;
  };

  bool fail(const char* what, int error = 0) noexcept;
  void takeNewMembers() noexcept;
  void join(int descriptor) noexcept;
  void part(Member& member, std::uint64_t& reason) noexcept;
  void deliver(const CanFrame& frame, const Member* sender) noexcept;
  void deliverTo(Member& member, const CanFrame& frame) noexcept;
  bool takeFrom(Member& member, CanFrame& frame) noexcept;
  bool takeNext(ReceivedCanFrame& received) noexcept;

  CanSettings settings_;
  CanIdFilter filter_;
  Sentence problem_;  // with the settings
  std::string error_;
  int listener_ = -1;
  std::array<Member, kMostMembers> members_;
  std::size_t turn_ = 0;  // whose frames are taken next, so that nobody starves
  bool has_pending_ = false;
  ReceivedCanFrame pending_;
  Counters hub_counters_;
};

}  // namespace nord_driver::link
