#include <gtest/gtest.h>

#include <stdexcept>

#include "profibus/diagnosis.h"
#include "profibus/dp_master.h"
#include "profibus/slave_config.h"
#include "profibus/watchdog_factors.h"
#include "profibus/wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

/// What the master says of this slave; empty when it takes it.
template <typename Change>
std::string refusal(Change&& change) {
  SlaveConfig slave = nordModule(8);
  change(slave);
  try {
    DpMaster master{quietBus(), {nordModule(7), slave}};
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(SlaveConfig, OfANordModuleIsGood) {
  EXPECT_EQ("", refusal([](SlaveConfig&) {}));
  EXPECT_EQ("", refusal([](SlaveConfig& slave) { slave.watchdog = Duration::zero(); }));
  EXPECT_EQ("", refusal([](SlaveConfig& slave) { slave.min_tsdr_bits = 0; }));
}

TEST(SlaveConfig, IsRefusedInWords) {
  EXPECT_EQ("station 7: two slaves are configured with this address",
            refusal([](SlaveConfig& slave) { slave.address = station(7); }));
  EXPECT_EQ("station 1: this is the address of the master itself",
            refusal([](SlaveConfig& slave) { slave.address = station(1); }));
  EXPECT_EQ("station 126: address 126 belongs to stations without a name and exchanges no data: expected 0 to 125",
            refusal([](SlaveConfig& slave) { slave.address = StationAddress{}; }));
  EXPECT_EQ("station 8: no configuration bytes for Chk_Cfg",
            refusal([](SlaveConfig& slave) { slave.configuration.clear(); }));
  EXPECT_EQ("station 8: 245 configuration bytes: Chk_Cfg carries at most 244",
            refusal([](SlaveConfig& slave) { slave.configuration.resize(245); }));
  EXPECT_EQ("station 8: 238 bytes of user parameters: Set_Prm carries at most 237",
            refusal([](SlaveConfig& slave) { slave.user_parameters.resize(238); }));
  EXPECT_EQ("station 8: outputs of 245 bytes: PROFIBUS DP carries at most 244 per exchange",
            refusal([](SlaveConfig& slave) { slave.output_length = 245; }));
  EXPECT_EQ("station 8: inputs of 245 bytes: PROFIBUS DP carries at most 244 per exchange",
            refusal([](SlaveConfig& slave) { slave.input_length = 245; }));
  EXPECT_EQ("station 8: neither outputs nor inputs: there is nothing to exchange",
            refusal([](SlaveConfig& slave) { slave.output_length = slave.input_length = 0; }));
  EXPECT_EQ("station 8: min T_SDR of 10 bit times: expected 11 to 255, or 0 to leave it",
            refusal([](SlaveConfig& slave) { slave.min_tsdr_bits = 10; }));
  EXPECT_EQ(
      "station 8: the configuration bytes F3 F1 stand for 12 bytes of outputs and 12 of inputs, not for 12 and 20",
      refusal([](SlaveConfig& slave) { slave.input_length = 20; }));
  EXPECT_EQ("station 8: the configuration bytes F3 40 end in the middle of an identifier",
            refusal([](SlaveConfig& slave) {
              slave.configuration = {0xF3, 0x40};
            }));
  EXPECT_EQ(
      "station 8: a watchdog of 2.57 s cannot be told to a slave: expected 0 (off) or 0.01 to 650.25 s as a product "
      "f1 * f2 * 0.01 s of two factors up to 255; the next longer one is 2.58 s",
      refusal([](SlaveConfig& slave) { slave.watchdog = 2570ms; }));
  for (const Duration watchdog : {Duration{-1s}, Duration{5ms}, Duration{15ms}, Duration{651s}}) {
    EXPECT_NE("", refusal([&](SlaveConfig& slave) { slave.watchdog = watchdog; })) << watchdog.count();
  }
}

TEST(SlaveConfig, TheBusIsCheckedToo) {
  BusParameters bus = quietBus();
  bus.slot_bits = 10;
  EXPECT_THROW((DpMaster{bus, {nordModule(8)}}), std::invalid_argument);
}

// The largest Set_Prm, Chk_Cfg and exchange fit their telegrams.
TEST(SlaveConfig, TheLargestSlave) {
  SlaveConfig slave = nordModule(8);
  slave.configuration.assign(244, 0xF5);
  slave.user_parameters.assign(237, 0x11);
  slave.output_length = 244;
  slave.input_length = 244;
  const DpServices services{quietBus()};
  FdlRequest request;
  services.setPrm(request, slave, 0x7531, 0x10);
  EXPECT_EQ(255u, request.frame.size());
  services.chkCfg(request, slave, 0x10);
  EXPECT_EQ(255u, request.frame.size());
  services.dataExchange(request, slave, std::vector<std::uint8_t>(244, 0), 0x10);
  EXPECT_EQ(253u, request.frame.size());
}

// f1 * f2 * 10 ms with the smallest f2; the captured masters write 300 ms as 1E 01.
TEST(WatchdogFactors, OfATime) {
  const auto factors = [](Duration time) -> std::pair<int, int> {
    const auto found = WatchdogFactors::from(time);
    return found ? std::pair<int, int>{found->f1, found->f2} : std::pair<int, int>{0, 0};
  };
  EXPECT_EQ(std::make_pair(1, 1), factors(10ms));
  EXPECT_EQ(std::make_pair(10, 1), factors(100ms));
  EXPECT_EQ(std::make_pair(0x1E, 1), factors(300ms));
  EXPECT_EQ(std::make_pair(255, 1), factors(2550ms));
  EXPECT_EQ(std::make_pair(128, 2), factors(2560ms));
  EXPECT_EQ(std::make_pair(255, 255), factors(650'250ms));
  for (const Duration time : {Duration{0}, Duration{9ms}, Duration{11ms}, Duration{2570ms}, Duration{650'260ms}}) {
    EXPECT_EQ(std::make_pair(0, 0), factors(time)) << time.count();
  }
  EXPECT_EQ(Duration{2580ms}, WatchdogFactors::representableFrom(2561ms));
  EXPECT_EQ(Duration{10ms}, WatchdogFactors::representableFrom(1ms));
  EXPECT_FALSE(WatchdogFactors::representableFrom(651s));
}

TEST(Diagnosis, IsReadBitByBit) {
  const auto read = [](const char* hex) { return *Diagnosis::from(fromHex(hex)); };
  EXPECT_TRUE(read("02 05 00 FF 0A 35").notReady());
  EXPECT_TRUE(read("02 05 00 FF 0A 35").parameterRequest());
  EXPECT_EQ(kNoOwner, read("02 05 00 FF 0A 35").owner());
  EXPECT_EQ(0x0A35, read("02 05 00 FF 0A 35").ident());
  const Diagnosis ready = read("00 0C 00 02 0A 35");
  EXPECT_FALSE(ready.notReady() || ready.parameterRequest() || ready.parameterFault() || ready.configurationFault());
  EXPECT_FALSE(ready.staticDiagnosis() || ready.extended());
  EXPECT_TRUE(ready.watchdogOn());
  EXPECT_EQ(2, ready.owner());
  EXPECT_TRUE(read("40 00 00 FF 0A 35").parameterFault());
  EXPECT_TRUE(read("04 00 00 FF 0A 35").configurationFault());
  EXPECT_TRUE(read("00 02 00 FF 0A 35").staticDiagnosis());
  EXPECT_TRUE(read("08 04 00 02 75 31 02 04").extended());
  EXPECT_EQ("02 04", toHex(read("08 04 00 02 75 31 02 04").extendedBytes()));
  EXPECT_FALSE(Diagnosis::from(fromHex("02 05 00 FF 0A")));
  EXPECT_FALSE(Diagnosis::from(std::vector<std::uint8_t>(245, 0)));
  EXPECT_TRUE(Diagnosis::from(std::vector<std::uint8_t>(244, 0)));
}

}  // namespace
}  // namespace nord_driver::profibus
