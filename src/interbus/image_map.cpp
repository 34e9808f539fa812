#include "interbus/image_map.h"

#include <algorithm>
#include <numeric>

namespace nord_driver::interbus {

namespace {

constexpr unsigned kRegisters = 65536;  // a Modbus server has

std::string wordsText(WordRange range) {
  return std::to_string(range.first) + " to " + std::to_string(range.end() - 1);
}

// The places in `ranges`, in the order of their words.
std::vector<std::size_t> byOffset(const std::vector<WordRange>& ranges) {
  std::vector<std::size_t> order(ranges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ranges[a].first < ranges[b].first; });
  return order;
}

std::vector<WordRange> parts(const std::vector<WordRange>& ranges, std::size_t most) {
  std::vector<WordRange> found;
  for (const std::size_t i : byOffset(ranges)) {
    const WordRange& range = ranges[i];
    if (!found.empty() && range.end() - found.back().first <= most) {
      found.back().count = static_cast<std::uint16_t>(range.end() - found.back().first);
    } else {
      found.push_back(range);
    }
  }
  return found;
}

/// One direction of the image while it is laid out: "input" or "output".
struct Side {
  const char* name;
  std::optional<unsigned> DriveImage::*offset;
  unsigned address;
  std::vector<WordRange> ranges{};

  bool layOut(const ImageSettings& settings, const std::vector<std::size_t>& ring, std::string& reason);
  bool check(const std::vector<DriveImage>& drives, std::string& reason) const;
};

bool Side::layOut(const ImageSettings& settings, const std::vector<std::size_t>& ring, std::string& reason) {
  ranges.resize(settings.drives.size());
  unsigned next = 0;
  for (const std::size_t i : ring) {
    const DriveImage& drive = settings.drives[i];
    const unsigned first = (drive.*offset).value_or(next);
    const unsigned count = (settings.pcp_word ? 1u : 0u) + (drive.ppo_type == 1 ? 2u : 4u);
    if (first >= kMostImageWords || first + count > kMostImageWords) {
      reason = "drives/" + drive.name + ": its " + std::to_string(count) + " " + name + " words begin at word " +
               std::to_string(first) + " of the image, expected all within the " + std::to_string(kMostImageWords) +
               " words InterBus carries (0 to " + std::to_string(kMostImageWords - 1) + ")";
      return false;
    }
    ranges[i] = {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(count)};
    next = first + count;
  }
  return check(settings.drives, reason);
}

bool Side::check(const std::vector<DriveImage>& drives, std::string& reason) const {
  const std::vector<std::size_t> order = byOffset(ranges);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t before = order[i - 1], here = order[i];
    if (ranges[here].first >= ranges[before].end()) continue;
    reason = "drives/" + drives[here].name + ": its " + name + " words " + wordsText(ranges[here]) +
             " lie in those of " + drives[before].name + ", " + wordsText(ranges[before]) + "; expected " + name +
             "_offset " + std::to_string(ranges[before].end()) + " or higher, or one that ends before";
    return false;
  }
  const unsigned last = address + ranges[order.back()].end() - 1;
  if (last < kRegisters) return true;
  reason = std::string("bus/") + name + "s/address: the image from register " + std::to_string(address) +
           " on ends at register " + std::to_string(last) + ", expected at most " + std::to_string(kRegisters - 1);
  return false;
}

bool checkDrive(const DriveImage& drive, std::string& reason) {
  if (drive.position < 1 || drive.position > kHighestPosition) {
    reason = "drives/" + drive.name + "/address: " + std::to_string(drive.position) +
             ", expected a position in the ring from 1 to " + std::to_string(kHighestPosition);
    return false;
  }
  if (drive.ppo_type == 1 || drive.ppo_type == 2) return true;
  reason = "drives/" + drive.name + "/ppo_type: " + std::to_string(drive.ppo_type) +
           ", expected 1 (control word and setpoint 1) or 2 (and setpoints 2 and 3); InterBus has no others";
  return false;
}

}  // namespace

