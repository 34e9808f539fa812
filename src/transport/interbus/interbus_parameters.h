// The parameters of all drives of a ring by Compact PCP, through the one pair of register blocks a gateway has for it.
//
// One access runs at a time, of whichever drive: its drive's connection is initiated where that has not been done, its
// service is written into the invoke block, and the result block is read until it confirms. Between two services the
// block is cleared and the result seen gone, so that no result is taken for that of another service.
//
// A service that an access has left unconfirmed is waited for where the gateway holds the connections, and what comes is
// dropped: its confirmation would be taken for that of the next one.
//
// Compact PCP has no write that spares the EEPROM: whether a write wears it is P560's to say. So a write to the RAM only
// is none of its capabilities, and is refused without asking.
//
// A connection that was lost, or that is refused, is initiated again within the access, once or twice, and a read is asked
// for again. What fails all the same may be granted later, and is told so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interbus/pcp_blocks.h"
#include "link/modbus/register_order.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"
#include "profile/parameter_queue.h"

namespace nord_driver {

/// `bus/pcp`.
struct PcpMap {
  std::uint16_t invoke_address = 0;
  std::uint16_t result_address = 0;
  bool result_in_input_registers = false;  ///< function 4 instead of 3
  bool swapped = false;                    ///< the bytes of each word
  bool initiate = true;                    ///< the driver has to initiate the connections itself
  Duration timeout{std::chrono::seconds{2}};
  interbus::PcpInvokeLayout invoke{};
  interbus::PcpResultLayout result{};
};

/// How a drive is asked.
struct PcpDrive {
  std::uint16_t reference = 2;      ///< communication reference of its connection
  bool array_sub_by_table = false;  ///< element n of an array without sets: sub-index 4 (n - 1) + 1 instead of n
};

/// Sans-IO. Each cycle: pollOrder(), and handleAnswer() once its order has been carried out or given up.
class InterbusParameters {
 public:
  InterbusParameters(const PcpMap& map, const std::vector<PcpDrive>& drives);

  static constexpr profile::ParameterCapabilities capabilities() noexcept { return {false, false}; }

  /// As ParameterQueue::submit().
  bool submit(std::size_t drive, const profile::ParameterRequest& request) noexcept;
  /// The order to carry out next; nothing while one is under way, or there is nothing to do.
  std::optional<link::RegisterOrder> pollOrder(Instant now) noexcept;
  /// To the order of the last pollOrder().
  void handleAnswer(const link::RegisterAnswer& answer) noexcept;
  /// Ends all pending requests of this drive as offline.
  void handleOffline(std::size_t drive) noexcept;
  std::optional<profile::ParameterResult> pollResult(std::size_t drive) noexcept {
    return drives_[drive].requests.pollResult();
  }

 private:
  enum class Phase : std::uint8_t {
    kLate,       ///< until the result block confirms the service of an access that has ended
    kClear,      ///< the invoke block is to say "no order"
    kCleared,    ///< until the result block says so, too
    kInvoke,     ///< nothing under way
    kConfirmed,  ///< until the result block confirms
  };
  struct DriveQueue {
    PcpDrive how;
    bool initiated = false;
    profile::ParameterQueue requests;
  };

  bool startNext(Instant now) noexcept;
  void skipUnserved(DriveQueue& drive) noexcept;
  void giveUp() noexcept;
  interbus::PcpInvocation invocation() const noexcept;
  link::RegisterOrder write(const interbus::PcpInvocation& invocation) const noexcept;
  link::RegisterOrder read() const noexcept;
  void handleResult(const interbus::PcpResult& result) noexcept;
  void handleConfirmation(const interbus::PcpResult& result) noexcept;
  void takeValue(const interbus::PcpResult& result) noexcept;
  void handleAbort() noexcept;
  void refuseConnection(const interbus::PcpError& error) noexcept;
  bool fallBack(const interbus::PcpError& error) noexcept;
  bool repeat(const interbus::PcpError& error) noexcept;
  void end() noexcept;
  void endUnconfirmed() noexcept;
  void forgetLate() noexcept;
  void leaveOrder() noexcept;

  PcpMap map_;
  std::vector<DriveQueue> drives_;
  std::optional<std::size_t> running_;  // the drive whose request runs
  std::size_t next_ = 0;                // whose turn it is
  Phase phase_ = Phase::kClear;
  bool invoked_ = false;      // since the block was last seen cleared
  bool under_way_ = false;    // an order
  bool invoking_ = false;     // that order is the one that invokes
  bool foreign_ = false;      // it belongs to a request that has ended
  unsigned initiations_ = 0;  // of the running request's connection
  bool plain_ = false;        // the running request is asked for with sub-index 0
  Instant deadline_{};
  Sentence trouble_;  // why the last order of the running request was not carried out
  interbus::PcpInvocation invocation_;
  std::optional<interbus::PcpInvocation> late_;  // of an access that has ended, and the gateway may still confirm it
  Instant late_until_{};
};

}  // namespace nord_driver
