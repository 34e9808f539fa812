// Every order of requests, answers, losses and time-outs at the acyclic channel of one slave (MS1).
#include "explore/private_member.h"
#include "explore/record_server.h"
#include "profibus/record_channel.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(recordStateOf, profibus::RecordChannel, state_)
NORD_EXPLORE_MEMBER(recordRequestOf, profibus::RecordChannel, request_)
NORD_EXPLORE_MEMBER(recordGivenUpOf, profibus::RecordChannel, given_up_)
NORD_EXPLORE_MEMBER(recordNoResourceOf, profibus::RecordChannel, no_resource_)
NORD_EXPLORE_MEMBER(recordTimersOf, profibus::RecordChannel, timers_)

namespace {

using profibus::FdlAnswer;
using profibus::RecordChannel;
using profibus::RecordOutcome;

constexpr Duration kStepTime = std::chrono::milliseconds{500};  // a busy read is repeated for 1 s at least
constexpr int kResponseTimeout = 3;                             // steps

enum class Event : std::uint8_t {
  kRead,
  kWrite,
  kReadOther,  // submits recordRequest(event)
  kTaken,
  kLost,
  kTakenAnswerLost,
  kResponse,
  kAtOnce,
  kNegative,
  kBusy,
  kOther,
  kNotActivated,
  kNoResource,
  kPassTime,
  kLongTime,
  kOffline,
  kGoneOnWith,
  kCount
};

constexpr const char* kNames[] = {"",
                                  "",
                                  "",
                                  "telegram: acknowledged without data",
                                  "telegram: lost",
                                  "telegram: arrived, its answer lost",
                                  "telegram: the response that waits",
                                  "telegram: carried out and answered at once",
                                  "telegram: a negative response",
                                  "telegram: busy",
                                  "telegram: the response to another record",
                                  "telegram: RS, not activated",
                                  "telegram: RR, no resource",
                                  "time: a step",
                                  "time: many steps",
                                  "the slave leaves data exchange, and starts up anew",
                                  "the slave is not heard for a moment, and gone on with"};

class RecordEvents {
 public:
  struct World {
    RecordChannel channel{0, kResponseTimeout* kStepTime};
    RecordServer server;
    Instant now{std::chrono::hours{1}};
    bool runs = false;          // a request has no result yet
    std::uint8_t kind = 0;      // which one
    bool sent = false;          // it went out
    std::uint8_t steps = 0;     // since it was asked
    std::uint8_t given_up = 0;  // steps since a request ended whose response may still come
  };

  World initial() const { return {}; }
  std::size_t events() const { return static_cast<std::size_t>(Event::kCount); }
  std::string name(std::size_t event) const { return event < 3 ? kRecordNames[event] : kNames[event]; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const auto event = static_cast<Event>(number);
    if (number < 3) return submit(world, static_cast<std::uint8_t>(number), verdict);
    if (event == Event::kPassTime || event == Event::kLongTime) {
      pass(world, event == Event::kPassTime ? 1 : 10, verdict);
      return true;
    }
    if (event == Event::kOffline) {
      world.channel.handleOffline(world.now);
      world.channel.handleStartUp();
      world.server = {};  // the standard: a slave forgets its acyclic channel when it leaves data exchange
      return endsBy(world, verdict);
    }
    if (event == Event::kGoneOnWith) {
      world.channel.handleOffline(world.now);  // and the slave has forgotten nothing
      return endsBy(world, verdict);
    }
    return telegram(world, event, verdict);
  }

  void describe(const World& world, Key& key) const {
    key.add(recordGivenUpOf(world.channel)).add(recordNoResourceOf(world.channel));
    describeTimers(recordTimersOf(world.channel), world.now, kStepTime, 2 * kResponseTimeout, key);
    const auto& request = recordRequestOf(world.channel);
    key.add(recordStateOf(world.channel));
    if (world.runs) key.add(request.index).add(request.write).add(world.kind).add(world.steps).add(world.sent);
    key.add(world.runs).add(world.server.has ? world.given_up : std::uint8_t{0});
    world.server.describe(key);
  }

  // With a slave that answers at once: what runs ends, and a further read is carried out.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    answerAll(world, of_the_way);
    verdict.require(!world.runs, "a request has no end, and the slave answers");
    verdict.require(submit(world, 2, of_the_way), "no further request is taken");
    answerAll(world, of_the_way);
    verdict.require(!world.runs && done_, "a read is not carried out, and the slave answers");
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  void answerAll(World& world, Verdict& verdict) const {
    for (int i = 0; i < 3 * kResponseTimeout && world.runs; ++i) {
      for (const Event event : {Event::kResponse, Event::kAtOnce, Event::kTaken}) {
        if (telegram(world, event, verdict)) break;
      }
      pass(world, 1, verdict);
    }
  }

