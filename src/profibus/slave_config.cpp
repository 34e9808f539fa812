#include "profibus/slave_config.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "profibus/configuration_bytes.h"
#include "profibus/watchdog_factors.h"

namespace nord_driver::profibus {

namespace {

constexpr std::uint8_t kDpv1Enable = 0x80;

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string name(const SlaveConfig& slave) {
  return "station " + std::to_string(slave.address.value()) + ": ";
}

void require(const SlaveConfig& slave, bool good, const std::string& sentence) {
  if (!good) throw std::invalid_argument(name(slave) + sentence);
}

void requireLength(const SlaveConfig& slave, std::size_t length, const char* what) {
  require(slave, length <= kMaxIoLength,
          std::string{what} + " of " + std::to_string(length) + " bytes: PROFIBUS DP carries at most 244 per exchange");
}

void requireWatchdog(const SlaveConfig& slave) {
  if (slave.watchdog == Duration::zero() || WatchdogFactors::from(slave.watchdog)) return;
  std::string sentence =
      "a watchdog of " + number(toSeconds(slave.watchdog)) +
      " s cannot be told to a slave: expected 0 (off) or 0.01 to 650.25 s as a product f1 * f2 * 0.01 s of "
      "two factors up to 255";
  const auto next = WatchdogFactors::representableFrom(slave.watchdog);
  if (slave.watchdog > Duration::zero() && next)
    sentence += "; the next longer one is " + number(toSeconds(*next)) + " s";
  throw std::invalid_argument(name(slave) + sentence);
}

void requireMatchingLengths(const SlaveConfig& slave) {
  const auto lengths = ioLengths(slave.configuration);
  require(slave, lengths.has_value(),
          "the configuration bytes " + toHex(slave.configuration) + " end in the middle of an identifier");
  require(slave, lengths->outputs == slave.output_length && lengths->inputs == slave.input_length,
          "the configuration bytes " + toHex(slave.configuration) + " stand for " + std::to_string(lengths->outputs) +
              " bytes of outputs and " + std::to_string(lengths->inputs) + " of inputs, not for " +
              std::to_string(slave.output_length) + " and " + std::to_string(slave.input_length));
}

}  // namespace

void validate(const SlaveConfig& slave, const BusParameters& bus) {
  require(slave, !slave.address.isUnnamed(),
          "address 126 belongs to stations without a name and exchanges no data: expected 0 to 125");
  require(slave, slave.address != bus.master, "this is the address of the master itself");
  require(slave, !slave.configuration.empty(), "no configuration bytes for Chk_Cfg");
  require(slave, slave.configuration.size() <= kMaxIoLength,
          std::to_string(slave.configuration.size()) + " configuration bytes: Chk_Cfg carries at most 244");
  require(slave, slave.user_parameters.size() <= kMaxUserParameters,
          std::to_string(slave.user_parameters.size()) + " bytes of user parameters: Set_Prm carries at most 237");
  requireLength(slave, slave.output_length, "outputs");
  requireLength(slave, slave.input_length, "inputs");
  require(slave, slave.output_length + slave.input_length > 0,
          "neither outputs nor inputs: there is nothing to exchange");
  require(slave, slave.min_tsdr_bits == 0 || slave.min_tsdr_bits >= 11,
          "min T_SDR of " + std::to_string(slave.min_tsdr_bits) + " bit times: expected 11 to 255, or 0 to leave it");
  require(slave, !slave.dpv1 || (slave.user_parameters.size() >= 3 && (slave.user_parameters[0] & kDpv1Enable) != 0),
          "DP-V1 needs user parameters that begin with DPV1_Status_1 to 3 and have bit 7 (DPV1_Enable) set");
  require(slave, slave.record_timeout > Duration::zero(), "the time for an acyclic response is not positive");
  requireWatchdog(slave);
  requireMatchingLengths(slave);
}

void validate(const std::vector<SlaveConfig>& slaves, const BusParameters& bus) {
  for (std::size_t i = 0; i < slaves.size(); ++i) {
    validate(slaves[i], bus);
    const bool twice = std::any_of(slaves.begin(), slaves.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const SlaveConfig& other) { return other.address == slaves[i].address; });
    require(slaves[i], !twice, "two slaves are configured with this address");
  }
}

}  // namespace nord_driver::profibus
