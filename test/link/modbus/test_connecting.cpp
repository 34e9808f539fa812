// How a connection comes about: names, addresses, options of the socket, and that nobody is held up by it.
#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <future>

#include "link/modbus/link_fixture.h"
#include "link/modbus/tcp_connect.h"

namespace nord_driver::link::test {
namespace {

using std::chrono::milliseconds;

Instant in(Duration span) {
  return std::chrono::steady_clock::now() + span;
}

int option(int socket, int level, int name) {
  int value = -1;
  socklen_t size = sizeof value;
  EXPECT_EQ(0, ::getsockopt(socket, level, name, &value, &size));
  return value;
}

// A listener whose queue is full: the kernel lets requests to connect pass unanswered, as an unplugged cable does.
class FullListener {
 public:
  FullListener() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof any;
    auto* address = reinterpret_cast<sockaddr*>(&any);
    EXPECT_EQ(0, ::bind(listener_, address, size));
    EXPECT_EQ(0, ::listen(listener_, 0));
    EXPECT_EQ(0, ::getsockname(listener_, address, &size));
    port_ = ntohs(any.sin_port);
    for (int& waiting : waiting_) {
      waiting = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
      [[maybe_unused]] const int under_way = ::connect(waiting, address, size);
    }
  }
  ~FullListener() {
    for (const int waiting : waiting_) ::close(waiting);
    ::close(listener_);
  }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  std::uint16_t port() const { return port_; }

 private:
  int listener_;
  int waiting_[4] = {};
  std::uint16_t port_ = 0;
};

// --- Sockets ---

TEST(Connecting, TheSocketDoesNotWaitAndNoticesWhenTheOtherSideIsGone) {
  FakeModbusServer server;
  ModbusConnection connection{fourWords(server.address())};
  Wakeup stop;
  ASSERT_TRUE(connection.open(stop)) << connection.reason().c_str();
  const int socket = connection.descriptor();
  EXPECT_EQ(1, option(socket, IPPROTO_TCP, TCP_NODELAY));
  EXPECT_EQ(1, option(socket, SOL_SOCKET, SO_KEEPALIVE));
  EXPECT_EQ(1, option(socket, IPPROTO_TCP, TCP_KEEPIDLE));
  EXPECT_EQ(1, option(socket, IPPROTO_TCP, TCP_KEEPINTVL));
  EXPECT_EQ(3, option(socket, IPPROTO_TCP, TCP_KEEPCNT));
  EXPECT_EQ(2000, option(socket, IPPROTO_TCP, TCP_USER_TIMEOUT));
}

TEST(Connecting, NobodyAnswersTheRequestToConnect) {
  FullListener nobody;
  ModbusSettings settings = fourWords(nobody.address());
  settings.connect_timeout = milliseconds{50};
  ModbusConnection connection{settings};
  Wakeup stop;
  EXPECT_FALSE(connection.open(stop));
  EXPECT_EQ(nobody.address() +
                " does not answer a request to connect: is it powered and plugged in, and is the address right?",
            connection.reason().str());
}

SocketAddress addressOf(std::uint16_t port) {
  SocketAddress address;
  auto& v4 = reinterpret_cast<sockaddr_in&>(address.storage);
  v4.sin_family = AF_INET;
  v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  v4.sin_port = htons(port);
  address.size = sizeof v4;
  return address;
}

// A name with an address nobody answers at, an IPv6 one behind a broken route for example, and one that is right: the
// first has its share of the time, not all of it.
TEST(Connecting, AnAddressThatIsSilentLeavesTimeForTheNext) {
  FullListener nobody;
  FakeModbusServer server;
  const std::string name = server.address();
  const SocketAddress good = addressOf(static_cast<std::uint16_t>(std::stoul(name.substr(name.rfind(':') + 1))));
  Wakeup stop;
  Sentence reason;
  const Instant until = in(milliseconds{900});
  const int socket = connectTcp({addressOf(nobody.port()), addressOf(nobody.port()), good}, until, stop, reason);
  EXPECT_LT(std::chrono::steady_clock::now(), until);
  EXPECT_LE(0, socket) << reason.c_str();
  if (socket >= 0) ::close(socket);
}

TEST(Connecting, OneAddressHasAllTheTime) {
  FullListener nobody;
  Wakeup stop;
  Sentence reason;
  const Instant until = in(milliseconds{50});
  EXPECT_EQ(-1, connectTcp({addressOf(nobody.port())}, until, stop, reason));
  EXPECT_GE(std::chrono::steady_clock::now(), until);
}

TEST(Connecting, WaitingForAConnectionCanBeEnded) {
  FullListener nobody;
  ModbusLink link{fourWords(nobody.address())};
  ASSERT_TRUE(link.open());
  ASSERT_TRUE(link.waitAnswers(in(kPatience)));  // it has begun
  const Instant before = link.now();
  link.close();
  EXPECT_LT(link.now() - before, milliseconds{1500});  // TCP_USER_TIMEOUT would end it after 2 s
}

TEST(Connecting, EveryFailureHasItsWords) {
  EXPECT_STREQ("refuses the connection: is its Modbus/TCP server switched on, and is this its port?",
               connectFailure(ECONNREFUSED).c_str());
  EXPECT_STREQ(
      "cannot be reached (No route to host): is it powered, plugged in, and in the same network as this computer?",
      connectFailure(EHOSTUNREACH).c_str());
  EXPECT_STREQ(
      "cannot be reached (Network is unreachable): is it powered, plugged in, and in the same network as this "
      "computer?",
      connectFailure(ENETUNREACH).c_str());
  EXPECT_STREQ("could not be connected to: Permission denied", connectFailure(EACCES).c_str());
}

// --- Names ---

addrinfo* loopback(std::uint16_t port) {
  // As getaddrinfo() lays it out, so that freeaddrinfo() can be called: found by the real one.
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  EXPECT_EQ(0, ::getaddrinfo("127.0.0.1", std::to_string(port).c_str(), &hints, &found));
  return found;
}

TEST(Connecting, AnAddressAsksNoNameServer) {
  HostResolver resolver{{"127.0.0.1", 502}, [](auto...) {
                          ADD_FAILURE() << "was asked";
                          return EAI_FAIL;
                        }};
  Wakeup stop;
  std::vector<SocketAddress> found;
  Sentence reason;
  EXPECT_TRUE(resolver.resolve(in(kPatience), stop, found, reason)) << reason.c_str();
  ASSERT_EQ(1u, found.size());
  EXPECT_EQ(AF_INET, found[0].storage.ss_family);
}

TEST(Connecting, ANameIsLookedUp) {
  HostResolver resolver{{"gateway", 1502}, [](const char* host, const char* port, const addrinfo*, addrinfo** found) {
                          EXPECT_STREQ("gateway", host);
                          EXPECT_STREQ("1502", port);
                          *found = loopback(1502);
                          return 0;
                        }};
  Wakeup stop;
  std::vector<SocketAddress> found;
  Sentence reason;
  EXPECT_TRUE(resolver.resolve(in(kPatience), stop, found, reason)) << reason.c_str();
  EXPECT_EQ(1u, found.size());
}

// A name server that is away holds the system's call up for half a minute. The wait ends in time or when told to, the
// same call is waited for again, and its answer counts when it comes.
TEST(Connecting, ALookUpThatHangsHoldsNobodyUp) {
  auto gate = std::make_shared<std::promise<void>>();
  auto calls = std::make_shared<std::atomic<int>>(0);
  const std::shared_future<void> opened = gate->get_future().share();
  HostResolver resolver{{"gateway", 502}, [=](const char*, const char*, const addrinfo*, addrinfo** found) {
                          ++*calls;
                          opened.wait();
                          *found = loopback(502);
                          return 0;
                        }};
  Wakeup stop;
  std::vector<SocketAddress> found;
  Sentence reason;
  EXPECT_FALSE(resolver.resolve(in(milliseconds{20}), stop, found, reason));
  EXPECT_STREQ("the host name gateway is still being looked up: does the name server answer?", reason.c_str());
  stop.signal();
  const Instant before = std::chrono::steady_clock::now();
  EXPECT_FALSE(resolver.resolve(in(kPatience), stop, found, reason));
  EXPECT_LT(std::chrono::steady_clock::now() - before, kPatience / 4);
  gate->set_value();
  Wakeup never;
  EXPECT_TRUE(resolver.resolve(in(kPatience), never, found, reason)) << reason.c_str();
  EXPECT_EQ(1, *calls);
}

// As long as it lives, this process gets no new descriptor (EMFILE).
class NoDescriptors {
 public:
  NoDescriptors() {
    EXPECT_EQ(0, ::getrlimit(RLIMIT_NOFILE, &before_));
    rlimit few = before_;
    few.rlim_cur = 3;  // those of standard input and output are taken
    EXPECT_EQ(0, ::setrlimit(RLIMIT_NOFILE, &few));
  }
  ~NoDescriptors() { EXPECT_EQ(0, ::setrlimit(RLIMIT_NOFILE, &before_)); }

