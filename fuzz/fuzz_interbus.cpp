// The InterBus transport above a link whose server answers anything, at any age, out of order or not at all: no drive is
// online without inputs that are new, young and of a ring that runs; the words that go out are the drives' own; every
// parameter request gets one answer; and the counters fit what happened.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "fuzz.h"
#include "profile/parameter_queue.h"
#include "support/map_settings.h"
#include "transport/interbus/interbus.h"

namespace {

using namespace nord_driver;
using fuzz::require;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using test::MapSettings;

constexpr std::size_t kDrives = 2;
constexpr int kOutputs = 100, kRunning = 200, kInvoke = 500, kResult = 600;
constexpr Duration kTimeout = milliseconds{50}, kCycle = milliseconds{10};
constexpr double kParameterTimeout = 0.3;  // s
// Words of the blocks where nothing else is configured.
constexpr std::size_t kService = 0, kReference = 1, kError = 2, kAdditional = 3, kLength = 4, kBlock = 7;
constexpr Word kConfirmation = 0x0100;

Word anyWord(fuzz::Choices& choices) {
  const auto high = static_cast<unsigned>(choices.byte());
  return static_cast<Word>(high << 8u | choices.byte());
}

/// What comes, and when, the fuzzer says.
class AnyLink final : public link::RegisterLink {
 public:
  explicit AnyLink(fuzz::Choices& choices) : choices_(choices) {}

  bool open() noexcept override {
    if (report_.state == link::LinkState::kClosed) report_.state = link::LinkState::kConnecting;
    return !choices_.empty() || opens_;
  }
  void close() noexcept override { report_.state = link::LinkState::kClosed; }
  std::uint64_t give(const RegisterImage& outputs) noexcept override {
    image_ = outputs;
    ++images_;
    return ++given_;
  }
  // Inputs alone are asked for at a start only.
  std::uint64_t look() noexcept override {
    require(images_ == 0);
    return ++given_;
  }
  std::uint64_t order(const link::RegisterOrder& order) noexcept override {
    require(order.registers.first == (order.write ? kInvoke : kResult) && order.registers.count == kBlock);
    if (order.write) invoked_ = order.values;
    return ++ordered_;
  }
  const link::RegisterAnswer& answer() noexcept override { return answer_; }
  const link::RegisterInputs& take() noexcept override { return inputs_; }
  const link::LinkReport& report() noexcept override { return report_; }
  bool waitAnswers(Instant until) noexcept override {
    require(report_.state == link::LinkState::kConnected && now_ < until);
    now_ = std::min(until, now_ + microseconds{100 + 20 * choices_.byte()});
    act();
    return now_ < until;
  }
  Instant now() const noexcept override { return now_; }
  void sleepUntil(Instant when) noexcept override { now_ = std::max(now_, when); }

  /// Something comes, or nothing.
  void act() noexcept {
    switch (choices_.below(8)) {
      case 0:
        return anyReport();
      case 1:
        return anyAnswer();
      case 2:
        return goodAnswer();
      case 3:
        inputs_.number = choices_.byte();
        inputs_.outputs = choices_.byte();
        inputs_.asked = now_ - milliseconds{choices_.byte()};
        inputs_.bus_runs = choices_.below(4) != 0;
        return anyWords();
      case 4:
        break;
      default:
        report_.state = link::LinkState::kConnected;
        ++inputs_.number;
        ++report_.counters.exchanges;
        inputs_.outputs = given_;
        inputs_.asked = now_ - microseconds{4 * choices_.byte()};
        inputs_.bus_runs = choices_.below(8) != 0;
        anyWords();
    }
  }
  /// From here on no server is there; `opens`: the link goes on looking for it.
  void fallSilent(bool opens) noexcept {
    opens_ = opens;
    report_.state = link::LinkState::kPausing;
  }

  const RegisterImage& image() const noexcept { return image_; }
  const link::RegisterInputs& inputs() const noexcept { return inputs_; }
  const link::LinkCounters& counters() const noexcept { return report_.counters; }
  std::uint64_t given() const noexcept { return given_; }
  std::uint64_t images() const noexcept { return images_; }
  std::uint64_t ordered() const noexcept { return ordered_; }

