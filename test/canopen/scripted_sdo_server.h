// An SDO server for tests, written from CiA 301 7.2.4.3 and sharing nothing with the client: expedited, segmented and
// block transfers of whatever is in `objects`.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace nord_driver::canopen {

class ScriptedSdoServer {
 public:
  using Frame = std::array<std::uint8_t, 8>;
  using Frames = std::vector<Frame>;
  using Bytes = std::vector<std::uint8_t>;

  std::map<std::uint32_t, Bytes> objects;  ///< by index << 8 | sub-index
  bool blocks = true;                      ///< knows block transfers
  bool checks = true;                      ///< knows the check sum
  bool tells_size = true;
  std::uint8_t block_size = 20;  ///< of block downloads

  Frames handle(const Frame& request) {
    if (request[0] == 0x80) return reset();
    if (phase_ == Phase::kBlockDownload) return takeBlock(request);
    switch (request[0] >> 5) {
      case 0:
        return takeSegment(request);
      case 1:
        return beginDownload(request);
      case 2:
        return beginUpload(request);
      case 3:
        return giveSegment(request);
      case 5:
        return blockUpload(request);
      case 6:
        return blockDownload(request);
      default:
        return abort(0x05040001);
    }
  }

 private:
  enum class Phase { kIdle, kUpload, kDownload, kBlockUpload, kBlockDownload, kBlockEnd };

  Frames reset() {
    phase_ = Phase::kIdle;
    return {};
  }
  Frames abort(std::uint32_t code) {
    phase_ = Phase::kIdle;
    return {withObject(0x80, code)};
  }
  Frame withObject(unsigned first, std::uint32_t value) const {
    return {byte(first), byte(object_ >> 8), byte(object_ >> 16), byte(object_),
            byte(value), byte(value >> 8),   byte(value >> 16),   byte(value >> 24)};
  }
  static std::uint8_t byte(std::uint32_t value) { return static_cast<std::uint8_t>(value & 0xFFu); }
  void select(const Frame& request) {
    object_ = static_cast<std::uint32_t>(request[2]) << 16 | static_cast<std::uint32_t>(request[1]) << 8 | request[3];
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(data_.size()); }

  Frames beginUpload(const Frame& request) {
    select(request);
    if (objects.count(object_) == 0) return abort(0x06020000);
    data_ = objects[object_];
    if (!data_.empty() && size() <= 4) {
      Frame answer = withObject(0x43u | (4 - size()) << 2, 0);
      for (std::size_t i = 0; i < data_.size(); ++i) answer[4 + i] = data_[i];
      phase_ = Phase::kIdle;
      return {answer};
    }
    position_ = 0;
    toggle_ = 0;
    phase_ = Phase::kUpload;
    return {tells_size ? withObject(0x41, size()) : withObject(0x40, 0)};
  }
  Frames giveSegment(const Frame& request) {
    if (phase_ != Phase::kUpload) return abort(0x05040001);
    if ((request[0] & 0x10u) != toggle_) return abort(0x05030000);
    Frame answer{};
    const std::size_t count = std::min<std::size_t>(7, data_.size() - position_);
    for (std::size_t i = 0; i < count; ++i) answer[1 + i] = data_[position_ + i];
    position_ += count;
    const bool last = position_ == data_.size();
    answer[0] = byte(static_cast<std::uint32_t>(toggle_ | (7 - count) << 1 | (last ? 1u : 0u)));
    toggle_ ^= 0x10u;
    if (last) phase_ = Phase::kIdle;
    return {answer};
  }

  Frames beginDownload(const Frame& request) {
    select(request);
    if ((request[0] & 0x02u) != 0) {
      objects[object_] = Bytes(request.begin() + 4, request.end() - (request[0] >> 2 & 3u));
      phase_ = Phase::kIdle;
    } else {
      data_.clear();
      toggle_ = 0;
      phase_ = Phase::kDownload;
    }
    return {withObject(0x60, 0)};
  }
  Frames takeSegment(const Frame& request) {
    if (phase_ != Phase::kDownload) return abort(0x05040001);
    if ((request[0] & 0x10u) != toggle_) return abort(0x05030000);
    data_.insert(data_.end(), request.begin() + 1, request.end() - (request[0] >> 1 & 7u));
    Frame answer{};
    answer[0] = byte(0x20u | toggle_);
    toggle_ ^= 0x10u;
    if ((request[0] & 1u) != 0) {
      objects[object_] = data_;
      phase_ = Phase::kIdle;
    }
    return {answer};
  }

