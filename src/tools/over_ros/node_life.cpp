#include "tools/over_ros/node_life.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <utility>
#include <vector>

#include "link/modbus/host_resolver.h"
#include "link/modbus/tcp_connect.h"
#include "tools/drive_parameters.h"

namespace nord_driver::tools {

namespace {

constexpr Duration kConnectTime = std::chrono::milliseconds{300};
constexpr std::chrono::seconds kSilence{1};   // before it is asked, and between two questions
constexpr std::chrono::seconds kTooLong{15};  // status_rate may be 0.1 Hz

}  // namespace

bool acceptsConnection(const std::string& host, std::uint32_t port) {
  if (port == 0 || port > 65535) return false;
  const link::Wakeup never;
  Sentence reason;
  std::vector<link::SocketAddress> addresses;
  const Instant until = std::chrono::steady_clock::now() + kConnectTime;
  link::HostResolver resolver{{host, static_cast<std::uint16_t>(port)}};
  if (!resolver.resolve(until, never, addresses, reason)) return false;
  const int socket = link::connectTcp(addresses, until, never, reason);
  if (socket >= 0) ::close(socket);
  return socket >= 0;
}

std::optional<int> processOf(const std::string& node) {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  if (!ros::master::execute("lookupNode", arguments, result, payload, false)) return std::nullopt;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(payload), host, port) || !acceptsConnection(host, port)) {
    return std::nullopt;
  }
  XmlRpc::XmlRpcClient client{host.c_str(), static_cast<int>(port), "/"};
  XmlRpc::XmlRpcValue caller, answer;
  caller[0] = ros::this_node::getName();
  if (!client.execute("getPid", caller, answer) || answer.size() != 3) return std::nullopt;
  return static_cast<int>(answer[2]);
}

NodeLife::NodeLife(std::string node)
    : node_(std::move(node)), process_(processOf(node_)), heard_(Clock::now()), asked_(heard_) {
  if (!process_) throw Trouble("node " + node_ + " does not answer: does it run?");
}

void NodeLife::heard() {
  heard_ = Clock::now();
}

void NodeLife::check(bool connected) {
  const Clock::time_point now = Clock::now();
  if (connected && now - heard_ < kSilence) return;
  if (connected && now - asked_ < kSilence) return;
  asked_ = now;
  if (processOf(node_) != process_) throw Trouble("node " + node_ + " has ended: nothing more is known of its drives");
  if (now - heard_ > kTooLong) throw Trouble("node " + node_ + " runs, but has told nothing for 15 s");
}

}  // namespace nord_driver::tools
