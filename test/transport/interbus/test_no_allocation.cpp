// The bus cycle takes no memory: neither while the gateway answers nor while it is silent.
#include <gtest/gtest.h>

#include "support/count_allocations.h"
#include "transport/interbus/fake_gateway.h"
#include "transport/interbus/interbus.h"
#include "transport/interbus/interbus_settings.h"

namespace nord_driver {
namespace {

TEST(InterbusNoAllocation, ACycleTakesNoMemory) {
  if (!test::kCanCountAllocations) GTEST_SKIP() << "the sanitizers replace malloc";
  test::FakeGateway gateway;
  gateway.given.reserve(1000);
  gateway.ring = [](const RegisterImage&) { return RegisterImage{0x0B31, 0, 0x0B31, 0}; };
  InterbusTransport transport{
      [&](const link::ModbusSettings&) { return std::make_unique<test::FakeRegisterLink>(gateway); }};
  test::InterbusSettings settings;
  settings.bus.set("running/address", 100);
  transport.configure(settings.bus, settings.drives, 100.0);
  std::vector<profile::ProcessOutput> outputs(2);
  std::vector<DriveExchange> inputs(2);
  profile::ParameterRequest request;
  const unsigned long taken = test::countAllocations([&] {
    for (int i = 0; i < 300; ++i) {
      gateway.stalled = i % 100 > 80;
      gateway.ring_runs = i % 100 > 20;
      transport.exchange(outputs, inputs);
      transport.submit(0, request);
      while (transport.pollResult()) {
      }
      while (transport.pollEvent()) {
      }
      transport.counters();
      transport.busText();
      transport.note(1);
      transport.sleepUntil(transport.now() + std::chrono::milliseconds{8});
    }
  });
  EXPECT_EQ(0u, taken);
  EXPECT_GT(transport.counters().value("without_inputs"), 0u);
}

}  // namespace
}  // namespace nord_driver
