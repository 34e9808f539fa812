// The referee of a DeviceNet bus: counts what a scanner must not do.
//
// It judges by the frames alone and by what the scanner can know: a module that let go of a connection by itself is no
// mistake of the scanner, polling on after it was told is.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/time.h"
#include "sim/devicenet/dn_identifiers.h"
#include "sim/rule_counts.h"

namespace nord_driver::sim {

enum class DnRule : std::uint8_t {
  kExtendedFrame,
  kRemoteFrame,
  kIdOfANode,
  kUnknownId,
  kDuplicateMacLength,
  kBeforeDuplicateCheck,
  kDuplicateMacUnanswered,
  kSecondMaster,
  kHeaderMac,
  kUnconnectedService,
  kChoice,
  kAllocateWithoutExplicit,
  kReleaseChoice,
  kExplicitBeforeAllocation,
  kExplicitLength,
  kExplicitWhilePending,
  kFragmentOrder,
  kFragmentUnacknowledged,
  kIoBeforeAllocation,
  kIoBeforePacketRate,
  kIoSizesUnread,
  kIoSize,
  kIoFragments,
  kIoAfterTimeout,
  kNoPacketRate,
  kStrobeLength,
  kStrobeBit,
  kAcknowledgeUnasked,
  kChangeUnacknowledged,
  kZeroControlWord,
  kCount,
};

/// One sentence on the rule.
const char* toString(DnRule rule) noexcept;

class DnReferee : public RuleCounts<DnRule> {
 public:
  /// I/O messages that may still follow what ends a connection: they were on their way.
  static constexpr unsigned kTolerance = 3;

  void nodeExists(std::uint8_t mac) noexcept { views_[mac].exists = true; }
  /// The time of what is told next.
  void advance(Instant now) noexcept;
  /// The scanner's next frame was given to its interface then, not now.
  void givenAt(Instant when) noexcept { given_ = when; }
  /// A frame of the scanner, whether it reached anybody or not.
  void masterFrame(const CanFrame& frame) noexcept;
  /// A frame of a node that reached the scanner.
  void delivered(const CanFrame& frame) noexcept;
  /// A frame of somebody who is neither.
  void foreignFrame(const CanFrame& frame) noexcept;
  /// Simulator or bus stood still: what is late is nobody's mistake.
  void stoodStill() noexcept;

  std::optional<std::uint8_t> master() const noexcept { return master_; }

 private:
  /// One I/O connection as the scanner knows it.
  struct Io {
    std::uint16_t packet_rate = 0;  ///< ms, as answered
    bool running = false;           ///< the packet rate was answered
    bool told = false;              ///< the module has answered that there is such a connection object
    std::optional<std::uint16_t> produced, consumed;
    std::optional<Instant> last;
    std::uint8_t next_fragment = 0;
    std::size_t collected = 0;
  };
  struct Request {
    std::uint8_t service = 0, class_id = 0, instance = 0, attribute = 0;
    std::uint16_t value = 0;
    bool unconnected = false;
  };
  /// What the scanner can know of a node.
  struct View {
    bool exists = false;
    bool refused = false;     ///< an allocation was: it may still have one of before
    std::uint8_t choice = 0;  ///< allocated
    unsigned on_their_way = 0;
    std::optional<Request> pending;
    Instant asked{};                                ///< given to the interface
    std::optional<std::uint8_t> sent_fragment;      ///< not acknowledged yet
    std::optional<std::uint8_t> received_fragment;  ///< to be acknowledged
    Instant fragment_due{};
    std::optional<Instant> change_due;
    std::array<Io, 3> io{};  ///< poll, strobe, change of state
  };

  void judgeMaster(const CanFrame& frame) noexcept;
  void duplicateMac(const CanFrame& frame) noexcept;
  void judgeOnline(const CanFrame& frame) noexcept;
  void unconnected(View& view, const CanFrame& frame) noexcept;
  void explicitMessage(View& view, const CanFrame& frame) noexcept;
  void io(View& view, const CanFrame& frame) noexcept;
  void ioMessage(Io& io, const Io& inputs, std::size_t size) noexcept;
  void strobe(const CanFrame& frame) noexcept;
  void answer(View& view, const CanFrame& frame) noexcept;
  void answered(View& view, const Request& request, ByteView data) noexcept;
  static void begin(View& view, std::uint8_t choice) noexcept;
  static void end(View& view, std::uint8_t choice) noexcept;
  static void clearIo(View& view, std::uint8_t choice) noexcept;

  std::array<View, dn::kMacs> views_{};
  Instant now_{};
  std::optional<Instant> given_;  ///< the frame that is judged next
  std::optional<std::uint8_t> master_;
  bool checked_ = false;       // there was a duplicate-MAC request of the master
  bool second_check_ = false;  // the last one came a second after the one before
  Instant last_check_{};
  bool online_ = false;
  std::optional<Instant> answer_due_;
};

}  // namespace nord_driver::sim
