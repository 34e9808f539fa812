// A gateway in simulated time: it answers each output image after a while, or not at all, with what its ring makes of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "link/modbus/register_link.h"

namespace nord_driver::test {

class FakeGateway {
 public:
  struct Given {
    Instant at{};
    RegisterImage outputs;
  };

  // What it does; to be changed at any time.
  Duration delay{std::chrono::milliseconds{2}};  ///< from an image to the inputs that answer it
  bool stalled = false;                          ///< no answers until it is released, then the one under way
  bool opens = true;
  link::LinkState state = link::LinkState::kConnected;  ///< only kConnected takes images
  Sentence text;                                        ///< of the link's report
  std::uint64_t exceptions = 0;                         ///< of the link's report
  std::uint64_t refused_exchanges = 0;                  ///< of the link's report
  std::uint64_t lost = 0;                               ///< of the link's report
  bool ring_runs = true;
  Word running = 1;
  /// What the ring answers to outputs.
  std::function<RegisterImage(const RegisterImage&)> ring = [](const RegisterImage&) { return RegisterImage{}; };

  // What was done with it.
  std::vector<Given> given;
  unsigned looks = 0;  // exchanges that only read
  unsigned opened = 0;
  bool closed = false;

  Instant now() const noexcept { return now_; }

  /// None: it only reads, and the ring answers to the outputs there are.
  void give(std::uint64_t number, const std::optional<RegisterImage>& written) {
    if (written) given.push_back({now_, *written});
    const RegisterImage outputs = given.empty() ? RegisterImage{} : given.back().outputs;
    if (state != link::LinkState::kConnected) return;
    if (under_way_) {
      waiting_ = Order{number, now_, outputs};
    } else {
      under_way_ = Order{number, now_, outputs};
    }
  }
  void advance(Instant until) {
    for (auto due = nextDue(); due && *due <= until; due = nextDue()) answer(*due);
    now_ = std::max(now_, until);
  }
  /// When the answer under way comes.
  std::optional<Instant> nextDue() const {
    if (!under_way_ || stalled) return std::nullopt;
    return std::max(now_, under_way_->begun + delay);
  }
  const link::RegisterInputs& newest() const noexcept { return newest_; }

 private:
  struct Order {
    std::uint64_t number = 0;
    Instant begun{};
    RegisterImage outputs;
  };

  void answer(Instant at) {
    now_ = at;
    ++newest_.number;
    newest_.outputs = under_way_->number;
    newest_.asked = under_way_->begun;
    newest_.received = at;
    newest_.words = ring(under_way_->outputs);
    newest_.bus_runs = ring_runs;
    newest_.running = running;
    under_way_ = waiting_;
    if (under_way_) under_way_->begun = at;
    waiting_.reset();
  }

  Instant now_{std::chrono::hours{1}};
  std::optional<Order> under_way_, waiting_;
  link::RegisterInputs newest_;
};

class FakeRegisterLink final : public link::RegisterLink {
 public:
  explicit FakeRegisterLink(FakeGateway& gateway) : gateway_(gateway) {}

  bool open() noexcept override {
    ++gateway_.opened;
    return gateway_.opens;
  }
  void close() noexcept override { gateway_.closed = true; }
  std::uint64_t give(const RegisterImage& outputs) noexcept override {
    gateway_.give(++number_, outputs);
    return number_;
  }
  std::uint64_t look() noexcept override {
    ++gateway_.looks;
    gateway_.give(++number_, std::nullopt);
    return number_;
  }
  const link::RegisterInputs& take() noexcept override { return gateway_.newest(); }
  const link::LinkReport& report() noexcept override {
    report_.state = gateway_.state;
    report_.text = gateway_.text;
    report_.counters.exceptions = gateway_.exceptions;
    report_.counters.refused_exchanges = gateway_.refused_exchanges;
    report_.counters.lost = gateway_.lost;
    return report_;
  }
  bool waitAnswers(Instant until) noexcept override {
    const auto due = gateway_.nextDue();
    const bool answered = due && *due <= until;
    gateway_.advance(answered ? *due : until);
    return answered;
  }
  Instant now() const noexcept override { return gateway_.now(); }
  void sleepUntil(Instant when) noexcept override { gateway_.advance(when); }

 private:
  FakeGateway& gateway_;
  std::uint64_t number_ = 0;
  link::LinkReport report_;
};

}  // namespace nord_driver::test
