// Every order of requests, answers, aborts, losses and time-outs at a connection of class 2 (MS2).
#include "explore/private_member.h"
#include "explore/record_server.h"
#include "profibus/class2_connection.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(class2StepOf, profibus::Class2Connection, step_)
NORD_EXPLORE_MEMBER(class2RecordOf, profibus::Class2Connection, record_)
NORD_EXPLORE_MEMBER(class2RequestOf, profibus::Class2Connection, request_)
NORD_EXPLORE_MEMBER(class2TimersOf, profibus::Class2Connection, timers_)
NORD_EXPLORE_MEMBER(idleToSendOf, profibus::Class2Connection, idle_to_send_)
NORD_EXPLORE_MEMBER(idleSentOf, profibus::Class2Connection, idle_sent_)
NORD_EXPLORE_MEMBER(reopenedOf, profibus::Class2Connection, reopened_)

namespace {

using profibus::Class2Connection;
using profibus::FdlAnswer;
using profibus::RecordOutcome;

constexpr Duration kStepTime = std::chrono::milliseconds{500};
constexpr int kResponseTimeout = 3;  // steps
constexpr int kIdleTime = 2;         // steps

enum class Event : std::uint8_t {
  kRead,
  kWrite,
  kReadOther,  // submits recordRequest(event)
  kTaken,
  kLost,
  kTakenAnswerLost,
  kAnswer,
  kNegative,
  kBusy,
  kAbort,
  kOther,
  kNotActivated,
  kNoResource,
  kPassTime,
  kLongTime,
  kClose,
  kDrop,
  kCount
};

constexpr const char* kNames[] = {"",
                                  "",
                                  "",
                                  "telegram: acknowledged without data",
                                  "telegram: lost",
                                  "telegram: arrived, its answer lost",
                                  "telegram: the answer",
                                  "telegram: a negative answer",
                                  "telegram: busy",
                                  "telegram: the slave aborts",
                                  "telegram: something else",
                                  "telegram: RS, not activated",
                                  "telegram: RR, no resource",
                                  "time: a step",
                                  "time: many steps",
                                  "the program needs the connection no more",
                                  "nothing can be sent any more"};

/// What the slave has to say next, in the order in which it was asked.
struct Server {
  bool grants = false, accepts = false, idles = false;
  RecordServer record;

  void take(ByteView pdu) {
    switch (pdu[0]) {
      case 0x57:
        *this = {};
        grants = true;
        return;
      case 0x58:
        *this = {};
        return;
      case 0x48:
        idles = true;
        return;
      default:
        return record.take(pdu);
    }
  }
  bool speaks() const { return grants || accepts || idles || record.has; }
};

class Class2Events {
 public:
  struct World {
    Class2Connection connection{0, {3 * kIdleTime * kStepTime, kResponseTimeout* kStepTime}};
    Server server;
    Instant now{std::chrono::hours{1}};
    bool runs = false;
    std::uint8_t kind = 0;
    std::uint8_t steps = 0;  // since the request was asked, as long as telegrams go
    bool went = false;       // a telegram, in this step
  };

  World initial() const { return {}; }
  std::size_t events() const { return static_cast<std::size_t>(Event::kCount); }
  std::string name(std::size_t event) const { return event < 3 ? kRecordNames[event] : kNames[event]; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const auto event = static_cast<Event>(number);
    if (number < 3) return submit(world, static_cast<std::uint8_t>(number), verdict);
    switch (event) {
      case Event::kPassTime:
      case Event::kLongTime:
        pass(world, event == Event::kPassTime ? 1 : 10, verdict);
        return true;
      case Event::kClose:
        world.connection.close();
        break;
      case Event::kDrop:
        world.connection.drop(RecordOutcome::kOffline, "");
        break;
      default:
        return telegram(world, event, verdict);
    }
    takeResult(world, false, verdict);
    verdict.require(!world.runs, "a request outlives its connection");
    return true;
  }

  void describe(const World& world, Key& key) const {
    const Class2Connection& connection = world.connection;
    key.add(class2StepOf(connection)).add(class2RecordOf(connection));
    key.add(idleToSendOf(connection)).add(idleSentOf(connection)).add(world.runs);
    describeTimers(class2TimersOf(connection), world.now, kStepTime, 2 * kResponseTimeout, key);
    if (world.runs) {
      key.add(world.kind).add(class2RequestOf(connection).index).add(reopenedOf(connection));
      key.add(world.steps).add(world.went);
    }
    key.add(world.server.grants).add(world.server.accepts).add(world.server.idles);
    world.server.record.describe(key);
  }

  // With a slave that answers: what runs ends, and a further read is carried out.
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
    for (int i = 0; i < 30 && world.runs; ++i) {
      if (!telegram(world, Event::kAnswer, verdict)) telegram(world, Event::kTaken, verdict);
      if (i % 8 == 7) pass(world, 1, verdict);
    }
  }