 private:
  // Up to a few words more, or less, than the drives have.
  void anyWords() noexcept {
    inputs_.words.resize(choices_.below(4) == 0 ? choices_.below(16) : 10);
    for (Word& word : inputs_.words) word = anyWord(choices_);
  }
  void anyReport() noexcept {
    report_.state = static_cast<link::LinkState>(choices_.below(4));
    const bool refused = choices_.below(2) == 0;
    report_.text = refused ? "the gateway says no" : "";
    ++(refused ? report_.counters.refused_exchanges : report_.counters.timeouts);
    if (!refused && report_.state != link::LinkState::kConnected) ++report_.counters.lost;
  }
  void anyAnswer() noexcept {
    answer_.number = ordered_ - choices_.below(2);
    answer_.good = choices_.below(4) != 0;
    answer_.text = answer_.good ? "" : "the gateway says no";
    for (std::size_t i = 0; i < kBlock; ++i) answer_.values[i] = anyWord(choices_);
  }
  // What a gateway with PCP shows: the confirmation of the service in the invoke block, good or with an error.
  void goodAnswer() noexcept {
    answer_.number = ordered_;
    answer_.good = true;
    answer_.text = "";
    answer_.values = {};
    if (invoked_[kService] == 0) return;
    answer_.values[kService] = static_cast<Word>(invoked_[kService] + kConfirmation);
    answer_.values[kReference] = invoked_[kReference];
    if (choices_.below(4) == 0) {
      answer_.values[kError] = static_cast<Word>((choices_.below(10) << 8u) | choices_.below(9));
      answer_.values[kAdditional] = choices_.byte();
    }
    answer_.values[kLength] = choices_.below(6);
    answer_.values[kLength + 1] = anyWord(choices_);
  }

  fuzz::Choices& choices_;
  Instant now_{std::chrono::hours{1}};
  bool opens_ = false;
  RegisterImage image_;
  std::uint64_t given_ = 0;  // images and looks
  std::uint64_t images_ = 0;
  std::uint64_t ordered_ = 0;
  std::array<Word, link::RegisterOrder::kMostWords> invoked_{};
  link::RegisterInputs inputs_;
  link::RegisterAnswer answer_;
  link::LinkReport report_;
};

class Game {
 public:
  Game(fuzz::Choices& choices, std::uint8_t options)
      : choices_(choices),
        pcp_((options & 1u) != 0),
        running_((options & 2u) != 0),
        drivecom_((options & 4u) != 0),
        transport_([this](const link::ModbusSettings&) {
          auto link = std::make_unique<AnyLink>(choices_);
          link_ = link.get();
          return link;
        }),
        outputs_(kDrives),
        inputs_(kDrives) {
    MapSettings bus{"~bus/", {{"gateway", std::string{"gateway:502"}}, {"outputs/address", kOutputs}}};
    if (pcp_) bus.set("pcp/invoke/address", kInvoke).set("pcp/result/address", kResult);
    if (pcp_) bus.set("pcp/timeout", kParameterTimeout).set("pcp/initiate", (options & 8u) != 0);
    if (running_) bus.set("running/address", kRunning);
    if ((options & 16u) != 0) bus.set("word_order", "swapped");
    std::vector<DriveSettings> drives;
    for (std::size_t i = 0; i < kDrives; ++i) {
      const std::string name = "drive" + std::to_string(i);
      auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
      settings->set("address", static_cast<int>(1 + i)).set("series", "sk5xxe").set("pole_pairs", 2);
      settings->set("max_frequency", 50.0).set("profile", drivecom_ ? "drivecom" : "nord");
      settings->set("ppo_type", drivecom_ || (options & 32u) != 0 ? 1 : 2);
      drives.push_back({name, settings});
    }
    transport_.configure(bus, drives, 100.0);
    transport_.setDriveTimeout(kTimeout);
  }

  void play() {
    while (!choices_.empty()) {
      for (std::uint8_t i = choices_.below(4); i > 0; --i) link_->act();
      if (choices_.below(4) == 0) submit();
      for (profile::ProcessOutput& output : outputs_) {
        output.control_word = anyWord(choices_);
        output.setpoints[0] = toSigned(anyWord(choices_));
      }
      cycle();
    }
    link_->fallSilent(choices_.byte() == 0);
    for (int i = 0; !pending_.empty() || transport_.connected(); ++i) {
      require(i < 100);
      cycle();
    }
    transport_.close();
  }

