// A gateway and its ring in simulated time behind the link interface: a minute of driving runs in milliseconds.
//
// No TCP and no thread. It goes through the states of link::ModbusLink: connects, sets the watchdog, exchanges once for
// each image, carries out orders behind them, and connects again after pauses that grow. Each request is a whole Modbus
// telegram to the simulated registers, and its answer is judged as that of a real gateway is. There is one connection
// for everything, whatever the settings say of a second one.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "link/modbus/backoff.h"
#include "link/modbus/modbus_connection.h"
#include "link/modbus/modbus_exchange.h"
#include "link/modbus/modbus_telegram.h"
#include "link/modbus/register_link.h"
#include "link/modbus/register_order.h"
#include "sim/interbus/ibs_ring.h"
#include "sim/interbus/register_gateway.h"

namespace nord_driver::sim {

/// What the network between the driver and the gateway does. What the gateway does wrong itself: GatewaySwitches.
struct NetworkState {
  Duration latency{std::chrono::microseconds{400}};  ///< of a request and its answer, half of it each way
  bool port_open = true;                             ///< false: connections are refused, and the one there is is reset
  bool carries_requests = true;                      ///< false: they are lost on their way, those to connect as well
  bool carries_answers = true;                       ///< false: requests are carried out, and their answers are lost
};

class SimulatedGateway final : public link::RegisterLink {
 public:
  enum class Sender : std::uint8_t { kDriver, kGateway };
  /// Sees every telegram that arrives, when it does.
  using Tap = std::function<void(ByteView, Sender, Instant)>;

  /// `settings` are those of the driver's link. Throws ConfigError as IbsRing does.
  SimulatedGateway(const SimConfig& config, link::ModbusSettings settings);
  SimulatedGateway(const SimulatedGateway&) = delete;
  SimulatedGateway& operator=(const SimulatedGateway&) = delete;

  bool open() noexcept override;
  void close() noexcept override;
  std::uint64_t give(const RegisterImage& outputs) noexcept override;
  std::uint64_t look() noexcept override {
    given_look_ = true;
    return startGiven();
  }
  std::uint64_t order(const link::RegisterOrder& order) noexcept override;
  const link::RegisterAnswer& answer() noexcept override { return order_answer_; }
  const link::RegisterInputs& take() noexcept override { return newest_; }
  const link::LinkReport& report() noexcept override { return report_; }
  bool waitAnswers(Instant until) noexcept override;
  Instant now() const noexcept override { return now_; }
  void sleepUntil(Instant when) noexcept override;

  /// Lets simulated time pass without touching the link.
  void run(Duration span) noexcept { sleepUntil(now_ + span); }
  /// Runs `what` when this time has come, in the middle of a cycle or of an exchange as well.
  void at(Instant when, std::function<void()> what) { planned_.emplace_back(when, std::move(what)); }

  void setNetwork(const NetworkState& network) noexcept;
  const NetworkState& network() const noexcept { return network_; }
  /// Ends the connection there is, as a reset from the other side does.
  void resetConnection() noexcept;
  void setTap(Tap tap) { tap_ = std::move(tap); }

  RobotSim& robot() noexcept { return robot_; }
  IbsRing& ring() noexcept { return ring_; }
  RegisterGateway& gateway() noexcept { return gateway_; }
  DriveUnit& drive(std::size_t index) noexcept { return robot_.drive(index); }

 private:
  enum class Doing : std::uint8_t { kNothing, kConnects, kSetsWatchdog, kIdle, kExchanges, kServes, kPauses };

  void advanceTo(Instant when, bool stop_at_answer) noexcept;
  Instant nextEvent() const noexcept;
  bool handleEvent() noexcept;
  void runPlanned() noexcept;

  void connect() noexcept;
  void handleConnect() noexcept;
  bool isAsking() const noexcept;
  void rest() noexcept;
  std::uint64_t startGiven() noexcept;
  void startExchange() noexcept;
  /// Each request of this exchange writes and reads.
  bool doesBoth() const noexcept {
    return !looks_ && settings_.inputs.function == link::ModbusFunction::kReadWriteRegisters;
  }
  void startOrder() noexcept;
  bool ordersWait() const noexcept { return ordered_ != served_; }
  void answerOrder(const link::RegisterAnswer& answer) noexcept;
  bool makeRequest(link::ModbusRequest& request) noexcept;
  bool makeWatchdogRequest(link::ModbusRequest& request) noexcept;
  bool makeImageRequest(link::ModbusRequest& request) noexcept;
  bool makeOrderRequest(link::ModbusRequest& request) noexcept;
  void sendNext() noexcept;
  void arrive() noexcept;
  void handleAnswer() noexcept;
  void handleRefusal(const link::AnswerVerdict& verdict) noexcept;
  void use(ByteView answer) noexcept;
  void useOrdered(ByteView answer) noexcept;
  void finish() noexcept;
  void fail(link::ModbusTrouble trouble, const char* what) noexcept;
  void tell(link::LinkState state) noexcept;

  link::ModbusSettings settings_;
  RobotSim robot_;
  IbsRing ring_;
  RegisterGateway gateway_;
  NetworkState network_;
  std::vector<std::pair<Instant, std::function<void()>>> planned_;
  Tap tap_;
  Instant now_{seconds(1000.0)};

  Doing doing_ = Doing::kNothing;
  bool connected_ = false;
  bool watchdog_set_ = false;
  Instant due_{};  // of what it does when it connects or pauses; of a request: its time-out
  link::Backoff backoff_;

  // The request under way.
  unsigned step_ = 0;  // of the exchange, of setting the watchdog or of the order
  link::ModbusRequest request_;
  std::optional<Instant> arrives_;
  std::optional<Instant> answered_;
  ModbusBytes answer_;
  std::uint16_t transaction_ = 0;

  // The order that waits, the one under way and the answer to the last one.
  link::RegisterOrder next_order_, running_order_;
  std::uint64_t ordered_ = 0;
  std::uint64_t served_ = 0;
  link::RegisterAnswer order_answer_;

  // The exchange under way.
  bool looks_ = false;  // it only reads
  link::PartOrder part_order_;
  RegisterImage sent_;     // the outputs of this exchange
  RegisterImage written_;  // what the gateway has of the exchanges before
  link::RegisterInputs coming_;

  RegisterImage given_image_;
  bool given_look_ = false;  // in place of an image
  std::uint64_t given_ = 0;
  std::uint64_t last_outputs_ = 0;
  link::RegisterInputs newest_;
  link::LinkReport report_;
  bool answers_ = false;
};

}  // namespace nord_driver::sim