std::optional<ImageMap> ImageMap::make(const ImageSettings& settings, std::string& reason) {
  const std::vector<DriveImage>& drives = settings.drives;
  if (drives.empty()) {
    reason = "drives: none, expected at least one";
    return std::nullopt;
  }
  std::vector<std::size_t> ring(drives.size());
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  std::stable_sort(ring.begin(), ring.end(),
                   [&](std::size_t a, std::size_t b) { return drives[a].position < drives[b].position; });
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const DriveImage& drive = drives[ring[i]];
    if (!checkDrive(drive, reason)) return std::nullopt;
    if (i == 0 || drives[ring[i - 1]].position != drive.position) continue;
    reason = "drives/" + drive.name + "/address: " + std::to_string(drive.position) + " is also that of " +
             drives[ring[i - 1]].name + ", expected a position in the ring of its own";
    return std::nullopt;
  }
  Side in{"input", &DriveImage::input_offset, settings.input_address};
  Side out{"output", &DriveImage::output_offset, settings.output_address};
  if (!in.layOut(settings, ring, reason) || !out.layOut(settings, ring, reason)) return std::nullopt;

  ImageMap map;
  map.byte_order_ = settings.byte_order;
  map.pcp_words_ = settings.pcp_word ? 1 : 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::size_t values = drives[i].ppo_type == 1 ? 1 : kMostValues;
    map.drives_.push_back({in.ranges[i], out.ranges[i], drives[i].value_order, values});
    map.input_words_ = std::max<std::size_t>(map.input_words_, in.ranges[i].end());
    map.output_words_ = std::max<std::size_t>(map.output_words_, out.ranges[i].end());
  }
  return map;
}

Word ImageMap::inImage(Word word) const noexcept {
  return byte_order_ == ByteOrder::kAsIs ? word : static_cast<Word>(word << 8 | word >> 8);
}

std::size_t ImageMap::wireIndex(const Place& place, std::size_t value) const noexcept {
  const std::size_t swapped = value == 0 ? 0 : kMostValues - value;
  const bool is_swapped = place.values == kMostValues && place.value_order == ValueOrder::kThreeBeforeTwo;
  return pcp_words_ + 1 + (is_swapped ? swapped : value);
}

void ImageMap::put(std::size_t drive, const ProcessWords& words, RegisterImage& outputs) const noexcept {
  const Place& place = drives_[drive];
  if (outputs.size() < place.outputs.end()) return;
  if (pcp_words_ != 0) outputs[place.outputs.first] = 0;
  outputs[place.outputs.first + pcp_words_] = inImage(words.head);
  for (std::size_t i = 0; i < place.values; ++i) {
    outputs[place.outputs.first + wireIndex(place, i)] = inImage(words.values[i]);
  }
}

ProcessWords ImageMap::get(std::size_t drive, const RegisterImage& inputs) const noexcept {
  return wordsAt(drives_[drive].inputs, drive, inputs);
}

ProcessWords ImageMap::wordsAt(WordRange range, std::size_t drive, const RegisterImage& image) const noexcept {
  const Place& place = drives_[drive];
  ProcessWords words;
  if (image.size() < range.end()) return words;
  words.head = inImage(image[range.first + pcp_words_]);
  for (std::size_t i = 0; i < place.values; ++i) words.values[i] = inImage(image[range.first + wireIndex(place, i)]);
  return words;
}

WordMeaning ImageMap::inputMeaning(std::size_t word) const noexcept {
  for (std::size_t drive = 0; drive < drives_.size(); ++drive) {
    const Place& place = drives_[drive];
    if (word < place.inputs.first || word >= place.inputs.end()) continue;
    const std::size_t at = word - place.inputs.first;
    for (std::size_t value = 0; value < place.values; ++value) {
      if (wireIndex(place, value) == at) return {WordKind::kValue, drive, static_cast<unsigned>(value) + 1};
    }
    return {at < pcp_words_ ? WordKind::kPcp : WordKind::kHead, drive, 0};
  }
  return {};
}

std::vector<WordRange> ImageMap::inputParts(std::size_t most) const {
  std::vector<WordRange> ranges;
  for (const Place& place : drives_) ranges.push_back(place.inputs);
  return parts(ranges, most);
}

std::vector<WordRange> ImageMap::outputParts(std::size_t most) const {
  std::vector<WordRange> ranges;
  for (const Place& place : drives_) ranges.push_back(place.outputs);
  return parts(ranges, most);
}

std::vector<WordRange> ImageMap::unclaimedOutputs(std::size_t most) const {
  std::vector<WordRange> found;
  for (const WordRange& part : outputParts(most)) {
    unsigned next = part.first;
    std::vector<WordRange> ranges;
    for (const Place& place : drives_) {
      if (place.outputs.first >= part.first && place.outputs.end() <= part.end()) ranges.push_back(place.outputs);
    }
    for (const std::size_t i : byOffset(ranges)) {
      if (ranges[i].first > next) {
        found.push_back({static_cast<std::uint16_t>(next), static_cast<std::uint16_t>(ranges[i].first - next)});
      }
      next = ranges[i].end();
    }
  }
  return found;
}

std::vector<std::uint16_t> ImageMap::controlWords() const {
  std::vector<std::uint16_t> found;
  for (const Place& place : drives_) found.push_back(static_cast<std::uint16_t>(place.outputs.first + pcp_words_));
  return found;
}

}  // namespace nord_driver::interbus
