// Any bytes in any chunks: no telegram is lost or made up, every byte is accounted for.
#include "fuzz.h"
#include "profibus/telegram_receiver.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nord_driver;
  using namespace nord_driver::profibus;
  fuzz::Choices choices{data, size};
  TelegramReceiver receiver;
  while (!choices.empty()) {
    const auto chunk = choices.bytes(1u + choices.byte());
    receiver.receive(chunk, [](const Telegram& telegram) {
      Frame frame;
      fuzz::require(encode(telegram, frame));
      const ParseResult again = parse(frame);
      fuzz::require(again.kind == Parse::kOk && again.eaten == frame.size());
      fuzz::require(again.telegram.data == telegram.data && again.telegram.fc == telegram.fc);
      fuzz::require(again.telegram.dsap == telegram.dsap && again.telegram.ssap == telegram.ssap);
    });
    const ReceiverCounters& counters = receiver.counters();
    fuzz::require(counters.bytes_received ==
                  counters.bytes_in_telegrams + counters.bytes_discarded + receiver.buffered());
  }
  receiver.discard();
  fuzz::require(receiver.buffered() == 0);
  return 0;
}
