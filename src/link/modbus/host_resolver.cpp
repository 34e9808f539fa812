#include "link/modbus/host_resolver.h"

#include <errno.h>
#include <poll.h>

#include <cstring>
#include <exception>
#include <string>
#include <thread>

#include "link/error_text.h"
#include "link/waiting.h"

namespace nord_driver::link {

namespace {

addrinfo hints(int flags) noexcept {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_protocol = IPPROTO_TCP;
  wanted.ai_flags = flags | AI_NUMERICSERV;
  return wanted;
}

std::vector<SocketAddress> toList(addrinfo* found) {
  std::vector<SocketAddress> list;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    SocketAddress address;
    if (one->ai_addrlen > sizeof address.storage) continue;
    std::memcpy(&address.storage, one->ai_addr, one->ai_addrlen);
    address.size = one->ai_addrlen;
    list.push_back(address);
  }
  if (found != nullptr) ::freeaddrinfo(found);
  return list;
}

}  // namespace

// Everything the thread touches.
struct HostResolver::Inquiry {
  std::string host, port;
  LookUp look_up;
  Wakeup done;  // hands over what follows
  int error = 0;
  std::vector<SocketAddress> found;

  void run() {
    const addrinfo wanted = hints(0);
    addrinfo* list = nullptr;
    error = look_up(host.c_str(), port.c_str(), &wanted, &list);
    if (error == 0) found = toList(list);
    done.signal();
  }
};

HostResolver::HostResolver(ServerName name, LookUp look_up) : name_(std::move(name)), look_up_(std::move(look_up)) {}

bool HostResolver::begin(Sentence& reason) {
  inquiry_ = std::make_shared<Inquiry>();
  if (inquiry_->done.descriptor() < 0) {
    // Nobody would ever hear of its end.
    reason.format("the host name %s cannot be looked up: %s", name_.host.c_str(), ErrorText(errno).c_str());
    inquiry_.reset();
    return false;
  }
  inquiry_->host = name_.host;
  inquiry_->port = std::to_string(name_.port);
  inquiry_->look_up = look_up_;
  try {
    std::thread([inquiry = inquiry_] { inquiry->run(); }).detach();
    return true;
  } catch (const std::exception& error) {
    inquiry_.reset();
    reason.format("%s: no thread to look the name up with: %s", name_.host.c_str(), error.what());
    return false;
  }
}

bool HostResolver::resolve(Instant until, const Wakeup& stop, std::vector<SocketAddress>& found, Sentence& reason) {
  const addrinfo numeric = hints(AI_NUMERICHOST);
  addrinfo* list = nullptr;
  if (::getaddrinfo(name_.host.c_str(), std::to_string(name_.port).c_str(), &numeric, &list) == 0) {
    found = toList(list);
    return true;
  }
  if (!inquiry_ && !begin(reason)) return false;
  pollfd waits[] = {{inquiry_->done.descriptor(), POLLIN, 0}, {stop.descriptor(), POLLIN, 0}};
  const timespec left = toTimeout(until - std::chrono::steady_clock::now());
  ::ppoll(waits, 2, &left, nullptr);
  if (!inquiry_->done.take()) {
    reason.format("the host name %s is still being looked up: does the name server answer?", name_.host.c_str());
    return false;
  }
  const std::shared_ptr<Inquiry> answered = std::move(inquiry_);
  inquiry_.reset();
  if (answered->error != 0) {
    reason.format("the host name %s is not known here (%s)", name_.host.c_str(), ::gai_strerror(answered->error));
    return false;
  }
  found = answered->found;
  return true;
}

}  // namespace nord_driver::link
