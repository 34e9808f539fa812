// A CAN link that loses all frames of one identifier on their way in, or holds its user up behind a read.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "link/can/can_link.h"

namespace nord_driver::test {

class DeafCanLink final : public link::CanLink {
 public:
  explicit DeafCanLink(std::unique_ptr<link::CanLink> inner) : inner_(std::move(inner)) {}

  /// Reads that brought nothing.
  std::size_t emptyReads() const noexcept { return empty_reads_; }
  void setDeaf(std::optional<std::uint32_t> id) noexcept { deaf_ = id; }

  /// The next read that brings nothing takes so long, and frames come meanwhile.
  void holdUp(Duration span) noexcept { hold_up_ = span; }

  bool open() noexcept override { return inner_->open(); }
  void close() noexcept override { inner_->close(); }
  bool isOpen() const noexcept override { return inner_->isOpen(); }
  link::CanSend send(const CanFrame& frame) noexcept override { return inner_->send(frame); }
  bool receive(link::ReceivedCanFrame& received) noexcept override {
    while (inner_->receive(received)) {
      if (received.frame.id != deaf_) return true;
    }
    ++empty_reads_;
    if (hold_up_ != Duration::zero()) inner_->sleepUntil(inner_->now() + std::exchange(hold_up_, Duration::zero()));
    return false;
  }
  bool waitReadable(Instant until) noexcept override { return inner_->waitReadable(until); }
  bool waitWritable(Instant until) noexcept override { return inner_->waitWritable(until); }
  void sleepUntil(Instant when) noexcept override { inner_->sleepUntil(when); }
  Instant now() const noexcept override { return inner_->now(); }
  link::CanState state() const noexcept override { return inner_->state(); }
  link::CanCounters counters() const noexcept override { return inner_->counters(); }
  const std::string& lastError() const noexcept override { return inner_->lastError(); }
  const char* advice() const noexcept override { return inner_->advice(); }

 private:
  std::unique_ptr<link::CanLink> inner_;
  std::optional<std::uint32_t> deaf_;
  std::size_t empty_reads_ = 0;
  Duration hold_up_{0};
};

}  // namespace nord_driver::test
