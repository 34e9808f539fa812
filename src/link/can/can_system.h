// The seam between a SocketCAN link and the kernel: everything that needs a controller to be tried out.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/can_frame.h"
#include "link/can/can_interface.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// What the controller tells about itself and the bus (linux/can/error.h).
struct CanErrorFrame {
  std::uint32_t classes = 0;  ///< CAN_ERR_...
  std::array<std::uint8_t, kCanDataLength> data{};
};

/// What one read brings: a frame of the bus, or one of the controller.
struct CanReceipt {
  bool is_error = false;
  CanErrorFrame error;
  CanFrame frame;
  bool has_age = false;
  Duration age{};  ///< since the kernel had it, by the clock on the wall: wrong when that clock was set meanwhile
};

struct CanReady {
  bool socket = false;    ///< something to be read (an error of the socket, too), or room to write
  bool messages = false;  ///< a kernel message about interfaces can be read
  int error = 0;          ///< errno, EINTR included
};

/// Every function that can fail gives 0 (or a descriptor) and otherwise -errno. Nothing allocates and nothing throws.
class CanSystem {
 public:
  virtual ~CanSystem() = default;

  /// A CAN_RAW socket, not blocking, not bound yet. -EAFNOSUPPORT: the kernel has no CAN.
  virtual int open() noexcept = 0;
  virtual void close(int descriptor) noexcept = 0;

  virtual int readInterface(const char* name, CanInterface& interface) noexcept = 0;
  /// Asks the controller to leave bus-off. -EPERM without CAP_NET_ADMIN.
  virtual int restart(int index) noexcept = 0;
  /// A descriptor for kernel messages about interfaces, not blocking.
  virtual int openInterfaceMessages() noexcept = 0;
  /// The next message; -EAGAIN: there is none. -ENOBUFS: some were lost.
  virtual int readInterfaceMessage(int descriptor, CanInterface& interface) noexcept = 0;

  /// Data frames with exactly the 11 bit identifiers `ids`, and remote frames with exactly `remote_ids`.
  virtual int setFilters(int descriptor, const std::vector<std::uint32_t>& ids,
                         const std::vector<std::uint32_t>& remote_ids) noexcept = 0;
  virtual int setErrorFilter(int descriptor, std::uint32_t classes) noexcept = 0;
  /// Bytes; the kernel has limits of its own for both.
  virtual int setBuffers(int descriptor, int receive, int send) noexcept = 0;
  virtual int enableTimeStamps(int descriptor) noexcept = 0;
  virtual int bind(int descriptor, int index) noexcept = 0;

  virtual int send(int descriptor, const CanFrame& frame) noexcept = 0;
  virtual int receive(int descriptor, CanReceipt& receipt) noexcept = 0;
  /// Frames the kernel had no room for, since the socket was made.
  virtual int readDropCount(int descriptor, std::uint32_t& count) noexcept = 0;
  /// `messages` may be -1. `to_write`: room to write is waited for, and not something to be read.
  virtual CanReady poll(int descriptor, int messages, bool to_write, Duration timeout) noexcept = 0;

  virtual Instant now() const noexcept = 0;
  virtual void sleepUntil(Instant when) noexcept = 0;
};

/// Linux' own.
CanSystem& linuxCanSystem() noexcept;

}  // namespace nord_driver::link
