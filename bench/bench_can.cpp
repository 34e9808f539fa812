// What the driver adds to a bare exchange of CAN frames: SDO reads, and cycles of RPDOs, SYNC and TPDOs.
#include <memory>
#include <stdexcept>
#include <vector>

#include "can_course.h"
#include "canopen/master.h"
#include "canopen/sdo_client.h"
#include "canopen_nodes.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;
using namespace std::chrono_literals;

constexpr std::array<std::uint8_t, 4> kStandby{0x7E, 0x04, 0x00, 0x00};  // BU 0060 p. 96

class SdoReader {
 public:
  explicit SdoReader(CanEnds& ends) : line_(ends, {canopen::defaultSdoChannel(1).response_id}) {}

  void read() {
    CanFrame frame;
    client_.start(canopen::sdoRead(1, 0x2066, 1), line_.port.now());
    while (client_.pollTransmit(frame)) line_.port.send(frame);
    while (!(answer_ = client_.takeAnswer())) {
      line_.port.waitReadable(*client_.nextDeadline());
      link::ReceivedCanFrame received;
      if (line_.port.receive(received)) client_.handle(received.frame, received.at);
      client_.poll(line_.port.now());
    }
    if (answer_->number() != 103u) throw std::runtime_error("a wrong value was read");
  }

 private:
  Line line_;
  canopen::SdoClient client_{canopen::defaultSdoChannel(1), 1s};
  std::optional<canopen::SdoAnswer> answer_;
};

bool sdoReads(const Course& course) {
  const FarEnd of_driver{course.of_driver, CanopenNodes{1}}, of_bare{course.of_bare, CanopenNodes{1}};
  SdoReader reader{*of_driver.ends};
  const Bare bare{*of_bare.ends, {dataFrame(0x601, fromHex("40 66 20 01 00 00 00 00"))}, 1};
  const auto driver = [&reader] { reader.read(); };
  const auto ping_pong = [&bare] { bare.exchange(); };
  const double ratio = ratioOf(course, 5000, "SDO read", driver, ping_pong);
  return course.judge("SDO read over bare ping-pong (0.8 of its rate)", ratio, 1.0 / 0.8);
}

canopen::MasterConfig busOf(std::size_t drives) {
  canopen::MasterConfig config;
  config.sync_cob_id = 0x80;
  for (std::size_t id = 1; id <= drives; ++id) {
    canopen::NodeConfig node;
    node.id = static_cast<std::uint8_t>(id);
    node.reset = canopen::BootReset::kNone;
    node.error_control.mode = canopen::ErrorControlMode::kNone;
    canopen::PdoConfig pdo;
    pdo.transmission_type = 1;
    pdo.cob_id = static_cast<std::uint32_t>(0x200 + id);
    node.receive_pdos.push_back(pdo);
    pdo.cob_id = static_cast<std::uint32_t>(0x180 + id);
    node.transmit_pdos.push_back(pdo);
    config.nodes.push_back(node);
  }
  return canopen::completed(config);
}

/// The driver's side of a bus, turned as the transport turns it. What the transport does between two cycles (taking
/// whatever comes until the next one is due) is not timed here, and has nothing to do: only answers to SYNC come.
class CanBus {
 public:
  CanBus(CanEnds& ends, std::size_t drives)
      : master_(busOf(drives)), line_(ends, master_.receivedIds()), counts_(drives) {
    master_.restart(line_.port.now());
    for (const Instant until = line_.port.now() + 20s; !allOperational() && line_.port.now() < until;) turn(1ms);
    if (!allOperational()) throw std::runtime_error("the nodes do not become operational");
    late_ = 0;  // while they started, nobody was to answer
  }

