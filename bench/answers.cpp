#include "answers.h"

namespace nord_driver::bench {

namespace {

const std::array<std::uint8_t, 1> kShortAcknowledge{0xE5};

std::uint8_t sum(const std::vector<std::uint8_t>& bytes, std::size_t from) {
  unsigned total = 0;
  for (std::size_t i = from; i < bytes.size(); ++i) total += bytes[i];
  return static_cast<std::uint8_t>(total & 0xFFu);
}

/// SD2 with this content from DA to the last octet of data.
std::vector<std::uint8_t> telegram(const std::vector<std::uint8_t>& content) {
  const auto length = static_cast<std::uint8_t>(content.size());
  std::vector<std::uint8_t> bytes;
  for (const std::uint8_t byte : {std::uint8_t{0x68}, length, length, std::uint8_t{0x68}}) bytes.push_back(byte);
  for (const std::uint8_t byte : content) bytes.push_back(byte);
  bytes.push_back(sum(bytes, 4));
  bytes.push_back(0x16);
  return bytes;
}

}  // namespace

Answers::Answers(std::uint8_t first, std::size_t count, std::uint8_t master) : first_(first), stations_(count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto address = static_cast<std::uint8_t>(first + i);
    const auto extended = static_cast<std::uint8_t>(address | 0x80u);
    const auto extended_master = static_cast<std::uint8_t>(master | 0x80u);
    Station& station = stations_[i];
    station.here = {0x10, master, address, 0x00, static_cast<std::uint8_t>(address + master), 0x16};
    station.wants_parameters =
        telegram({extended_master, extended, 0x08, 0x3E, 0x3C, 0x02, 0x05, 0x00, 0xFF, 0x75, 0x31});
    station.ready = telegram({extended_master, extended, 0x08, 0x3E, 0x3C, 0x00, 0x0C, 0x00, master, 0x75, 0x31});
    station.inputs = telegram({master, address, 0x08, 0, 0, 0, 0, 0, 0, 0, 0, 0x0B, 0x31, 0, 0});
  }
}

std::size_t Answers::lengthOf(ByteView begun) {
  if (begun.empty()) return 0;
  if (begun[0] != 0x68) return 6;  // SD1: the master sends nothing else here
  return begun.size() > 1 ? begun[1] + 6u : 0;
}

ByteView Answers::to(ByteView request) {
  const bool long_telegram = request[0] == 0x68;
  const std::uint8_t destination = request[long_telegram ? 4 : 1];
  const std::size_t index = (destination & 0x7Fu) - static_cast<std::size_t>(first_);
  if (index >= stations_.size()) return {};
  Station& station = stations_[index];
  if (!long_telegram) return station.here;
  if ((destination & 0x80u) == 0) return station.inputs;
  switch (request[7]) {
    case 0x3C:
      return station.configured ? station.ready : station.wants_parameters;
    case 0x3E:
      station.configured = true;
      return kShortAcknowledge;
    default:
      return kShortAcknowledge;
  }
}

std::vector<profibus::SlaveConfig> slaves(std::uint8_t first, std::size_t count) {
  std::vector<profibus::SlaveConfig> list;
  for (std::size_t i = 0; i < count; ++i) {
    profibus::SlaveConfig slave;
    slave.address = *profibus::StationAddress::from(static_cast<int>(first + i));
    slave.ident_number = 0x7531;
    slave.configuration = {0xF3, 0xF1};
    slave.output_length = 12;
    slave.input_length = 12;
    slave.watchdog = std::chrono::seconds{1};
    list.push_back(slave);
  }
  return list;
}

}  // namespace nord_driver::bench