 private:
  void submit() {
    profile::ParameterRequest request;
    request.id = ++last_id_;
    request.number = static_cast<std::uint16_t>(anyWord(choices_) % 1100);
    request.shape = static_cast<profile::ParameterShape>(choices_.below(4));
    request.action = static_cast<profile::ParameterAction>(choices_.below(3));
    request.parameter_set = choices_.below(6);
    request.index = choices_.byte();
    request.double_word = choices_.below(2) != 0;
    request.scales = choices_.below(2) != 0;
    request.raw = anyWord(choices_);
    if (request.scales && choices_.below(2) != 0) request.number = 105;
    const bool taken = transport_.submit(choices_.below(kDrives), request);
    if (taken) pending_.push_back(request.id);
    require(taken || pending_.size() >= profile::ParameterQueue::kCapacity);
  }

  void cycle() {
    const bool was_good = transport_.connected();
    const std::uint64_t images = link_->images(), missed = counter("without_inputs"), stops = counter("ring_stops");
    const Instant begin = link_->now();
    transport_.exchange(outputs_, inputs_);
    require(link_->now() - begin <= transport_.config().answer_window);
    checkInputs(was_good);
    if (link_->images() != images) checkImage();
    require(drivecom_ || link_->given() == link_->images());
    const bool fresh = transport_.connected() && link_->inputs().number != last_number_;
    last_number_ = link_->inputs().number;
    checkCounters(fresh, missed, stops);
    require(!transport_.busText().empty() || transport_.connected());
    while (const auto event = transport_.pollEvent()) require(!event->text.empty());
    takeResults();
    link_->sleepUntil(begin + kCycle);
  }

  void checkInputs(bool was_good) {
    const link::RegisterInputs& newest = link_->inputs();
    const bool good = newest.number != 0 && newest.bus_runs && newest.age(link_->now()) <= kTimeout;
    require(transport_.connected() == good);
    for (std::size_t i = 0; i < kDrives; ++i) {
      const DriveExchange& input = inputs_[i];
      require(input.module_answers == good && !input.inverter_missing);
      require((input.interruption != Interruption::kNone) == (was_good && !good));
      require(!input.inverter_answers || (good && newest.number != last_number_ && input.input.status_word != 0));
      require(input.inverter_answers || input.input.status_word == 0);
      require(good || transport_.note(i).text[0] != '\0');
    }
  }

  void checkImage() {
    const interbus::ImageMap& map = *transport_.config().map;
    const RegisterImage& image = link_->image();
    require(image.size() == map.outputWords());
    for (std::size_t i = 0; i < kDrives && !drivecom_; ++i) {
      const interbus::ProcessWords words = map.wordsAt(map.outputs(i), i, image);
      require(words.head == outputs_[i].control_word && words.values[0] == toWord(outputs_[i].setpoints[0]));
    }
    // Bits that DRIVECOM does not have never get out.
    for (std::size_t i = 0; i < kDrives && drivecom_; ++i) {
      require((map.wordsAt(map.outputs(i), i, image).head & ~0x08FFu) == 0);
    }
  }

  void checkCounters(bool fresh, std::uint64_t missed, std::uint64_t stops) {
    require(counter("cycles") == ++cycles_);
    require(counter("without_inputs") == missed + (fresh ? 0 : 1));
    require(counter("ring_stops") <= stops + 1);
    require(counter("exchanges") == link_->counters().exchanges);
    require(counter("timeouts") == link_->counters().timeouts);
    require(pcp_ || link_->ordered() == 0);
  }
  std::uint64_t counter(const char* name) const { return transport_.counters().value(name); }

  void takeResults() {
    while (const auto result = transport_.pollResult()) {
      const auto at = std::find(pending_.begin(), pending_.end(), result->id);
      require(at != pending_.end());
      pending_.erase(at);
      require(pcp_ || result->outcome == profile::ParameterOutcome::kNoChannel);
      require(result->outcome != profile::ParameterOutcome::kNoChannel || !result->text.empty());
    }
  }

  fuzz::Choices& choices_;
  const bool pcp_, running_, drivecom_;
  AnyLink* link_ = nullptr;
  InterbusTransport transport_;
  std::vector<profile::ProcessOutput> outputs_;
  std::vector<DriveExchange> inputs_;
  std::vector<std::uint32_t> pending_;  // ids of requests without an answer
  std::uint32_t last_id_ = 0;
  std::uint64_t last_number_ = 0;
  std::uint64_t cycles_ = 0;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Choices choices{data, size};
  const std::uint8_t options = choices.byte();
  Game{choices, options}.play();
  return 0;
}
