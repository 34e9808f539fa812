// A whole master against anything: every pause is kept, no cycle lasts for ever, every byte and every request is
// accounted for.
#include <algorithm>

#include "fuzz.h"
#include "profibus/dp_master.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::profibus;

SlaveConfig slave(int address, std::vector<std::uint8_t> configuration, std::size_t length) {
  SlaveConfig made;
  made.address = *StationAddress::from(address);
  made.ident_number = 0x7531;
  made.configuration = std::move(configuration);
  made.output_length = made.input_length = length;
  made.watchdog = std::chrono::milliseconds{100};
  return made;
}

std::vector<SlaveConfig> slaves() {
  std::vector<SlaveConfig> all{slave(8, {0xF3, 0xF1}, 12), slave(9, {0x30, 0xF1}, 5), slave(10, {0xF1}, 4)};
  all[1].user_parameters = {0x80, 0x00, 0x00};
  all[1].dpv1 = true;
  all[1].configuration_check = ConfigurationCheck::kTell;
  all[2].expect_exact_ident = false;
  all[2].group = 1;
  return all;
}

BusParameters bus(std::uint8_t options) {
  BusParameters parameters = BusParameters::forBaudRate(BaudRate{500'000}, *StationAddress::from(1));
  parameters.sync_outputs = (options & 1u) != 0;
  parameters.freeze_inputs = (options & 2u) != 0;
  parameters.sync_groups = 1;
  if ((options & 4u) != 0) parameters.listen_first = std::chrono::milliseconds{5};
  parameters.gives_way = (options & 0x44u) == 0x44u;  // and listens first
  if ((options & 8u) != 0) parameters.operate_interval = Duration::zero();
  parameters.send_sd3 = (options & 16u) != 0;
  parameters.max_retries = static_cast<std::uint8_t>(options >> 6);
  return parameters;
}

class Game {
 public:
  Game(const std::uint8_t* data, std::size_t size)
      : choices_(data, size), options_(choices_.byte()), bus_(bus(options_)), master_(bus_, slaves()) {
    for (std::size_t i = 0; i < master_.slaveCount() && (options_ & 32u) != 0; ++i) {
      master_.setSilenceLimit(i, std::chrono::milliseconds{20});
    }
    master_.restart(now_);
  }

  void play() {
    while (!choices_.empty()) {
      between();
      cycle();
    }
    const ReceiverCounters& bytes = master_.counters().receiver;
    fuzz::require(bytes.bytes_in_telegrams + bytes.bytes_discarded <= bytes.bytes_received);
    fuzz::require(bytes.bytes_received - bytes.bytes_in_telegrams - bytes.bytes_discarded < kMaxTelegramLength);
    for (std::size_t i = 0; i < master_.slaveCount(); ++i) {
      const SlaveCounters& counters = master_.status(i).counters;
      fuzz::require(counters.answers + counters.timeouts <= counters.requests);
      fuzz::require(counters.exchanges <= counters.answers);
      fuzz::require(!master_.configurationText(i).empty());
    }
  }

 private:
  void between() {
    now_ += std::chrono::milliseconds{choices_.below(100)};
    const std::size_t which = choices_.below(3);
    switch (choices_.below(12)) {
      case 0:
        master_.setOutputs(which, choices_.bytes(choices_.below(20)));
        break;
      case 1: {
        RecordRequest request;
        request.index = choices_.byte();
        request.write = choices_.below(2) == 0;
        request.length = choices_.byte();
        for (const std::uint8_t byte : choices_.bytes(choices_.below(10))) request.data.push_back(byte);
        if (master_.submitRecord(which, request)) ++records_;
        break;
      }
      case 2:
        master_.requestConfiguration(which);
        break;
      case 3:
        if (master_.setSynchronised(choices_.below(2) == 0))
          fuzz::require(bus_.sync_outputs || bus_.freeze_inputs || !master_.isSynchronised());
        break;
      case 4:
        if (choices_.below(8) == 0) master_.restart(now_);
        break;
      case 5:
        hear(choices_.bytes(choices_.below(60)));
        break;
      default:
        break;
    }
    while (const auto event = master_.pollEvent()) fuzz::require(event->text != nullptr);
    while (const auto result = master_.pollRecord()) {
      fuzz::require(records_ > 0 && meaningOf(result->error)[0] != '\0');
      --records_;
    }
    fuzz::require(records_ <= master_.slaveCount());
  }

  void cycle() {
    const Instant begin = now_;
    master_.startCycle(now_);
    while (!master_.cycleDone()) {
      const ByteView sent = master_.pollTransmit(now_);
      if (!sent.empty()) {
        fuzz::require(now_ - line_free_ >= bus_.baud.bits(33));
        now_ += bus_.baud.characters(sent.size());
        line_free_ = now_;
        request_.clear();
        for (const std::uint8_t byte : sent) request_.push_back(byte);
        answer();
      } else if (const auto deadline = master_.nextDeadline()) {
        now_ = std::max(now_, *deadline);
        master_.handleTimeout(now_);
      } else {
        fuzz::require(false);
      }
      fuzz::require(now_ - begin < std::chrono::seconds{2});
    }
  }

  void answer() {
    const ParseResult parsed = parse(request_);
    fuzz::require(parsed.kind == Parse::kOk);
    const Telegram& request = parsed.telegram;
    now_ += bus_.baud.bits(11);
    Telegram telegram;
    telegram.da = request.sa;
    telegram.sa = request.da;
    FixedBytes<256> data;
    Frame frame;
    switch (choices_.below(8)) {
      case 0:  // silence
        return;
      case 1:  // anything
        return hear(choices_.bytes(choices_.below(255)));
      case 2:
        telegram.kind = TelegramKind::kSc;
        break;
      case 3:
        telegram.kind = TelegramKind::kSd1;
        telegram.fc = choices_.byte();
        break;
      case 4:  // data of any length to the right access points
        telegram.kind = TelegramKind::kSd2;
        telegram.fc = choices_.byte();
        telegram.dsap = request.ssap;
        telegram.ssap = request.dsap;
        data = choices_.bytes(choices_.below(240));
        break;
      default:
        obey(request, telegram, data);
        break;
    }
    telegram.data = data;
    if (encode(telegram, frame)) hear(frame);
  }

  /// As a slave would that wants to go on.
  void obey(const Telegram& request, Telegram& telegram, FixedBytes<256>& data) {
    telegram.kind = TelegramKind::kSd2;
    telegram.fc = choices_.below(16) == 0 ? 0x0A : 0x08;
    telegram.dsap = request.ssap;
    telegram.ssap = request.dsap;
    if (request.fc == 0x49) {
      telegram.kind = TelegramKind::kSd1;
      telegram.fc = 0;
    } else if (!request.dsap) {
      data = choices_.bytes(0);
      const std::size_t lengths[] = {12, 5, 4};
      data.resize(lengths[(request.da - 8u) % 3u]);
    } else if (*request.dsap == 60) {
      for (const int byte : {0x00, 0x0C, 0x00, 0x01, 0x75, 0x31}) data.push_back(static_cast<std::uint8_t>(byte));
      if (choices_.below(4) == 0) data[choices_.below(6)] = choices_.byte();
    } else if (*request.dsap == 59) {
      data.push_back(0xF3);
      data.push_back(0xF1);
    } else if (*request.dsap == 51 && choices_.below(2) == 0) {
      data = choices_.bytes(choices_.below(20));
    } else {
      telegram = Telegram{};
    }
  }

  void hear(ByteView bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t count = 1 + choices_.below(64);
      line_free_ = now_;
      master_.handleBytes(bytes.sub(at, count), now_);
      at += count;
      now_ += bus_.baud.bits(choices_.below(60));
    }
  }

  fuzz::Choices choices_;
  std::uint8_t options_;
  BusParameters bus_;
  Instant now_{std::chrono::hours{1}};
  Instant line_free_{};
  std::size_t records_ = 0;
  Frame request_;
  DpMaster master_;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Game{data, size}.play();
  return 0;
}