  static bool submit(World& world, std::uint8_t kind, Verdict& verdict) {
    if (world.runs) return false;
    verdict.require(world.connection.submit(recordRequest(kind)), "a request is not taken, and none runs");
    world.runs = true;
    world.kind = kind;
    world.steps = 0;
    world.went = false;
    world.server.record.current = false;
    return true;
  }

  void pass(World& world, int steps, Verdict& verdict) const {
    world.now += steps * kStepTime;
    const bool wants = world.connection.wantsTelegram(world.now);
    takeResult(world, false, verdict);
    verdict.require(!world.runs || wants, "a request waits, and nothing is sent");
    // What was under way before; to connect, twice at most; the record, and its repetitions while it is busy: seven
    // response times, each seen to be over late.
    if (world.went)
      world.steps =
          static_cast<std::uint8_t>(std::min(world.steps + std::min(steps, kResponseTimeout), 15 * kResponseTimeout));
    verdict.require(!world.runs || world.steps <= 14 * kResponseTimeout, "a request has no end");
    world.went = false;
  }

  bool telegram(World& world, Event event, Verdict& verdict) const {
    if (!world.connection.wantsTelegram(world.now)) return false;
    const Class2Connection::Outgoing out = world.connection.pollTelegram(world.now);
    const bool request = !out.pdu.empty();
    Server& server = world.server;
    const bool answers = event == Event::kAnswer || event == Event::kNegative || event == Event::kBusy;
    if (answers && (request || !server.speaks())) return false;
    if ((event == Event::kNegative || event == Event::kBusy) && server.grants) return false;
    if (event == Event::kBusy && !server.record.has) return false;
    if (event == Event::kTakenAnswerLost && !request) return false;
    world.went = true;
    const bool arrives = event != Event::kLost && event != Event::kNoResource && event != Event::kNotActivated;
    if (request && arrives) server.take(out.pdu);
    if (event == Event::kLost || event == Event::kTakenAnswerLost) {
      world.connection.handleNoAnswer(profibus::Mismatch::kNone);
      takeResult(world, false, verdict);
      return true;
    }
    FdlAnswer answer;
    bool own = true;
    const std::vector<std::uint8_t> bytes = answerOf(server, event, own);
    if (!bytes.empty()) {
      answer.kind = FdlAnswer::Kind::kData;
      answer.data = ByteView{bytes};
    } else if (event == Event::kNotActivated || event == Event::kNoResource) {
      answer.kind = FdlAnswer::Kind::kRefusal;
      answer.code =
          event == Event::kNotActivated ? profibus::ResponseCode::kNotActivated : profibus::ResponseCode::kNoResource;
      if (event == Event::kNotActivated) server = {};
    }
    world.connection.handleAnswer(answer, world.now);
    takeResult(world, own, verdict);
    return true;
  }

  static std::vector<std::uint8_t> answerOf(Server& server, Event event, bool& own) {
    switch (event) {
      case Event::kAbort:
        server = {};
        return {0x58, 0x01, 0x13};
      case Event::kOther:
        return {0x5E, 0, 104, 8, 0, 0, 0, 0, 0, 0, 0, 0};
      case Event::kAnswer:
      case Event::kNegative:
      case Event::kBusy:
        break;
      default:
        return {};
    }
    if (server.grants) {
      server.grants = false;
      server.accepts = true;
      return {0x56, 0x30, 0x00, 0x14};
    }
    if (server.accepts) {
      server.accepts = false;
      if (event == Event::kNegative) return {0xD7, 0x80, 0xA9, 0x00};
      return {0x57, 0xF0, 0x01, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 0, 0, 0};
    }
    if (server.idles && event == Event::kAnswer) {
      server.idles = false;
      return {0x48};
    }
    own = server.record.current;
    const RecordServer record = server.record;
    server.record = {};
    if (event == Event::kAnswer) return record.positive();
    return record.negative(event == Event::kBusy ? 0xB5 : 0xB1);
  }

  void takeResult(World& world, bool own, Verdict& verdict) const {
    const auto result = world.connection.pollResult();
    if (!result) return;
    verdict.require(world.runs, "a result without a request");
    const profibus::RecordRequest asked = recordRequest(world.kind);
    verdict.require(result->index == asked.index && result->write == asked.write, "the result of another request");
    done_ = result->outcome == RecordOutcome::kDone;
    verdict.require(!done_ || own, "an answer from before the request is taken for its own");
    world.runs = false;
    verdict.require(!world.connection.pollResult(), "a request has two results");
  }

  mutable bool done_ = false;  // the last result was
};

TEST(Class2EventsTest, EveryOrderKeepsTheRules) {
  exploreAll(Class2Events{}, "Class2Connection (MS2)", 100);
}

}  // namespace
}  // namespace nord_driver::explore
