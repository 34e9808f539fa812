// How long 100 parameters of a drive take to be read, over each parameter channel, against what the wire and the drive
// take: in simulated time, the whole driver below ROS on the simulator.
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "measure.h"
#include "system/can_robot.h"
#include "system/devicenet_robot.h"
#include "system/interbus_robot.h"
#include "system/simulated_robot.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;
using namespace nord_driver::test;
using namespace std::chrono_literals;

constexpr std::size_t kReads = 100;
constexpr std::size_t kAtOnce = 4;  // requests of a drive that wait, as those of several who ask
constexpr double kCycleRate = 100.0;
constexpr Duration kCycle = 10ms;

/// 100 different places: parameters in the order of their numbers, every set and element of each.
std::vector<profile::ParameterRequest> placesOf(const sim::Device& device) {
  using Shape = profile::ParameterShape;
  std::vector<profile::ParameterRequest> places;
  for (const sim::ParameterDefinition& definition : sim::parameterDefinitions(device)) {
    const bool array = definition.elements > 0;
    profile::ParameterRequest request;
    request.number = definition.number;
    request.shape = array ? Shape::kArray : Shape::kPlain;
    if (definition.per_set) request.shape = array ? Shape::kArrayPerSet : Shape::kPerSet;
    for (unsigned place = 0; place < (definition.per_set ? 4u : 1u) * std::max(definition.elements, std::uint8_t{1});
         ++place) {
      request.parameter_set = static_cast<std::uint8_t>(definition.per_set ? place % 4 + 1 : 1);
      request.index = static_cast<std::uint8_t>(definition.per_set ? place / 4 + 1 : place + 1);
      places.push_back(request);
      if (places.size() == kReads) return places;
    }
  }
  return places;
}

/// Reads them all of the first `drives` drives, side by side; 0 when one could not be read.
Duration read(DrivenRobot& robot, const std::vector<profile::ParameterRequest>& places, std::size_t drives,
              std::size_t at_once) {
  struct Asker {
    std::size_t asked = 0, done = 0;
  };
  std::vector<Asker> askers(drives);
  std::uint32_t id = 1'000'000;
  std::vector<DriveIndex> drive_of;  // by id
  std::size_t seen = robot.completions().size();
  std::size_t open = drives * places.size();
  const std::uint32_t first = id;
  const Instant start = robot.transport().now();
  Instant last = start;
  while (open > 0 && robot.transport().now() < start + 10min) {
    for (DriveIndex i = 0; i < drives; ++i) {
      while (askers[i].asked < places.size() && askers[i].asked - askers[i].done < at_once) {
        cycle::Request request;
        request.id = id++;
        request.kind = cycle::RequestKind::kReadParameter;
        request.drive = i;
        request.patience = 1min;
        request.parameter = places[askers[i].asked++];
        drive_of.push_back(i);
        robot.ports().submit(request);
      }
    }
    robot.step();
    for (; seen < robot.completions().size(); ++seen) {
      const cycle::Completion& answer = robot.completions()[seen];
      if (answer.id < first) continue;
      if (!answer.success) {
        std::printf("  not read: %s\n", answer.message.c_str());
        return Duration::zero();
      }
      ++askers[drive_of[answer.id - first]].done;
      last = robot.transport().now();
      --open;
    }
  }
  return open == 0 ? last - start : Duration::zero();
}

double milliseconds(Duration span) {
  return toSeconds(span) * 1e3;
}

constexpr double kBound = 1.1, kSideBySide = 1.2;

/// `floor`: of one read.
bool judge(const char* channel, Duration took, Duration floor, double bound) {
  const Duration each = took / kReads;
  std::printf("  %s: %.2f ms for a parameter, floor %.2f ms\n", channel, milliseconds(each), milliseconds(floor));
  return report((std::string(channel) + ": 100 parameters over their floor").c_str(),
                toSeconds(each) / toSeconds(floor), "", bound) &&
         took > Duration::zero();
}

bool judgeFour(const char* channel, Duration four, Duration one, double bound) {
  return report((std::string(channel) + ": four drives side by side over one alone").c_str(),
                toSeconds(four) / toSeconds(one), "", bound) &&
         four > Duration::zero();
}

template <typename Robot>
Duration measure(Robot& robot, std::size_t drives, const std::function<void(Robot&)>& before = {}) {
  if (!robot.bringUp()) return Duration::zero();
  robot.run(2s);
  if (before) before(robot);
  const auto places = placesOf(robot.unit(0).parameters().device());
  const Duration took = read(robot, places, drives, kAtOnce);
  if (drives == 1) {
    std::printf("  each asked for when the one before is answered: %.2f ms\n",
                milliseconds(read(robot, places, 1, 1)) / kReads);
  }
  return took;
}

// One telegram in each bus cycle: the cycle is the wire of this channel. An order goes out, waits one telegram
// (PkwSettings::delay), its answer comes with the telegram after that (BU 0020 7.4), and "no order" stands between it and
// the next order (BU 2700 6.5).
bool pkw() {
  SimulatedRobot::Options options;
  options.node["cycle_rate"] = kCycleRate;
  options.wheels_a_side = 2;
  SimulatedRobot alone{options};
  const Duration one = measure(alone, 1);
  SimulatedRobot beside{options};
  const Duration four = measure(beside, 4);
  const bool kept = judge("PKW", one, 4 * kCycle, kBound);
  return judgeFour("PKW", four, one, kSideBySide) && kept;
}