 private:
  rlimit before_{};
};

TEST(Connecting, ALookUpNobodyCouldWaitForIsBegunAnew) {
  auto calls = std::make_shared<std::atomic<int>>(0);
  HostResolver resolver{{"gateway", 502}, [=](const char*, const char*, const addrinfo*, addrinfo** found) {
                          ++*calls;
                          *found = loopback(502);
                          return 0;
                        }};
  Wakeup stop;
  std::vector<SocketAddress> found;
  Sentence reason;
  {
    const NoDescriptors none;
    EXPECT_FALSE(resolver.resolve(in(milliseconds{20}), stop, found, reason));
  }
  EXPECT_STREQ("the host name gateway cannot be looked up: Too many open files", reason.c_str());
  EXPECT_EQ(0, *calls);
  EXPECT_TRUE(resolver.resolve(in(milliseconds{2000}), stop, found, reason)) << reason.c_str();
  EXPECT_EQ(1, *calls);
}

// The link ends although the call does not, and the call may end when everything it was for is gone.
TEST(Connecting, TheLinkEndsBeforeALookUpThatHangs) {
  auto gate = std::make_shared<std::promise<void>>();
  auto left = std::make_shared<std::promise<void>>();
  const std::shared_future<void> opened = gate->get_future().share();
  {
    ModbusLink link{fourWords("gateway"), [=](const char*, const char*, const addrinfo*, addrinfo**) {
                      opened.wait();
                      left->set_value();
                      return EAI_AGAIN;
                    }};
    ASSERT_TRUE(link.open());
    ASSERT_TRUE(link.waitAnswers(in(kPatience)));
    const Instant before = link.now();
    link.close();
    EXPECT_LT(link.now() - before, kPatience / 4);
  }
  gate->set_value();
  EXPECT_EQ(std::future_status::ready, left->get_future().wait_for(kPatience));
}

}  // namespace
}  // namespace nord_driver::link::test
