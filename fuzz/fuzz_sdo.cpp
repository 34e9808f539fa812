// An SDO client against a server that answers anything: every request gets exactly one answer, and no answer holds more
// than the client can.
#include "canopen/sdo_abort.h"
#include "canopen/sdo_client.h"
#include "fuzz.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::canopen;

class Game {
 public:
  Game(const std::uint8_t* data, std::size_t size) : choices_(data, size) {}

  void play() {
    while (!choices_.empty()) {
      if (!client_.busy()) begin();
      turn();
    }
    // Whatever state it is in: silence ends it.
    for (int i = 0; client_.busy(); ++i) {
      if (client_.takeAnswer()) {
        ++answers_;
        break;
      }
      fuzz::require(i < 400 && client_.nextDeadline());
      send();
      now_ = *client_.nextDeadline();
      client_.poll(now_);
    }
    const SdoCounters& counters = client_.counters();
    const std::uint64_t ended =
        counters.done + counters.aborted_by_server + counters.aborted_by_us + counters.timed_out;
    fuzz::require(ended == started_ && answers_ + cancelled_ == started_);
  }

 private:
  void begin() {
    request_ = sdoRead(++started_, static_cast<std::uint16_t>(0x2000 + choices_.below(3)), choices_.below(3));
    request_.block = choices_.below(2) == 0;
    request_.write = choices_.below(2) == 0;
    FixedBytes<kSdoCapacity> data;
    if (request_.write) data.resize(1 + std::size_t{choices_.byte()} * 4);
    fuzz::require(client_.start(request_, ByteView{data}, now_));
  }

  void turn() {
    send();
    now_ += std::chrono::milliseconds{choices_.below(20)};
    switch (choices_.below(8)) {
      case 0:
        client_.poll(now_);
        break;
      case 1:
        if (choices_.below(16) != 0) break;
        client_.cancel();
        fuzz::require(!client_.busy());
        ++cancelled_;
        break;
      case 2: {  // anything, of any length
        const FixedBytes<256> bytes = choices_.bytes(choices_.below(9));
        client_.handle(dataFrame(0x5B2, bytes), now_);
        break;
      }
      default:
        client_.handle(dataFrame(0x5B2, likely()), now_);
    }
    const auto answer = client_.takeAnswer();
    if (!answer) return;
    fuzz::require(answer->data.size() <= kSdoCapacity && (answer->data.empty() || answer->ok()));
    fuzz::require(!answer->ok() || answer->abort_code == 0);
    ++answers_;
    fuzz::require(!abortText(answer->abort_code).empty());
    answer->number();
  }

  /// A frame that a server might send in some state.
  SdoBytes likely() {
    constexpr std::uint8_t kFirst[] = {0x43, 0x4B, 0x41, 0x40, 0x60, 0x00, 0x10, 0x01, 0x20, 0x30, 0xC4,
                                       0xC6, 0xC1, 0xC5, 0xA4, 0xA0, 0xA2, 0xA1, 0x80, 0x81, 0x82};
    SdoBytes bytes{};
    bytes[0] = kFirst[choices_.below(sizeof kFirst)];
    if ((bytes[0] & 0xE0u) == 0 && choices_.below(2) == 0) bytes[0] = ++segment_;
    if (bytes[0] == 0xA2 || bytes[0] == 0xA1) {
      bytes[1] = choices_.below(130);
      bytes[2] = choices_.below(130);
      return bytes;
    }
    bytes[1] = static_cast<std::uint8_t>(request_.index & 0xFFu);
    bytes[2] = static_cast<std::uint8_t>(request_.index >> 8);
    bytes[3] = request_.sub_index;
    bytes[4] = choices_.byte();
    bytes[5] = choices_.below(5);
    if (bytes[0] == 0xC4) segment_ = 0;
    return bytes;
  }

  void send() {
    CanFrame frame;
    for (int i = 0; client_.pollTransmit(frame); ++i) {
      fuzz::require(i < 160 && frame.id == 0x632 && frame.size == 8);
    }
  }

  fuzz::Choices choices_;
  Instant now_{std::chrono::hours{1}};
  SdoRequest request_;
  std::uint32_t started_ = 0, answers_ = 0, cancelled_ = 0;
  std::uint8_t segment_ = 0;
  SdoClient client_{defaultSdoChannel(0x32), std::chrono::milliseconds{50}};
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Game{data, size}.play();
  return 0;
}