// The master sends one acyclic telegram in each bus cycle. Two records, each with its request, one poll that finds
// nothing yet (RecordSettings::polls) and the one that fetches the response.
bool ms1() {
  SimulatedRobot::Options options;
  options.node["cycle_rate"] = kCycleRate;
  options.one_module = true;
  options.drives["ppo_type"] = 3;
  SimulatedRobot robot{options};
  return judge("MS1", measure(robot, 1), 6 * kCycle, kBound);
}

/// What the wire shows of questions and answers: how long their frames are on the bus, and how long the far end takes. It
/// looks at the questions in steps of its own, so that an answer comes later than its settings say.
class Dialogue {
 public:
  /// `at`: the end of a frame of node `node`.
  void question(unsigned node, Duration on_wire, Instant at) {
    count(on_wire);
    asked_[node] = at;
  }
  void answer(unsigned node, Duration on_wire, Instant at) {
    count(on_wire);
    if (asked_[node] == Instant{}) return;
    answering_ += at - asked_[node];
    ++answers_;
    asked_[node] = {};
  }

  Duration frame() const { return frames_ == 0 ? Duration::zero() : on_wire_ / frames_; }
  /// Of one read: its question, and from the end of that to the end of the answer.
  Duration floor() const { return answers_ == 0 ? Duration::zero() : frame() + answering_ / answers_; }

 private:
  void count(Duration on_wire) {
    on_wire_ += on_wire;
    ++frames_;
  }

  std::array<Instant, 128> asked_{};
  Duration on_wire_{}, answering_{};
  int frames_ = 0, answers_ = 0;
};

constexpr int kOthers = 3;  // drives beside the one

/// The same wire carries a question and an answer of each of the others meanwhile.
bool judgeOnOneWire(const char* channel, Duration one, Duration four, const Dialogue& alone) {
  const bool kept = judge(channel, one, alone.floor(), kBound);
  std::printf("  %s: four drives side by side take %.2f of one alone\n", channel, toSeconds(four) / toSeconds(one));
  const Duration floor = alone.floor() + 2 * kOthers * alone.frame();
  return judge((std::string(channel) + ", four side by side").c_str(), four, floor, kBound) && kept;
}

bool sdo() {
  const auto run = [](std::size_t drives, Dialogue& dialogue) {
    CanRobot::Options options;
    options.node["cycle_rate"] = kCycleRate;
    options.nodes = 4;
    CanRobot robot{options};
    return measure<CanRobot>(robot, drives, [&dialogue](CanRobot& on) {
      sim::SimulatedCanBus& bus = on.bus();
      bus.setTap([&bus, &dialogue](const CanFrame& frame, sim::TimedCanBus::Sender, Instant at) {
        if (frame.id < 0x580 || frame.id >= 0x680) return;
        const unsigned node = frame.id & 0x7Fu;
        if (frame.id >= 0x600) {
          dialogue.question(node, bus.frameTime(frame), at);
        } else {
          dialogue.answer(node, bus.frameTime(frame), at);
        }
      });
    });
  };
  Dialogue dialogue, of_four;
  const Duration one = run(1, dialogue);
  const Duration four = run(4, of_four);
  return judgeOnOneWire("SDO", one, four, dialogue);
}

bool explicitMessages() {
  const auto run = [](std::size_t drives, Dialogue& dialogue) {
    DevicenetRobot::Options options;
    options.node["cycle_rate"] = kCycleRate;
    options.modules = 4;
    DevicenetRobot robot{options};
    return measure<DevicenetRobot>(robot, drives, [&dialogue](DevicenetRobot& on) {
      sim::SimulatedDnBus& bus = on.bus();
      bus.setTap([&bus, &dialogue](const CanFrame& frame, sim::TimedCanBus::Sender, Instant at) {
        const unsigned message = frame.id & 0x7u, node = (frame.id >> 3u) & 0x3Fu;
        if (frame.id < 0x400 || frame.id >= 0x600) return;
        if (message == 4) dialogue.question(node, bus.frameTime(frame), at);
        if (message == 3) dialogue.answer(node, bus.frameTime(frame), at);
      });
    });
  };
  Dialogue dialogue, of_four;
  const Duration one = run(1, dialogue);
  const Duration four = run(4, of_four);
  return judgeOnOneWire("explicit messages", one, four, dialogue);
}

// Experimental, and without a bound. Four requests to the gateway: the block is cleared, seen clear, a service is
// invoked, its result read; and the ring cycles the service takes (PcpServer). The driver sends one in each bus cycle.
bool pcp() {
  InterbusRobot::Options options;
  options.node["cycle_rate"] = kCycleRate;
  options.pcp = true;
  InterbusRobot robot{options};
  Duration service{};
  const Duration one =
      measure<InterbusRobot>(robot, 1, [&service](InterbusRobot& on) { service = 16 * on.ring().cycleTime(); });
  const Duration floor = 4 * 400us + service;
  std::printf("  PCP: %.2f ms for a parameter, floor %.2f ms: %.2f, without a bound\n", milliseconds(one / kReads),
              milliseconds(floor), toSeconds(one / kReads) / toSeconds(floor));
  return one > Duration::zero();
}

}  // namespace

int main() {
  bool kept = pkw();
  kept = ms1() && kept;
  kept = sdo() && kept;
  kept = explicitMessages() && kept;
  kept = pcp() && kept;
  return kept ? 0 : 1;
}
