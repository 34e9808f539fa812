// Any answers to acyclic requests: one result per record, in bounded time, never longer than asked for.
#include "fuzz.h"
#include "profibus/record_channel.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nord_driver;
  using namespace nord_driver::profibus;
  fuzz::Choices choices{data, size};
  RecordChannel channel{3, std::chrono::milliseconds{100}};
  Instant now{std::chrono::hours{1}};
  RecordRequest asked, request;  // the last one, and the one that was taken
  bool open = false;
  Instant first_sent{};
  while (!choices.empty()) {
    now += std::chrono::milliseconds{choices.below(40)};
    switch (choices.below(6)) {
      case 0:
        asked = RecordRequest{};
        asked.slot = choices.byte();
        asked.index = choices.byte();
        asked.write = choices.below(2) == 0;
        asked.length = choices.byte();
        for (const std::uint8_t byte : choices.bytes(choices.below(241))) asked.data.push_back(byte);
        if (channel.submit(asked, std::nullopt)) {
          fuzz::require(!open);
          open = true;
          request = asked;
          first_sent = Instant{};
        }
        break;
      case 1:
        if (const auto result = channel.pollResult()) {
          fuzz::require(open && result->slave == 3 && result->slot == request.slot && result->index == request.index);
          fuzz::require(request.write || result->data.size() <= request.length);
          fuzz::require(meaningOf(result->error)[0] != '\0');
          open = false;
        }
        break;
      case 2:
        channel.handleOffline(now);
        if (choices.below(2) == 0) channel.handleStartUp();
        break;
      default: {
        if (!channel.wantsTelegram(now)) break;
        const ByteView telegram = channel.pollTelegram(now);
        if (!telegram.empty() && first_sent == Instant{}) first_sent = now;
        FdlAnswer answer;
        FixedBytes<256> pdu;
        switch (choices.below(5)) {
          case 0:
            break;
          case 1:
            answer.kind = FdlAnswer::Kind::kRefusal;
            answer.code = choices.below(2) == 0 ? ResponseCode::kNotActivated : ResponseCode::kNoResource;
            break;
          case 2:  // something like the right answer
            answer.kind = FdlAnswer::Kind::kData;
            pdu.push_back(static_cast<std::uint8_t>((request.write ? 0x5F : 0x5E) | (choices.byte() & 0x80u)));
            for (const std::uint8_t byte : {request.slot, request.index}) pdu.push_back(byte);
            for (const std::uint8_t byte : choices.bytes(choices.below(242))) pdu.push_back(byte);
            break;
          case 3:
            answer.kind = FdlAnswer::Kind::kData;
            pdu = choices.bytes(choices.below(245));
            break;
          default:
            channel.handleNoAnswer(now);
            continue;
        }
        answer.data = pdu;
        channel.handleAnswer(answer, now);
        // A second of repeated reads, and the time for one response.
        if (open && !channel.hasResult() && first_sent != Instant{}) {
          fuzz::require(now - first_sent <= std::chrono::milliseconds{1200});
        }
      }
    }
  }
  return 0;
}