  Frames blockUpload(const Frame& request) {
    if ((request[0] & 3u) == 0) {
      select(request);
      if (!blocks) return abort(0x05040001);
      if (objects.count(object_) == 0) return abort(0x06020000);
      if (objects[object_].size() <= request[5]) return beginUpload(request);
      data_ = objects[object_];
      position_ = 0;
      upload_block_ = request[4];
      phase_ = Phase::kBlockUpload;
      return {withObject(0xC0u | (checks ? 4u : 0u) | (tells_size ? 2u : 0u), tells_size ? size() : 0)};
    }
    if (phase_ == Phase::kBlockEnd) return reset();
    if (phase_ != Phase::kBlockUpload) return abort(0x05040001);
    if ((request[0] & 3u) == 3) return block();
    if (request[1] > sent_) return abort(0x05040003);
    position_ += std::size_t{7} * request[1];
    upload_block_ = request[2];
    if (position_ < data_.size()) return block();
    Frame end{};
    const std::uint32_t crc = checks ? checkSum(data_) : 0;
    end[0] = byte(static_cast<std::uint32_t>(0xC1u | (position_ - data_.size()) << 2));
    end[1] = byte(crc);
    end[2] = byte(crc >> 8);
    phase_ = Phase::kBlockEnd;
    return {end};
  }
  Frames block() {
    Frames segments;
    for (std::size_t at = position_; at < data_.size() && segments.size() < upload_block_; at += 7) {
      Frame segment{};
      for (std::size_t i = 0; i < 7 && at + i < data_.size(); ++i) segment[1 + i] = data_[at + i];
      segment[0] = byte(static_cast<std::uint32_t>(segments.size() + 1) | (at + 7 >= data_.size() ? 0x80u : 0u));
      segments.push_back(segment);
    }
    sent_ = segments.size();
    return segments;
  }

  Frames blockDownload(const Frame& request) {
    if ((request[0] & 1u) == 0) {
      select(request);
      if (!blocks) return abort(0x05040001);
      data_.clear();
      in_order_ = 0;
      all_ = false;
      phase_ = Phase::kBlockDownload;
      return {withObject(checks ? 0xA4 : 0xA0, block_size)};
    }
    if (phase_ != Phase::kBlockEnd) return abort(0x05040001);
    data_.resize(data_.size() - (request[0] >> 2 & 7u));
    const std::uint32_t crc = static_cast<std::uint32_t>(request[1] | request[2] << 8);
    if (checks && crc != checkSum(data_)) return abort(0x05040004);
    objects[object_] = data_;
    phase_ = Phase::kIdle;
    return {Frame{0xA1}};
  }
  Frames takeBlock(const Frame& request) {
    const unsigned number = request[0] & 0x7Fu;
    const bool last = (request[0] & 0x80u) != 0;
    if (number == in_order_ + 1) {
      data_.insert(data_.end(), request.begin() + 1, request.end());
      in_order_ = number;
      all_ = last;
    }
    if (!last && number < block_size) return {};
    const Frame answer{0xA2, byte(in_order_), block_size};
    in_order_ = 0;
    if (all_) phase_ = Phase::kBlockEnd;
    return {answer};
  }

  static std::uint32_t checkSum(const Bytes& bytes) {
    std::uint32_t sum = 0;
    for (const std::uint8_t value : bytes) {
      for (unsigned bit = 0x80; bit != 0; bit >>= 1) {
        const bool out = ((sum >> 15 & 1u) != 0) != ((value & bit) != 0);
        sum = (sum << 1 & 0xFFFFu) ^ (out ? 0x1021u : 0u);
      }
    }
    return sum;
  }

  Phase phase_ = Phase::kIdle;
  std::uint32_t object_ = 0;
  Bytes data_;
  std::size_t position_ = 0;
  unsigned toggle_ = 0;
  std::size_t sent_ = 0;
  std::uint8_t upload_block_ = 0;
  unsigned in_order_ = 0;
  bool all_ = false;
};

}  // namespace nord_driver::canopen
