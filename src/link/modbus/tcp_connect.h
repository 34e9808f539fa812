// A TCP connection for short requests that must not wait: made within a time, and noticed when it dies.
#pragma once

#include <vector>

#include "link/modbus/host_resolver.h"
#include "link/modbus/wakeup.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// Sent bytes that nobody acknowledges end the connection after this time (TCP_USER_TIMEOUT).
constexpr std::chrono::milliseconds kUserTimeout{2000};

/// Tries the addresses in order until one accepts; the time that is left is shared equally among those that are left. The
/// socket does not block, has TCP_NODELAY, keep-alive (after 1 s, each second, three times) and TCP_USER_TIMEOUT. -1 when
/// none accepted until `until` or `stop` was signalled: `reason` begins behind the server's name.
int connectTcp(const std::vector<SocketAddress>& addresses, Instant until, const Wakeup& stop, Sentence& reason);

/// The words for a connection that was not made, behind the server's name.
Sentence connectFailure(int error) noexcept;

}  // namespace nord_driver::link
