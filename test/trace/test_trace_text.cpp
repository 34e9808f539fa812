#include "core/version.h"
#include "trace/trace_fixture.h"
#include "trace/trace_text.h"

namespace nord_driver::trace {
namespace {

class TraceTextTest : public TraceTest {};

TraceRecord telegram(TraceKind kind, int milliseconds, const std::string& hex) {
  const auto bytes = fromHex(hex);
  TraceRecord record;
  record.time = Instant{std::chrono::milliseconds{milliseconds}};
  record.kind = kind;
  record.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), record.bytes.begin());
  return record;
}

// The page as users are shown it in doc/trace.md, line by line.
TEST_F(TraceTextTest, ThePage) {
  cycle(100, 0x0B37, 0x1337);
  cycle(110, 0, 0x0238, -0x4000);
  TracePage page;
  page.reasons = {"drive right stopped: a fault (status word 0238, fault)"};
  page.time = at(110);
  page.process_data = feed_.history().upTo(1);
  page.telegrams = {telegram(TraceKind::kSent, 109, "10 03 01 49 4D 16"), telegram(TraceKind::kNoise, 110, "00 FF"),
                    telegram(TraceKind::kReceived, 112, "E5")};
  page.telegrams[2].time += std::chrono::microseconds{7};
  const TelegramTrace trace{kLinkTypeProfibusDl,
                            [](const TraceRecord& record) { return std::to_string(record.length) + " bytes"; }, 1};
  EXPECT_EQ(std::string("nord_driver ") + kVersion + R"( trace
reason: drive right stopped: a fault (status word 0238, fault)
time 0: 2023-11-14 22:13:20.110000 UTC
drive left: PROFIBUS station 3
drive right: PROFIBUS station 4

process data: time in s, words hexadecimal, ---- where the inverter did not answer in that cycle
          time  drive  STW  SW1  SW2  SW3   ZSW  IW1  IW2  IW3
     -0.010000  left   047F 2000 0000 0000  0B37 2000 0000 0000
     -0.010000  right  047F 2000 0000 0000  1337 2000 0000 0000
      0.000000  left   047F C000 0000 0000  ---- ---- ---- ----
      0.000000  right  047F C000 0000 0000  0238 C000 0000 0000

telegrams, 3: time in s, > sent, < received, ? bytes that are no telegram
     -0.001000 > 10 03 01 49 4D 16                                               6 bytes
      0.000000 ? 00 FF                                                           2 bytes
      0.002007 < E5                                                              1 bytes
)",
            traceText(page, drives(), &trace, clockAt(500)));
}

// A transport without a trace says so.
TEST_F(TraceTextTest, WithoutTelegrams) {
  const std::string text = traceText({}, drives(), nullptr, clockAt(0));
  EXPECT_NE(std::string::npos, text.find("\ntelegrams: this transport keeps none\n"));
}

// The wall clock's time of an earlier moment, also before a full second.
TEST_F(TraceTextTest, TimesOnTheWall) {
  EXPECT_EQ("2023-11-14 22:13:19.998500", utcText(clockAt(500).wallTime(Instant{std::chrono::microseconds{-1500}})));
}

}  // namespace
}  // namespace nord_driver::trace
