// Every order of events: what an object can be brought to is found by breadth first search over an alphabet of events,
// until no state is new. The first way found to a state is a shortest one, so a violation is told as the shortest
// sequence of events that shows it.
//
// A model is a class with
//   struct World;                                     the object under test, its surroundings, and what they remember;
//                                                     copied for every event
//   World initial() const;
//   std::size_t events() const;                       the alphabet
//   std::string name(std::size_t event) const;
//   bool apply(World&, std::size_t event, Verdict&);  false: this event cannot come now
//   void describe(const World&, Key&) const;          all that decides on what can come of it; equal keys are one state
//   void judge(const World&, Verdict&) const;         once for every new state: what must be possible from it
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iostream>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/timer_table.h"
#include "nord_driver/core/time.h"

namespace nord_driver::explore {

/// What tells one state from another, as bytes.
class Key {
 public:
  template <typename Value>
  Key& add(Value value) {
    auto rest = static_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < sizeof(Value); ++i, rest >>= 8) bytes_.push_back(static_cast<char>(rest & 0xFFu));
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A property that does not hold, in words; the first one stays.
class Verdict {
 public:
  void require(bool holds, const char* property) {
    if (!holds && problem_.empty()) problem_ = property;
  }
  bool holds() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }

 private:
  std::string problem_;
};

/// Whole ticks from `since` to `now`, at most `most`. A time is told from another only as far as something waits for it,
/// so that the states are finitely many: `most` is one tick more than the longest time-out that is compared with it.
inline std::uint8_t ticks(Instant since, Instant now, Duration tick, int most) {
  const Duration::rep passed = (now - since) / tick;
  return static_cast<std::uint8_t>(std::clamp<Duration::rep>(passed, 0, most));
}

/// How much of each deadline is left, at most `most` ticks.
template <typename Timer>
void describeTimers(const TimerTable<Timer>& timers, Instant now, Duration tick, int most, Key& key) {
  for (std::uint8_t i = 0; i < static_cast<std::uint8_t>(Timer::kCount); ++i) {
    const auto& at = timers.at(static_cast<Timer>(i));
    key.add(at ? ticks(now, *at, tick, most) : std::uint8_t{255});
  }
}

template <typename Model>
class Explorer {
 public:
  /// More states than that: the model is not abstract enough, or the object under test counts something for ever.
  static constexpr std::size_t kMostStates = 400'000;

  explicit Explorer(const Model& model) : model_(model) {}

  void run() {
    enter(model_.initial(), 0, 0);
    while (!frontier_.empty() && nodes_.size() < kMostStates) {
      const auto [index, world] = std::move(frontier_.front());
      frontier_.pop_front();
      for (std::size_t event = 0; event < model_.events(); ++event) {
        typename Model::World next = world;
        Verdict verdict;
        if (!model_.apply(next, event, verdict)) continue;
        ++transitions_;
        if (verdict.holds()) {
          enter(std::move(next), index, event);
        } else {
          tell(verdict, wayTo(index) + "\n  " + model_.name(event));
        }
      }
    }
  }

  bool complete() const { return frontier_.empty(); }
  std::size_t states() const { return nodes_.size(); }
  std::size_t transitions() const { return transitions_; }
  std::size_t depth() const { return nodes_.empty() ? 0 : nodes_.back().depth; }
  /// By the property, the shortest sequence that violates it.
  const std::map<std::string, std::string>& violations() const { return violations_; }

 private:
  struct Node {
    std::size_t before = 0;
    std::size_t event = 0;
    std::size_t depth = 0;
  };

  void enter(typename Model::World world, std::size_t before, std::size_t event) {
    Key key;
    model_.describe(world, key);
    if (!known_.emplace(key.bytes(), nodes_.size()).second) return;
    const std::size_t depth = nodes_.empty() ? 0 : nodes_[before].depth + 1;
    nodes_.push_back({before, event, depth});
    const std::size_t index = nodes_.size() - 1;
    Verdict verdict;
    model_.judge(world, verdict);
    if (!verdict.holds()) tell(verdict, wayTo(index));
    frontier_.emplace_back(index, std::move(world));
  }

  void tell(const Verdict& verdict, const std::string& way) { violations_.emplace(verdict.problem(), way); }

  std::string wayTo(std::size_t index) const {
    std::string way;
    for (; index != 0; index = nodes_[index].before) way.insert(0, "\n  " + model_.name(nodes_[index].event));
    return way;
  }

  const Model& model_;
  std::unordered_map<std::string, std::size_t> known_;
  std::vector<Node> nodes_;
  std::deque<std::pair<std::size_t, typename Model::World>> frontier_;
  std::size_t transitions_ = 0;
  std::map<std::string, std::string> violations_;
};

/// Explores and judges; prints how much that was. `least`: a model that reaches less has lost events.
template <typename Model>
void exploreAll(const Model& model, const std::string& what, std::size_t least) {
  Explorer<Model> explorer(model);
  explorer.run();
  std::cout << "explored " << what << ": " << explorer.states() << " states, " << explorer.transitions()
            << " transitions, at most " << explorer.depth() << " events deep" << std::endl;
  ::testing::Test::RecordProperty("states", std::to_string(explorer.states()));
  ::testing::Test::RecordProperty("transitions", std::to_string(explorer.transitions()));
  EXPECT_TRUE(explorer.complete()) << "given up with states that were not followed";
  EXPECT_GE(explorer.states(), least);
  for (const auto& [problem, way] : explorer.violations()) ADD_FAILURE() << problem << "; shortest sequence:" << way;
}

}  // namespace nord_driver::explore