  bool endsBy(World& world, Verdict& verdict) const {
    takeResult(world, false, verdict);
    verdict.require(!world.runs, "a request outlives the loss of its slave");
    return true;
  }

  static bool submit(World& world, std::uint8_t kind, Verdict& verdict) {
    if (world.runs) return false;
    verdict.require(world.channel.submit(recordRequest(kind), std::nullopt), "a request is not taken, and none runs");
    world.runs = true;
    world.kind = kind;
    world.sent = false;
    world.steps = 0;
    world.server.current = false;
    return true;
  }

  void pass(World& world, int steps, Verdict& verdict) const {
    world.now += steps * kStepTime;
    if (world.server.has && !(world.runs && world.server.current)) {
      world.given_up = static_cast<std::uint8_t>(std::min(world.given_up + steps, kResponseTimeout));
    }
    world.channel.wantsTelegram(world.now);
    world.steps = static_cast<std::uint8_t>(std::min(world.steps + steps, 5 * kResponseTimeout));
    takeResult(world, false, verdict);
    // The late response to the one before, its own, and the repetitions of a busy one. It counts from when telegrams go.
    verdict.require(!world.runs || steps > 1 || !world.sent || world.steps <= 4 * kResponseTimeout,
                    "a request has no end");
    if (!world.runs || !world.sent) world.steps = 0;
  }

  bool telegram(World& world, Event event, Verdict& verdict) const {
    if (!world.channel.wantsTelegram(world.now)) return false;
    const ByteView pdu = world.channel.pollTelegram(world.now);
    const bool request = !pdu.empty();
    verdict.require(world.runs || !request, "a request is sent that nobody waits for");
    if (request) world.sent = true;
    const RecordServer before = world.server;
    const bool needs_response = event == Event::kResponse && !before.has;
    const bool needs_request = (event == Event::kAtOnce || event == Event::kTakenAnswerLost) && !request;
    const bool needs_own = (event == Event::kNegative || event == Event::kBusy) && !request && !before.current;
    // It has one response at most.
    if (event == Event::kOther && before.has) return false;
    if (needs_response || needs_request || needs_own) return false;
    // Nobody can wait for ever: a response that is not there a whole response time after its request was given up does
    // not come at all. One that is there waits.
    if (event == Event::kTaken && before.has && !before.current && world.given_up >= kResponseTimeout)
      world.server = {};
    if (request && event != Event::kLost && event != Event::kNoResource && event != Event::kNotActivated) {
      world.server.take(pdu);
    }
    FdlAnswer answer;
    std::vector<std::uint8_t> bytes;
    bool own = true;
    switch (event) {
      case Event::kLost:
      case Event::kTakenAnswerLost:
        world.channel.handleNoAnswer(world.now);
        takeResult(world, false, verdict);
        return true;
      case Event::kTaken:
        break;
      case Event::kResponse:
        bytes = before.positive();
        own = before.current;
        if (!request) world.server = {};
        break;
      case Event::kAtOnce:
        bytes = world.server.positive();
        world.server = {};
        break;
      case Event::kNegative:
      case Event::kBusy:
        bytes = world.server.negative(event == Event::kBusy ? 0xB5 : 0xB1);
        world.server = {};
        break;
      case Event::kOther:
        bytes = {0x5E, 0, 104, 8, 0, 0, 0, 0, 0, 0, 0, 0};
        break;
      case Event::kNotActivated:
        answer.code = profibus::ResponseCode::kNotActivated;
        world.server = {};
        break;
      default:
        answer.code = profibus::ResponseCode::kNoResource;
        break;
    }
    if (!bytes.empty()) {
      answer.kind = FdlAnswer::Kind::kData;
      answer.data = ByteView{bytes};
    } else if (event != Event::kTaken) {
      answer.kind = FdlAnswer::Kind::kRefusal;
    }
    world.channel.handleAnswer(answer, world.now);
    takeResult(world, own, verdict);
    return true;
  }

  void takeResult(World& world, bool own, Verdict& verdict) const {
    const auto result = world.channel.pollResult();
    if (!result) return;
    verdict.require(world.runs, "a result without a request");
    const profibus::RecordRequest asked = recordRequest(world.kind);
    verdict.require(result->index == asked.index && result->write == asked.write, "the result of another request");
    done_ = result->outcome == RecordOutcome::kDone;
    verdict.require(!done_ || own, "an answer from before the request is taken for its own");
    world.runs = false;
    if (world.server.current) world.given_up = 0;
    verdict.require(!world.channel.pollResult(), "a request has two results");
  }

  mutable bool done_ = false;  // the last result was
};

TEST(RecordEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(RecordEvents{}, "RecordChannel (MS1)", 100);
}

}  // namespace
}  // namespace nord_driver::explore
