// The addresses of a host name, looked up without being held up by it.
#pragma once

#include <netdb.h>
#include <sys/socket.h>

#include <functional>
#include <memory>
#include <vector>

#include "link/modbus/modbus_settings.h"
#include "link/modbus/wakeup.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
};

/// What getaddrinfo() does; a test has its own. Called from a thread nobody can end.
using LookUp = std::function<int(const char* host, const char* port, const addrinfo* hints, addrinfo** found)>;

/// A numeric address is taken as it is. For a name a thread of its own asks the system, which may take half a minute
/// and cannot be called off: the thread is left behind when the wait ends, holds nothing of ours, and is asked again
/// instead of starting a second one.
class HostResolver {
 public:
  explicit HostResolver(ServerName name, LookUp look_up = ::getaddrinfo);

  /// False when `until` has come or `stop` was signalled first, or when there is no such host: `reason`.
  bool resolve(Instant until, const Wakeup& stop, std::vector<SocketAddress>& found, Sentence& reason);

 private:
  struct Inquiry;
  bool begin(Sentence& reason);

  ServerName name_;
  LookUp look_up_;
  std::shared_ptr<Inquiry> inquiry_;  // the one under way
};

}  // namespace nord_driver::link
