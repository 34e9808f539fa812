#include "sim/interbus/ibs_ring.h"

#include <algorithm>
#include <numeric>

#include "sim/rule_counts.h"

namespace nord_driver::sim {

namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr Duration kStart = std::chrono::milliseconds(100);  // from a ring that is whole to words that move
constexpr std::size_t kMostWords = 256;
constexpr double kBitTime = 1.0 / 500'000.0;  // s

// P509, control word and setpoint from InterBus (BU 0070 5.1).
constexpr std::int32_t kInterbus = 5;
constexpr std::int32_t kInterbusOlderSeries = 14;

Commissioning commissioningOf(const DriveConfig& config) {
  const auto& bus = config.bus.as<IbsDriveConfig>();
  Commissioning commissioning;
  commissioning.wiring.source = config.device.isOlderSeries() ? kInterbusOlderSeries : kInterbus;
  commissioning.wiring.master_lost_fault = fault::kBusTimeout;
  commissioning.wiring.timeout_fault = fault::kBusTimeout;
  commissioning.parameters = {{507, 0, 0, static_cast<std::int32_t>(bus.ppo_type)},
                              {551, 0, 0, bus.drivecom ? 1 : 0},
                              {509, 0, 0, *commissioning.wiring.source}};
  return commissioning;
}

}  // namespace

IbsRing::IbsRing(RobotSim& robot) : robot_(robot) {
  const std::size_t count = robot_.drives().size();
  std::vector<std::size_t> ring(count);
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  std::sort(ring.begin(), ring.end(), [&](std::size_t a, std::size_t b) {
    return robot_.drive(a).config().address < robot_.drive(b).config().address;
  });
  of_drive_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    DriveUnit& drive = robot_.drive(ring[i]);
    of_drive_[ring[i]] = i;
    Subscriber subscriber;
    subscriber.name = drive.name();
    subscriber.module = &robot_.add(std::make_unique<IbsModule>(drive));
    subscriber.words = drive.config().bus.as<IbsDriveConfig>().ppo_type == 1 ? 2 : 4;
    drive.connect(*subscriber.module, commissioningOf(drive.config()));
    subscribers_.push_back(subscriber);
  }
  layOut(robot_.config().bus.as<IbsBusConfig>().pcp_word);
}

void IbsRing::layOut(bool pcp_word) {
  const std::size_t pcp = pcp_word ? 1 : 0;
  std::size_t next_input = 0, next_output = 0, bytes = 0;
  for (std::size_t i = 0; i < subscribers_.size(); ++i) {
    Subscriber& here = subscribers_[i];
    const auto drive = std::find(of_drive_.begin(), of_drive_.end(), i) - of_drive_.begin();
    const auto& config = robot_.drive(static_cast<std::size_t>(drive)).config().bus.as<IbsDriveConfig>();
    here.input = config.input_offset.value_or(next_input) + pcp;
    here.output = config.output_offset.value_or(next_output) + pcp;
    next_input = here.input + here.words;
    next_output = here.output + here.words;
    bytes += 2 * (here.words + 1);
    inputs_.resize(std::max(inputs_.size(), next_input));
    outputs_.resize(std::max(outputs_.size(), next_output));
    for (std::size_t k = 0; k < i; ++k) {
      const Subscriber& other = subscribers_[k];
      const auto meet = [&](std::size_t a, std::size_t b) { return a < b + other.words && b < a + here.words; };
      if (!meet(here.input, other.input) && !meet(here.output, other.output)) continue;
      throw ConfigError("drives/" + here.name + ": its words lie in those of " + other.name +
                        "; expected words of its own");
    }
  }
  if (std::max(inputs_.size(), outputs_.size()) > kMostWords) {
    throw ConfigError("drives: " + std::to_string(std::max(inputs_.size(), outputs_.size())) +
                      " words; expected at most 256, as InterBus carries");
  }
  cycle_time_ = seconds(
      0.2e-3 + (13.0 * (6.0 + static_cast<double>(bytes)) + 1.5 * static_cast<double>(subscribers_.size())) * kBitTime);
}

void IbsRing::advance(Instant now) noexcept {
  if (!started_) {
    started_ = true;
    now_ = now;
    next_cycle_ = now;
    robot_.advance(now);
  }
  while (now_ < now) {
    now_ = std::min({now, now_ + kStep, std::max(next_cycle_, now_ + std::chrono::microseconds(1))});
    robot_.advance(now_);
    for (const Subscriber& subscriber : subscribers_) subscriber.module->look();
    if (now_ < next_cycle_) continue;
    next_cycle_ = now_ + cycle_time_;
    cycle();
  }
}

void IbsRing::masterBegins() noexcept {
  for (const Subscriber& subscriber : subscribers_) subscriber.module->masterBegins();
}

bool IbsRing::mayRun() const noexcept {
  return !cut_ && std::all_of(subscribers_.begin(), subscribers_.end(), [](const Subscriber& subscriber) {
    return subscriber.module->powered() && subscriber.module->identity() == subscriber.module->expected();
  });
}

void IbsRing::cycle() noexcept {
  const bool broken = cut_ || std::any_of(subscribers_.begin(), subscribers_.end(),
                                          [](const Subscriber& subscriber) { return subscriber.module->breaksRing(); });
  if (runs_ && broken) {
    runs_ = false;
    for (const Subscriber& subscriber : subscribers_) subscriber.module->ringStops();
  }
  if (!runs_) {
    if (!mayRun()) may_start_ = now_ + kStart;
    if (now_ < may_start_) return;
    runs_ = true;
    for (const Subscriber& subscriber : subscribers_) subscriber.module->ringStarts();
  }
  ++cycles_;
  for (const Subscriber& subscriber : subscribers_) {
    IbsWords words{};
    for (std::size_t i = 0; i < subscriber.words; ++i) words[i] = outputs_[subscriber.output + i];
    words = subscriber.module->exchange(words);
    for (std::size_t i = 0; i < subscriber.words; ++i) inputs_[subscriber.input + i] = words[i];
  }
}

std::string IbsRing::report() const {
  std::string text;
  for (const Subscriber& subscriber : subscribers_) {
    const std::uint64_t zeros = subscriber.module->countersOf(0).zero_control_words;
    if (zeros == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string("control word without bit 10 to ") + subscriber.name + ": " +
            std::to_string(zeros);
  }
  return text.empty() ? kNoRuleBroken : text;
}

}  // namespace nord_driver::sim
