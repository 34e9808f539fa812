// Every order of requests, answers, losses and time-outs at the parameter channel of one inverter (PKW). The inverter
// takes its time, shows the answer to an order one exchange after it was carried out, or answers with an error, and
// somebody else's answers stand there too.
#include <vector>

#include "explore/explorer.h"
#include "explore/private_member.h"
#include "profile/pkw_channel.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(pkwOrderOf, profile::PkwChannel, order_)
NORD_EXPLORE_MEMBER(pkwPhaseOf, profile::PkwChannel, phase_)
NORD_EXPLORE_MEMBER(pkwDeadlineOf, profile::PkwChannel, deadline_)
NORD_EXPLORE_MEMBER(pkwPreparedOf, profile::PkwChannel, prepared_)
NORD_EXPLORE_MEMBER(pkwFellBackOf, profile::PkwChannel, fell_back_)
NORD_EXPLORE_MEMBER(pkwPauseSentOf, profile::PkwChannel, pause_sent_)
NORD_EXPLORE_MEMBER(pkwLastUnansweredOf, profile::PkwChannel, last_unanswered_)
NORD_EXPLORE_MEMBER(pkwLastWordsOf, profile::PkwChannel, last_words_)

namespace {

using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::PkwChannel;
using profile::PkwWords;

constexpr Duration kExchange = std::chrono::milliseconds{10};
constexpr int kAnswerTimeout = 4;  // exchanges
constexpr std::size_t kAtOnce = 2;

std::vector<ParameterRequest> requests() {
  ParameterRequest read, other, write, array;
  read.number = 102;
  other.number = 103;
  write.number = 102;
  write.action = profile::ParameterAction::kWriteRam;
  write.raw = 7;
  array.number = 700;
  array.shape = profile::ParameterShape::kArray;
  return {read, other, write, array};
}

enum class Event : std::uint8_t {
  kRead,
  kReadOther,
  kWrite,
  kReadArray,  // submits requests()[event]
  kOldAnswer,
  kExecute,
  kExecuteUnseen,
  kNoAnswer,
  kError,
  kNotIndexed,
  kForeign,
  kLost,
  kOffline,
  kRefused,
  kLate,
  kCount
};

constexpr const char* kNames[] = {"request: read P102",
                                  "request: read P103",
                                  "request: write P102",
                                  "request: read P700",
                                  "exchange: the answer that stands",
                                  "exchange: carried out and answered",
                                  "exchange: carried out, the answer before it",
                                  "exchange: empty",
                                  "exchange: error 2",
                                  "exchange: error 4, not indexed",
                                  "exchange: somebody else's answer",
                                  "exchange: no telegram back",
                                  "offline",
                                  "refused by what carries the words",
                                  "a long time"};

/// What the inverter shows, and whether it was asked for it by the request that runs now.
struct Shown {
  PkwWords words{};
  bool current = false;
};

PkwWords answerTo(const PkwWords& order) {
  const unsigned label = order[0] >> 12;
  if (label == 0) return {};
  const auto head = [&](unsigned ak) { return static_cast<Word>((order[0] & 0x0FFFu) | ak << 12); };
  const bool array = label == 6 || label == 7 || label == 12;
  const bool write = label == 2 || label == 7 || label == 12 || label == 14;
  const Word value = write ? order[3] : static_cast<Word>(order[0] & 0x0FFFu);
  return {head(array ? 4 : 1), static_cast<Word>(array ? order[1] : 0), 0, value};
}

PkwWords errorTo(const PkwWords& order, Word number) {
  return {static_cast<Word>((order[0] & 0x0FFFu) | 0x7000u), order[1], 0, number};
}

class PkwEvents {
 public:
  struct World {
    PkwChannel channel{kAnswerTimeout * kExchange};
    Instant now{std::chrono::hours{1}};
    Shown shown;                        // the answer that stands
    std::vector<std::uint8_t> waiting;  // which of requests(), the running one first
    std::uint8_t age = 0;               // exchanges since the running one was the first
    bool must_pause = false;            // the order of a request that has ended is out
  };

  World initial() const { return {}; }
  std::size_t events() const { return static_cast<std::size_t>(Event::kCount); }
  std::string name(std::size_t event) const { return kNames[event]; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const auto event = static_cast<Event>(number);
    switch (event) {
      case Event::kRead:
      case Event::kReadOther:
      case Event::kWrite:
      case Event::kReadArray:
        return submit(world, static_cast<std::uint8_t>(number), verdict);
      case Event::kOffline:
        world.channel.handleOffline(world.now);
        takeResults(world, {}, verdict);
        verdict.require(world.waiting.empty(), "a request outlives the loss of its inverter");
        return true;
      case Event::kRefused:
        world.channel.handleRefusal(profile::ParameterReason::kOther, {});
        takeResults(world, {}, verdict);
        return true;
      case Event::kLate:
        world.now += 10 * kExchange;
        exchange(world, Event::kOldAnswer, verdict);
        return true;
      default:
        exchange(world, event, verdict);
        return true;
    }
  }

