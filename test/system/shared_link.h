// A link to a simulated bus that outlives whoever uses it: a program ends, and the drives stay as it left them.
#pragma once

#include <limits>

#include "link/can/can_link.h"
#include "link/modbus/register_link.h"
#include "link/serial/byte_link.h"

namespace nord_driver::test {

/// What is sent is counted, and after a given number of telegrams the adapter is pulled out.
class CutAfter {
 public:
  static constexpr unsigned kNever = std::numeric_limits<unsigned>::max();

  void set(unsigned telegrams) noexcept {
    left_ = telegrams;
    sent_ = 0;
  }
  /// One more is to be sent: true when it is the one.
  bool cutsNow() noexcept {
    ++sent_;
    return left_ != kNever && sent_ == left_;
  }
  unsigned sent() const noexcept { return sent_; }

 private:
  unsigned left_ = kNever;
  unsigned sent_ = 0;
};

template <typename Segment>
class SharedByteLink final : public link::ByteLink {
 public:
  SharedByteLink(Segment& segment, CutAfter& cut) : segment_(segment), cut_(cut) {}
  ~SharedByteLink() override { segment_.close(); }
  SharedByteLink(const SharedByteLink&) = delete;
  SharedByteLink& operator=(const SharedByteLink&) = delete;

  bool open() noexcept override { return segment_.open(); }
  void close() noexcept override { segment_.close(); }
  bool isOpen() const noexcept override { return segment_.isOpen(); }
  bool write(ByteView telegram) noexcept override {
    if (cut_.cutsNow()) segment_.setDevicePresent(false);
    return segment_.write(telegram);
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    return segment_.read(buffer, capacity);
  }
  void discardInput() noexcept override { segment_.discardInput(); }
  bool waitReadable(Instant until) noexcept override { return segment_.waitReadable(until); }
  void sleepUntil(Instant when) noexcept override { segment_.sleepUntil(when); }
  Instant now() const noexcept override { return segment_.now(); }
  bool keepsBaudRate() const noexcept override { return segment_.keepsBaudRate(); }
  const std::string& lastError() const noexcept override { return segment_.lastError(); }

 private:
  Segment& segment_;
  CutAfter& cut_;
};

template <typename Bus>
class SharedCanLink final : public link::CanLink {
 public:
  SharedCanLink(Bus& bus, CutAfter& cut) : bus_(bus), cut_(cut) {}
  ~SharedCanLink() override { bus_.close(); }
  SharedCanLink(const SharedCanLink&) = delete;
  SharedCanLink& operator=(const SharedCanLink&) = delete;

  bool open() noexcept override { return bus_.open(); }
  void close() noexcept override { bus_.close(); }
  bool isOpen() const noexcept override { return bus_.isOpen(); }
  link::CanSend send(const CanFrame& frame) noexcept override {
    if (cut_.cutsNow()) bus_.setInterfacePresent(false);
    return bus_.send(frame);
  }
  bool receive(link::ReceivedCanFrame& received) noexcept override { return bus_.receive(received); }
  bool waitReadable(Instant until) noexcept override { return bus_.waitReadable(until); }
  bool waitWritable(Instant until) noexcept override { return bus_.waitWritable(until); }
  void sleepUntil(Instant when) noexcept override { bus_.sleepUntil(when); }
  Instant now() const noexcept override { return bus_.now(); }
  link::CanState state() const noexcept override { return bus_.state(); }
  link::CanCounters counters() const noexcept override { return bus_.counters(); }
  const std::string& lastError() const noexcept override { return bus_.lastError(); }
  const char* advice() const noexcept override { return bus_.advice(); }

 private:
  Bus& bus_;
  CutAfter& cut_;
};

template <typename Gateway>
class SharedRegisterLink final : public link::RegisterLink {
 public:
  explicit SharedRegisterLink(Gateway& gateway) : gateway_(gateway) {}
  ~SharedRegisterLink() override { gateway_.close(); }
  SharedRegisterLink(const SharedRegisterLink&) = delete;
  SharedRegisterLink& operator=(const SharedRegisterLink&) = delete;

  bool open() noexcept override { return gateway_.open(); }
  void close() noexcept override { gateway_.close(); }
  std::uint64_t give(const RegisterImage& outputs) noexcept override { return gateway_.give(outputs); }
  std::uint64_t look() noexcept override { return gateway_.look(); }
  std::uint64_t order(const link::RegisterOrder& order) noexcept override { return gateway_.order(order); }
  const link::RegisterAnswer& answer() noexcept override { return gateway_.answer(); }
  const link::RegisterInputs& take() noexcept override { return gateway_.take(); }
  const link::LinkReport& report() noexcept override { return gateway_.report(); }
  bool waitAnswers(Instant until) noexcept override { return gateway_.waitAnswers(until); }
  Instant now() const noexcept override { return gateway_.now(); }
  void sleepUntil(Instant when) noexcept override { gateway_.sleepUntil(when); }

 private:
  Gateway& gateway_;
};

}  // namespace nord_driver::test
