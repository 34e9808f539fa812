// A link that remembers what went over it, in both directions.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "link/serial/byte_link.h"

namespace nord_driver::test {

class RecordingLink final : public link::ByteLink {
 public:
  explicit RecordingLink(std::unique_ptr<link::ByteLink> inner) : inner_(std::move(inner)) {}

  bool open() noexcept override { return inner_->open(); }
  void close() noexcept override { inner_->close(); }
  bool isOpen() const noexcept override { return inner_->isOpen(); }
  bool write(ByteView telegram) noexcept override {
    if (recording_) {
      sent_.push_back(toHex(telegram));
      received_.emplace_back();
    }
    return inner_->write(telegram);
  }
  std::size_t read(std::uint8_t* buffer, std::size_t capacity) noexcept override {
    const std::size_t count = inner_->read(buffer, capacity);
    if (recording_ && !received_.empty()) {
      received_.back().insert(received_.back().end(), buffer, buffer + count);
    }
    return count;
  }
  void discardInput() noexcept override { inner_->discardInput(); }
  bool waitReadable(Instant until) noexcept override { return inner_->waitReadable(until); }
  void sleepUntil(Instant when) noexcept override { inner_->sleepUntil(when); }
  Instant now() const noexcept override { return inner_->now(); }
  bool keepsBaudRate() const noexcept override { return inner_->keepsBaudRate(); }
  link::LineCounters lineCounters() const noexcept override { return inner_->lineCounters(); }
  const std::string& lastError() const noexcept override { return inner_->lastError(); }

  void record(bool on) {
    recording_ = on;
    sent_.clear();
    received_.clear();
  }
  /// Telegrams of the driver, oldest first, and what came back after each.
  const std::vector<std::string>& sent() const { return sent_; }
  std::string answerTo(std::size_t telegram) const { return toHex(ByteView{received_.at(telegram)}); }

  /// The last telegram to a station and its answer; empty when there was none.
  std::pair<std::string, std::string> lastExchange(std::uint8_t station) const {
    const std::string head = "68 0F 0F 68 " + toHex(ByteView{&station, 1}) + " ";
    for (std::size_t i = sent_.size(); i-- > 0;) {
      if (sent_[i].compare(0, head.size(), head) == 0) return {sent_[i], answerTo(i)};
    }
    return {};
  }

 private:
  std::unique_ptr<link::ByteLink> inner_;
  bool recording_ = false;
  std::vector<std::string> sent_;
  std::vector<std::vector<std::uint8_t>> received_;
};

}  // namespace nord_driver::test
