// What a transport does that leaves everything to the defaults of the interface.
#include <gtest/gtest.h>

#include <vector>

#include "nord_driver/transport/transport.h"

namespace nord_driver {
namespace {

class Bare final : public Transport {
 public:
  void configure(const Settings&, const std::vector<DriveSettings>&, double) override {}
  void exchange(const std::vector<profile::ProcessOutput>&, std::vector<DriveExchange>&) noexcept override {}
  bool connected() const noexcept override { return true; }
  DriveIdentity identity(DriveIndex) const override { return {}; }
};

// Nobody waits for an answer that never comes.
TEST(TransportDefaults, EveryParameterRequestIsAnsweredWithNoChannel) {
  Bare transport;
  EXPECT_EQ("none", transport.identity(0).parameter_channel);
  EXPECT_TRUE(transport.identity(0).sends_words);
  EXPECT_FALSE(transport.pollResult());
  for (const std::uint32_t id : {7u, 9u}) {
    profile::ParameterRequest request;
    request.id = id;
    EXPECT_TRUE(transport.submit(0, request));
  }
  for (const std::uint32_t id : {7u, 9u}) {
    const auto result = transport.pollResult();
    ASSERT_TRUE(result);
    EXPECT_EQ(id, result->id);
    EXPECT_EQ(profile::ParameterOutcome::kNoChannel, result->outcome);
  }
  EXPECT_FALSE(transport.pollResult());
  EXPECT_FALSE(transport.serveParametersOnly());
}

TEST(TransportDefaults, TheTimeIsTheSteadyClocks) {
  Bare transport;
  const Instant before = std::chrono::steady_clock::now();
  EXPECT_GE(transport.now(), before);
  const Instant when = transport.now() + std::chrono::milliseconds{2};
  transport.sleepUntil(when);
  EXPECT_GE(transport.now(), when);
}

TEST(TransportDefaults, ThereIsNothingToTell) {
  Bare transport;
  EXPECT_TRUE(transport.endPoint().isNone());
  EXPECT_EQ(0u, transport.counters().size());
  EXPECT_STREQ("", transport.note(0).text);
  EXPECT_EQ(0u, transport.identNumber(0));
  EXPECT_TRUE(transport.busText().empty());
  EXPECT_TRUE(transport.warnings().empty());
  EXPECT_FALSE(transport.pollEvent());
  EXPECT_EQ(nullptr, transport.trace());
}

}  // namespace
}  // namespace nord_driver
