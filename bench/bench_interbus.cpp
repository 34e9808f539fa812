// What the driver adds to a bare libmodbus loop over the loopback, and that a gateway that stalls moves no bus cycle.
#include <modbus/modbus.h>
#include <sys/prctl.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "measure.h"
#include "register_server.h"
#include "support/map_settings.h"
#include "transport/interbus/interbus.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;
using test::MapSettings;

constexpr unsigned kProcessor = 0;
constexpr int kDrives = 2;
constexpr int kWords = 2 * kDrives;
constexpr std::size_t kPairs = 2000, kBlock = 20;
constexpr int kRepeats = 5;
constexpr double kRate = 200.0;  // Hz, of the cycles whose jitter is measured
constexpr int kCycles = 150;     // in a block
constexpr int kBlocks = 6;
// Two changes of threads, there and back, and the bookkeeping between them.
constexpr double kHandOver = 100.0;  // us

std::int64_t nowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// The whole transport, without drives behind the registers.
class Driver {
 public:
  explicit Driver(const std::string& gateway) : outputs_(kDrives), inputs_(kDrives) {
    MapSettings bus{"~bus/", {{"gateway", gateway}, {"outputs/address", 100}, {"answer_window", 0.0025}}};
    std::vector<DriveSettings> drives;
    for (int i = 0; i < kDrives; ++i) {
      const std::string name = "drive" + std::to_string(i);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", 1 + i).set("series", "sk5xxe").set("pole_pairs", 2).set("max_frequency", 50.0);
      drives.push_back({name, settings});
    }
    transport_.configure(bus, drives, kRate);
    for (int i = 0; i < 1000 && !inputs_[0].inverter_answers; ++i) {
      transport_.exchange(outputs_, inputs_);
      transport_.sleepUntil(transport_.now() + std::chrono::milliseconds{1});
    }
    if (!inputs_[0].inverter_answers) throw std::runtime_error(transport_.busText().str());
  }
  ~Driver() { transport_.close(); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  void exchange() { transport_.exchange(outputs_, inputs_); }
  void sleepUntil(Instant when) { transport_.sleepUntil(when); }
  /// New ones in the last exchange.
  bool hasInputs() const { return inputs_[0].inverter_answers; }
  bool connected() const { return transport_.connected(); }
  std::uint64_t withoutInputs() const { return transport_.counters().value("without_inputs"); }

 private:
  InterbusTransport transport_;
  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_;
};

/// The same two requests with nothing around them.
class Bare {
 public:
  explicit Bare(const RegisterServer& server) : context_(::modbus_new_tcp("127.0.0.1", server.port())) {
    if (context_ == nullptr || ::modbus_connect(context_) != 0) throw std::runtime_error("no connection");
  }
  ~Bare() {
    ::modbus_close(context_);
    ::modbus_free(context_);
  }
  Bare(const Bare&) = delete;
  Bare& operator=(const Bare&) = delete;

  void exchange() {
    const std::uint16_t outputs[kWords] = {};
    std::uint16_t inputs[kWords];
    if (::modbus_write_registers(context_, 100, kWords, outputs) != kWords ||
        ::modbus_read_input_registers(context_, 0, kWords, inputs) != kWords) {
      throw std::runtime_error(::modbus_strerror(errno));
    }
  }

 private:
  modbus_t* context_;
};

struct Figures {
  std::vector<double> to_register, age;  // us
};

void measure(const std::function<void()>& exchange, const RegisterServer& server, Figures& figures) {
  const std::int64_t begin = nowNs();
  exchange();
  const std::int64_t end = nowNs();
  figures.to_register.push_back(static_cast<double>(server.written() - begin) * 1e-3);
  figures.age.push_back(static_cast<double>(end - server.read()) * 1e-3);
}

bool besideABareLoop() {
  RegisterServer server{kProcessor}, bare_server{kProcessor};
  Driver driver{server.address()};
  Bare bare{bare_server};
  std::vector<double> to_register, age, bare_to_register, bare_age;
  for (int repeat = 0; repeat <= kRepeats; ++repeat) {
    Figures ours, theirs;
    for (std::size_t done = 0; done < kPairs; done += kBlock) {
      for (std::size_t i = 0; i < kBlock; ++i) measure([&] { driver.exchange(); }, server, ours);
      for (std::size_t i = 0; i < kBlock; ++i) measure([&] { bare.exchange(); }, bare_server, theirs);
    }
    if (repeat == 0) continue;  // warm-up
    if (!driver.connected()) throw std::runtime_error("the driver has no inputs");
    to_register.push_back(median(ours.to_register));
    age.push_back(median(ours.age));
    bare_to_register.push_back(median(theirs.to_register));
    bare_age.push_back(median(theirs.age));
  }
  std::printf(
      "%d drives, PPO 1, write and read over the loopback; bare libmodbus: to the register %.1f us, age %.1f us\n",
      kDrives, median(bare_to_register), median(bare_age));
  bool kept = report("from command to register, against the bare loop + 100 us", median(to_register), "us",
                     median(bare_to_register) + kHandOver);
  std::printf("exchanges that brought no new inputs in time: %llu\n",
              static_cast<unsigned long long>(driver.withoutInputs()));
  kept = report("age of the inputs when they are used, against the bare loop + 100 us", median(age), "us",
                median(bare_age) + kHandOver) &&
         kept;
  return kept;
}

double percentile99(std::vector<double> values) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Adds how late each cycle of a block begins, us.
void addLateness(Driver& driver, std::vector<double>& late) {
  const Duration period = seconds(1.0 / kRate);
  Instant next = std::chrono::steady_clock::now() + period;
  for (int i = 0; i < kCycles; ++i, next += period) {
    driver.sleepUntil(next);
    late.push_back(toSeconds(std::chrono::steady_clock::now() - next) * 1e6);
    driver.exchange();
  }
}

bool aStalledGatewayMovesNoCycle() {
  RegisterServer server{kProcessor};
  Driver driver{server.address()};
  std::vector<double> quick, stalled;
  for (int block = 0; block < kBlocks; ++block) {
    server.stall(false);
    for (int i = 0; i < 2000 && !driver.connected(); ++i) {
      driver.exchange();
      driver.sleepUntil(std::chrono::steady_clock::now() + std::chrono::milliseconds{1});
    }
    addLateness(driver, quick);
    server.stall(true);
    addLateness(driver, stalled);
    if (driver.connected()) throw std::runtime_error("the gateway did not stall");
  }
  const double of_quick = percentile99(std::move(quick));
  std::printf("%d cycles at %.0f Hz begin late, 99th percentile: gateway quick %.1f us\n", kBlocks * kCycles, kRate,
              of_quick);
  return report("the same with the gateway stalled, against quick + 100 us", percentile99(std::move(stalled)), "us",
                of_quick + 100.0);
}

}  // namespace

int main() {
  try {
    pinTo(kProcessor);
    prctl(PR_SET_TIMERSLACK, 1);  // like the thread of the bus cycle
    const BusyOthers busy{kProcessor};
    bool kept = besideABareLoop();
    kept = aStalledGatewayMovesNoCycle() && kept;
    return kept ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_interbus: %s\n", error.what());
    return 2;
  }
}
