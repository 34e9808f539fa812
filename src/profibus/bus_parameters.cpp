#include "profibus/bus_parameters.h"

#include <array>
#include <stdexcept>
#include <string>

namespace nord_driver::profibus {

namespace {

struct RateRow {
  std::uint32_t baud;
  std::uint32_t slot, max_tsdr, quiet, setup;  // bit times
  std::uint8_t retries;
};

// The defaults of the usual master cards for one master on one segment, in bit times.
// 45.45 kbit/s exists behind DP/PA couplers only: hence its long times.
constexpr std::array<RateRow, 10> kRates{{
    {9'600, 100, 60, 0, 1, 1},
    {19'200, 100, 60, 0, 1, 1},
    {45'450, 640, 400, 0, 95, 1},
    {93'750, 100, 60, 0, 1, 1},
    {187'500, 100, 60, 0, 1, 1},
    {500'000, 200, 100, 0, 1, 1},
    {1'500'000, 300, 150, 0, 1, 1},
    {3'000'000, 400, 250, 3, 4, 2},
    {6'000'000, 600, 450, 6, 8, 3},
    {12'000'000, 1000, 800, 9, 16, 4},
}};

constexpr std::uint32_t kMaxSlotBits = 16'383;
constexpr std::uint32_t kSlotMargin = 15;  // T_SL >= max T_SDR + 15
constexpr std::uint8_t kMaxRetries = 15;

void require(bool good, const std::string& sentence) {
  if (!good) throw std::invalid_argument(sentence);
}

}  // namespace

BusParameters BusParameters::forBaudRate(BaudRate baud, StationAddress master) {
  for (const RateRow& row : kRates) {
    if (row.baud != baud.bitsPerSecond()) continue;
    BusParameters parameters;
    parameters.baud = baud;
    parameters.master = master;
    parameters.slot_bits = row.slot;
    parameters.max_tsdr_bits = row.max_tsdr;
    parameters.quiet_bits = row.quiet;
    parameters.setup_bits = row.setup;
    parameters.max_retries = row.retries;
    return parameters;
  }
  throw std::invalid_argument(
      std::to_string(baud.bitsPerSecond()) +
      " bit/s is no PROFIBUS rate: expected 9600, 19200, 45450, 93750, 187500, 500000, 1500000, "
      "3000000, 6000000 or 12000000");
}

void BusParameters::validate() const {
  require(baud.bitsPerSecond() > 0, "the baud rate is 0");
  require(!master.isUnnamed(),
          "the master address is 126, which belongs to stations without a name: expected 0 to 125");
  require(slot_bits <= kMaxSlotBits, "the slot time is " + std::to_string(slot_bits) + " bit times: at most 16383");
  require(slot_bits >= max_tsdr_bits + kSlotMargin, "the slot time of " + std::to_string(slot_bits) +
                                                        " bit times is shorter than the latest answer (max T_SDR " +
                                                        std::to_string(max_tsdr_bits) + ") and 15");
  require(!slot_time || *slot_time >= baud.bits(max_tsdr_bits + kSlotMargin),
          "the slot time given in seconds is shorter than the latest answer (max T_SDR " +
              std::to_string(max_tsdr_bits) + " bit times) and 15 bit times");
  require(!slot_time || *slot_time <= std::chrono::seconds{1}, "the slot time is longer than 1 s");
  require(min_tsdr_bits >= 11 && min_tsdr_bits <= max_tsdr_bits, "min T_SDR is not between 11 bit times and max T_SDR");
  require(max_retries <= kMaxRetries, "more than 15 retries");
  require(probe_interval > Duration::zero(), "the probe interval is not positive");
  require(listen_first >= Duration::zero() && listen_first <= kLongestListening,
          "the time to listen first is not between 0 and 10 s");
  require(!gives_way || listen_first > Duration::zero(), "who gives way to another master has to listen first");
  require(operate_interval >= Duration::zero(), "the interval of Global_Control is negative");
}

}  // namespace nord_driver::profibus
