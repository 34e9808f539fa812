// A whole DeviceNet scanner against any frames, and an explicit client against any answers: it never stops asking, never
// floods the bus, sends process data only to who exchanges, and every request gets its answer.
#include <algorithm>

#include "can_game.h"
#include "devicenet/scanner.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::devicenet;
using namespace std::chrono_literals;

NodeConfig node(std::uint8_t mac, IoKind kind, std::size_t bytes) {
  NodeConfig made;
  made.mac = mac;
  made.io.kind = kind;
  made.io.input_bytes = bytes;
  made.io.output_bytes = bytes;
  return made;
}

ScannerConfig bus(std::uint8_t options) {
  ScannerConfig config;
  config.nodes = {node(1, IoKind::kPoll, 5), node(2, IoKind::kPoll, 33), node(3, IoKind::kChangeOfState, 10),
                  node(4, IoKind::kStrobe, 8)};
  config.nodes[2].io.kind = (options & 1u) != 0 ? IoKind::kCyclic : IoKind::kChangeOfState;
  config.nodes[2].io.acknowledge = (options & 2u) != 0;
  config.nodes[0].vendor_id = std::uint16_t{389};
  return config;
}

/// The explicit reassembly alone: whatever is answered, one answer comes within its time-outs.
void playClient(fuzz::Choices& choices) {
  ExplicitClient client{0, 9};
  Instant now{std::chrono::hours{1}};
  ExplicitRequest request = getAttribute(1, 4, 100, 3);
  if (choices.below(2) == 0) request = setAttribute(1, 4, 100, 3, ByteView{choices.bytes(40)});
  fuzz::require(client.start(request, ExplicitPort::kConnected, BodyFormat::k8Over8, 100ms, now));
  std::uint8_t count = 0;
  while (!choices.empty()) {
    CanFrame frame;
    for (int i = 0; client.pollTransmit(frame, now); ++i) fuzz::require(i < 4 && frame.size <= 8 && frame.size > 0);
    FixedBytes<8> bytes;
    const std::uint8_t kind = choices.below(8);
    const auto header = static_cast<std::uint8_t>(kind < 6 ? 0xC0u : choices.byte());
    bytes.push_back(header);
    if (kind < 4) {  // the next fragment of an answer
      bytes.push_back(static_cast<std::uint8_t>((count == 0 ? 0x00u : kind == 0 ? 0x80u : 0x40u) | (count & 0x3Fu)));
      if (count++ == 0) bytes.push_back(request.service | service::kResponse);
    } else if (kind == 4) {  // an acknowledge
      bytes.push_back(static_cast<std::uint8_t>(0xC0u | choices.below(8)));
      bytes.push_back(choices.below(8) == 7 ? 1 : 0);
    }
    if (kind != 4) {
      for (const std::uint8_t byte : choices.bytes(choices.below(7))) bytes.push_back(byte);
    }
    client.handle(dataFrame(0x44B, bytes), now);
    now += std::chrono::milliseconds{choices.below(40)};
    client.poll(now);
    if (const auto answer = client.takeAnswer()) {
      fuzz::require(answer->id == 1 && answer->data.size() <= kExplicitData);
      return;
    }
  }
  for (int i = 0; !client.takeAnswer(); ++i) {
    fuzz::require(i < 200 && client.nextDeadline());
    CanFrame frame;
    while (client.pollTransmit(frame, now)) {
    }
    now = std::max(now, *client.nextDeadline());
    client.poll(now);
  }
  fuzz::require(!client.busy());
}

class Game final : public fuzz::CanGame {
 public:
  Game(fuzz::Choices& choices, std::uint8_t options) : CanGame(choices, scanner_), scanner_(bus(options)) {
    begin(scanner_.receivedIds(), 0x7EF);
    if ((options & 4u) == 0) connect();
  }