  void describe(const World& world, Key& key) const {
    const PkwChannel& channel = world.channel;
    const auto words = [&](const PkwWords& four) {
      for (const Word word : four) key.add(word);
    };
    const bool prepared = pkwPreparedOf(channel);
    key.add(pkwPhaseOf(channel)).add(prepared).add(pkwPauseSentOf(channel)).add(pkwLastUnansweredOf(channel));
    if (prepared)
      key.add(pkwFellBackOf(channel)).add(ticks(world.now, pkwDeadlineOf(channel), kExchange, kAnswerTimeout));
    if (prepared || !world.waiting.empty()) words(toWords(pkwOrderOf(channel)));
    words(pkwLastWordsOf(channel));
    words(world.shown.words);
    key.add(world.shown.current).add(world.age).add(world.must_pause).add(world.waiting.size());
    for (const std::uint8_t kind : world.waiting) key.add(kind);
  }

  // With an inverter that answers: all that waits ends, and a further read is carried out.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    for (std::size_t i = 0; i < 6 * kAtOnce && !world.waiting.empty(); ++i)
      exchange(world, Event::kExecute, of_the_way);
    verdict.require(world.waiting.empty(), "a request has no end, and the inverter answers");
    ParameterRequest last = requests()[1];
    last.id = 99;
    verdict.require(world.channel.submit(last, world.now), "no further request is taken");
    for (int i = 0; i < kAnswerTimeout; ++i) {
      world.channel.handleWords(answerTo(world.channel.pollWords(world.now)), world.now);
      world.now += kExchange;
    }
    const auto result = world.channel.pollResult();
    verdict.require(result && result->id == 99 && result->outcome == ParameterOutcome::kDone,
                    "a read is not carried out, and the inverter answers");
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  static bool submit(World& world, std::uint8_t kind, Verdict& verdict) {
    if (world.waiting.size() == kAtOnce) return false;
    ParameterRequest request = requests()[kind];
    request.id = static_cast<std::uint32_t>(kind) + 1;
    world.waiting.push_back(kind);
    if (world.waiting.size() == 1) begin(world);
    verdict.require(world.channel.submit(request, world.now), "a request is not taken, and there is room");
    return true;
  }

  /// Another request runs from now on: no answer is its own yet.
  static void begin(World& world) {
    world.shown.current = false;
    world.age = 0;
  }

  static void exchange(World& world, Event event, Verdict& verdict) {
    const PkwWords order = world.channel.pollWords(world.now);
    takeResults(world, {}, verdict);  // what has timed out
    const bool is_order = order[0] >> 12 != 0;
    verdict.require(!is_order || !world.must_pause, "an order follows the one before without a pause");
    verdict.require(!is_order || !world.waiting.empty(), "an order is left standing without a request");
    world.must_pause = false;
    Shown seen = world.shown;
    const Shown carried_out{answerTo(order), true};
    if (event == Event::kExecute) seen = world.shown = carried_out;
    if (event == Event::kExecuteUnseen) world.shown = carried_out;
    if (event == Event::kNoAnswer) seen = world.shown = Shown{};
    if (event == Event::kError && is_order) seen = world.shown = {errorTo(order, 2), true};
    if (event == Event::kNotIndexed && is_order) seen = world.shown = {errorTo(order, 4), true};
    if (event == Event::kForeign) seen = world.shown = {{0x17D0, 0, 0, 1}, false};
    if (event != Event::kLost) world.channel.handleWords(seen.words, world.now);
    world.now += kExchange;
    if (!world.waiting.empty()) ++world.age;
    if (takeResults(world, seen, verdict)) world.must_pause = is_order;
    // The end of its time is seen before the next exchange.
    verdict.require(world.age <= kAnswerTimeout, "a request outlives its time");
    world.age = std::min<std::uint8_t>(world.age, kAnswerTimeout + 1);
  }

  static bool takeResults(World& world, const Shown& seen, Verdict& verdict) {
    bool any = false;
    while (const auto result = world.channel.pollResult()) {
      verdict.require(!world.waiting.empty(), "a result without a request");
      if (world.waiting.empty()) return true;
      const std::uint8_t kind = world.waiting.front();
      verdict.require(result->id == static_cast<std::uint32_t>(kind) + 1, "the result of another request");
      if (result->outcome == ParameterOutcome::kDone ||
          (result->outcome == ParameterOutcome::kRefused && seen.words[0] != 0)) {
        verdict.require(seen.current, "an answer from before the request is taken for its own");
      }
      world.waiting.erase(world.waiting.begin());
      begin(world);
      any = true;
    }
    return any;
  }
};

TEST(PkwEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(PkwEvents{}, "PkwChannel", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