  void cycle() {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      master_.setReceivePdo(i, 0, kStandby);
      counts_[i] = master_.transmitPdo(i, 0).count;
    }
    master_.startCycle(line_.port.now());
    turn(1s);
  }
  void check() const {
    if (!allOperational()) throw std::runtime_error("a node was lost during the measurement");
    if (late_ > 0) throw std::runtime_error("a node did not answer in time");
  }

 private:
  /// Until every node has answered the SYNC. The last answer ends it: no look whether there is more.
  void turn(Duration longest) {
    const Instant until = line_.port.now() + longest;
    Instant now = line_.port.now();
    while (true) {
      master_.poll(now);
      send();
      while (master_.pollEvent()) {
      }
      if (line_.port.waitReadable(std::min(until, master_.nextDeadline().value_or(until)))) {
        link::ReceivedCanFrame received;
        while (line_.port.receive(received)) {
          master_.handleFrame(received.frame, received.at);
          if (allAnswered()) return;
        }
      }
      now = line_.port.now();
      if (now < until) continue;
      ++late_;
      return;
    }
  }
  void send() {
    CanFrame frame;
    while (master_.pollTransmit(frame)) {
      if (line_.port.send(frame) == link::CanSend::kSent) continue;
      master_.notSent();
      return;
    }
  }
  bool allAnswered() const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (master_.transmitPdo(i, 0).count == counts_[i]) return false;
    }
    return true;
  }
  bool allOperational() const {
    for (std::size_t i = 0; i < master_.nodeCount(); ++i) {
      if (master_.status(i).state != canopen::NodeState::kOperational) return false;
    }
    return true;
  }

  canopen::Master master_;
  Line line_;
  std::vector<std::uint64_t> counts_;  // TPDOs of each node when the cycle began
  std::uint64_t late_ = 0;
};

std::vector<CanFrame> framesOf(std::size_t drives) {
  std::vector<CanFrame> frames;
  for (std::size_t id = 1; id <= drives; ++id) {
    frames.push_back(dataFrame(static_cast<std::uint32_t>(0x200 + id), kStandby));
  }
  frames.push_back(dataFrame(0x80, {}));
  return frames;
}

bool cycleOf(const Course& course, std::size_t drives) {
  const FarEnd of_driver{course.of_driver, CanopenNodes{drives}}, of_bare{course.of_bare, CanopenNodes{drives}};
  CanBus bus{*of_driver.ends, drives};
  const Bare bare{*of_bare.ends, framesOf(drives), drives};
  const auto driver = [&bus] { bus.cycle(); };
  const auto bare_cycle = [&bare] { bare.exchange(); };
  const std::string what = std::to_string(drives) + " drive(s): cycle";
  const double ratio = ratioOf(course, 5000 / (1 + drives / 4), what.c_str(), driver, bare_cycle);
  bus.check();
  return course.judge("CANopen cycle over the bare exchange of the same frames", ratio, 1.25);
}

/// Cost per drive of a full bus against one drive, and against eight.
bool manyDrivesCostNoMoreEach(const Course& course, std::size_t few, std::size_t many) {
  const FarEnd end_of_few{course.of_driver, CanopenNodes{few}}, end_of_many{course.of_bare, CanopenNodes{many}};
  CanBus bus_of_few{*end_of_few.ends, few}, bus_of_many{*end_of_many.ends, many};
  const auto cycle_few = [&] {
    for (std::size_t i = 0; i < many / few; ++i) bus_of_few.cycle();
  };
  const auto cycle_many = [&] { bus_of_many.cycle(); };
  measurePairs(course.pairs(200), kBlock, cycle_few, cycle_many);  // warm-up
  std::vector<double> ratios;
  for (int i = 0; i < course.repeats; ++i) {
    const Pair medians = measurePairs(course.pairs(600), kBlock, cycle_few, cycle_many);
    const double per_few = medians.first / static_cast<double>(many / few * few);
    const double per_many = medians.second / static_cast<double>(many);
    ratios.push_back(per_many / per_few);
    std::printf("  per drive: of %zu %.3f us, of %zu %.3f us\n", few, per_few, many, per_many);
  }
  bus_of_few.check();
  bus_of_many.check();
  return course.judge("cost per drive, the many over the few", median(ratios), 1.2);
}

bool measure(const Course& course) {
  bool kept = sdoReads(course);
  for (const std::size_t drives : {1u, 2u, 4u, 8u, 16u, 32u}) kept = cycleOf(course, drives) && kept;
  kept = manyDrivesCostNoMoreEach(course, 1, 32) && kept;
  return manyDrivesCostNoMoreEach(course, 8, 32) && kept;
}

}  // namespace

int main(int argc, char** argv) {
  return runOnCan(argc, argv, "bench_can", measure);
}