 private:
  void connect() {
    for (int i = 0; i < 3000 && !fuzz::allAre(scanner_, NodeState::kExchanging); ++i) {
      now_ += 1ms;
      settle();
      for (CanFrame& asked : asked_) {
        if (asked.size != 0) answer(asked);
      }
    }
    fuzz::require(fuzz::allAre(scanner_, NodeState::kExchanging));
  }
  void act() override {
    const std::size_t which = choices_.below(4);
    const auto mac = static_cast<std::uint8_t>(which + 1);
    switch (choices_.below(16)) {
      case 0:
        scanner_.setOutput(which, choices_.bytes(choices_.below(40)));
        break;
      case 1: {
        ExplicitRequest request = getAttribute(choices_.byte(), 101, 1, choices_.byte());
        if (choices_.below(2) == 0) request = setAttribute(1, 4, 100, 3, choices_.bytes(choices_.below(64)));
        if (scanner_.submit(which, request)) ++pending_;
        break;
      }
      case 2:
        if (choices_.below(16) == 0) scanner_.restart(now_);
        if (choices_.below(16) == 0) scanner_.handleBusLost("gone", now_);
        if (choices_.below(64) == 0) scanner_.releaseAll(now_);
        break;
      case 3:
      case 4:
      case 5:
        scanner_.startCycle(now_);
        break;
      case 6:
        hearAnything();
        break;
      case 7:  // process data
        hear(dataFrame((0xDu + choices_.below(3)) << 6u | mac, choices_.bytes(choices_.below(9))));
        break;
      case 8: {  // an explicit response, or something like it
        FixedBytes<8> bytes{static_cast<std::uint8_t>(choices_.below(4) << 6u)};
        for (const std::uint8_t byte : choices_.bytes(choices_.below(8))) bytes.push_back(byte);
        hear(dataFrame(0x403u | static_cast<std::uint32_t>(mac) << 3u, bytes));
        break;
      }
      case 9:  // a duplicate-MAC message
        hear(dataFrame(0x407u | static_cast<std::uint32_t>(choices_.below(6)) << 3u, choices_.bytes(7)));
        break;
      default:
        for (CanFrame& asked : asked_) {
          if (asked.size != 0 && choices_.below(4) != 3) answer(asked);
        }
    }
  }

  /// As a device would that is there; sometimes something else.
  void answer(CanFrame& asked) {
    const CanFrame request = asked;
    asked.size = 0;
    FixedBytes<8> bytes{static_cast<std::uint8_t>(request.data[0])};
    const std::uint8_t kind = well_behaved_ ? 15 : choices_.below(16);
    if ((request.data[0] & 0x80u) != 0) {
      bytes.push_back(static_cast<std::uint8_t>(0xC0u | request.data[1]));
      bytes.push_back(kind == 0 ? 1 : 0);
    } else if (kind == 0) {
      for (const std::uint8_t byte : {std::uint8_t{0x94}, choices_.byte(), choices_.byte()}) bytes.push_back(byte);
    } else {
      bytes.push_back(request.data[1] | 0x80u);
      const std::size_t mac = request.id >> 3u & 7u;
      const std::uint16_t value = kind == 1 ? choices_.byte() : valueOf(request, mac);
      if (request.data[1] == 0x4B) bytes.push_back(0);
      if (request.data[1] == 0x0E || request.data[1] == 0x10) {
        bytes.push_back(static_cast<std::uint8_t>(value));
        bytes.push_back(static_cast<std::uint8_t>(value >> 8u));
      }
    }
    hear(dataFrame((request.id & ~7u) | 3u, bytes));
  }
  static std::uint16_t valueOf(const CanFrame& request, std::size_t mac) {
    constexpr std::uint16_t kSizes[] = {0, 5, 33, 10, 8, 0, 0, 0};
    if (request.data[2] == 1 && request.data[4] == 1) return 389;
    if (request.data[2] != 5) return 2;
    if (request.data[4] == 7 || request.data[4] == 8) return kSizes[mac];
    return request.data[4] == 1 ? 3 : 25;
  }

  void takeAnswers() override {
    while (const auto event = scanner_.pollEvent()) fuzz::require(event->node < 4 || event->node == kNoNode);
    while (const auto answer = scanner_.pollAnswer()) {
      fuzz::require(pending_ > 0 && answer->node < 4);
      --pending_;
    }
  }

  void checkEnd() override {
    for (std::size_t i = 0; i < scanner_.nodeCount(); ++i) {
      const NodeStatus& status = scanner_.status(i);
      fuzz::require(status.state != NodeState::kRefused || !status.reason.empty());
      fuzz::require(status.counters.losses <= status.counters.connections);
    }
  }

  void handleSent(const CanFrame& frame) override {
    fuzz::require(!frame.remote);
    const std::size_t mac = frame.id >> 3u & 0x3Fu;
    const std::uint32_t message = frame.id & 7u;
    if (message == 5) fuzz::require(scanner_.status(mac - 1).state == NodeState::kExchanging);
    const bool acknowledge = frame.size == 3 && (frame.data[0] & 0x80u) != 0 && (frame.data[1] & 0xC0u) == 0xC0u;
    if ((message == 4 || message == 6) && !acknowledge) asked_[mac & 7u] = frame;
  }

  std::array<CanFrame, 8> asked_;  // explicit requests not answered, by MAC id
  Scanner scanner_;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Choices choices{data, size};
  const std::uint8_t options = choices.byte();
  if ((options & 0xC0u) == 0xC0u) {
    playClient(choices);
  } else {
    Game{choices, options}.play();
  }
  return 0;
}
