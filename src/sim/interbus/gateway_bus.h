// The simulated gateway on a TCP port of the loopback, in real time: a driver connects to it as to a real one.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "sim/interbus/register_gateway.h"
#include "sim/running_bus.h"

namespace nord_driver::sim {

/// Serves from construction to destruction, in a thread of its own; eight clients at once.
class GatewayBus final : public RunningBus {
 public:
  /// On `IbsBusConfig::gateway`. Throws std::runtime_error naming the port and the reason, and ConfigError as IbsRing
  /// does.
  explicit GatewayBus(const SimConfig& config);
  ~GatewayBus() override;
  GatewayBus(const GatewayBus&) = delete;
  GatewayBus& operator=(const GatewayBus&) = delete;

  std::string where() const override { return "127.0.0.1:" + std::to_string(port_); }
  /// Runs `function(IbsRing&, RegisterGateway&)` while the models stand still. Any thread.
  template <typename Function>
  auto withGateway(Function&& function) {
    const std::lock_guard<InheritingMutex> lock(mutex_);
    return std::forward<Function>(function)(ring_, gateway_);
  }

 private:
  static constexpr std::size_t kClients = 8;

  struct Client {
    int socket = -1;
    FixedBytes<2 * kLongestModbus> input;
    ModbusBytes answer;  // that waits
    Instant due{};
  };

  RobotSim& robot() noexcept override { return robot_; }
  std::string report() const override { return ring_.report(); }
  void listenAt(std::uint16_t port);
  void serve() noexcept;
  void accept() noexcept;
  bool receive(Client& client) noexcept;
  void answerNext(Client& client, Instant now) noexcept;
  static void close(Client& client) noexcept;

  RobotSim robot_;
  IbsRing ring_;
  RegisterGateway gateway_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::array<Client, kClients> clients_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace nord_driver::sim
