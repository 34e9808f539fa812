// Every order of requests, frames, silences and time-outs at the client of one explicit connection (DeviceNet).
//
// The device has no memory: any of its frames may come at any time, with the transaction bit of the request that runs or
// with the other one. That is more than a real device does, so what holds here holds for one; and it is what keeps the
// states few, since neither the requests a device has still to answer nor the frames on their way are part of a state.
// Of a long answer the fragments between the third and the last one that fits come in one event, each acknowledged.
// Left out: what comes between those; that an answer belongs to the request that caused it; and how many late answers are owed
// and how long, of which a state knows only whether there are any: that these keep a transaction id from another request is
// tested in test_explicit_channel.cpp.
#include "explore/explicit_wire.h"

namespace nord_driver::explore {
namespace {

using devicenet::ExplicitAnswer;
using devicenet::ExplicitClient;
using devicenet::ExplicitEnd;
using devicenet::ExplicitPort;
using devicenet::ExplicitRequest;
using devicenet::Heard;

// A frame that is never taken, its repetition that is not either; then what follows begins anew.
constexpr int kLongestStandstill = 2 * (kAnswerSteps + kAcknowledgeSteps);
constexpr int kAwaitAnswer = 3;  // ExplicitClient's phase
constexpr int kMostPieces = 22;  // of six bytes, of an answer: 134 bytes
constexpr unsigned kAlike = 3;   // from this fragment on all are alike, until the buffer is full

enum class Event : std::uint8_t {
  kRead,
  kReset,
  kLongWrite,
  kAllocate,  // starts kRequests[event]
  kCancel,
  kSilence,
  kTransmit,
  kAnswer,
  kError,
  kOtherService,
  kNoResponse,
  kAcknowledged,
  kTooMuch,
  kWrongAcknowledge,
  kFirst,
  kMiddle,
  kManyMiddle,
  kLast,
  kAgain,
  kWrongCount,
  kEmpty,
  kForeign,
  kLateAnswer,
  kLateAcknowledged,
  kLateFirst,
  kLateMiddle,
  kLateLast,
  kPassTime,
  kLongTime,
  kCount
};

constexpr const char* kNames[] = {"request: read an attribute",
                                  "request: reset",
                                  "request: write 13 bytes",
                                  "request: allocate",
                                  "cancel",
                                  "silence",
                                  "the link takes a frame",
                                  "device: answer",
                                  "device: error response",
                                  "device: answer of another service",
                                  "device: no response at all",
                                  "device: acknowledges the fragment",
                                  "device: too much data",
                                  "device: acknowledges another fragment",
                                  "device: first fragment",
                                  "device: next fragment",
                                  "device: next fragments, until the message is as long as can be",
                                  "device: last fragment",
                                  "device: the same fragment again",
                                  "device: a fragment left out",
                                  "device: a fragment without data",
                                  "device: an answer to another master",
                                  "device: answer to the one before",
                                  "device: acknowledges a fragment of the one before",
                                  "device: first fragment to the one before",
                                  "device: next fragment to the one before",
                                  "device: last fragment to the one before",
                                  "time: a step",
                                  "time: many steps"};

ExplicitRequest request(std::size_t kind) {
  static const ExplicitRequest read = devicenet::getAttribute(7, 4, 20, 3);
  switch (kind) {
    case 0:
      return read;
    case 1: {
      ExplicitRequest reset{7, devicenet::service::kReset, 1, 1, {}, {}};
      return reset;
    }
    case 2: {
      const std::array<std::uint8_t, 13> bytes{};  // with service, class, instance and attribute: three fragments
      return devicenet::setAttribute(7, 4, 20, 3, bytes);
    }
    default: {
      ExplicitRequest allocate{7, devicenet::service::kAllocate, 3, 1, {}, {}};
      allocate.data.push_back(1);
      allocate.data.push_back(kScanner);
      return allocate;
    }
  }
}

constexpr std::uint8_t kServices[] = {0x0E, 0x05, 0x10, 0x4B};

class ExplicitClientEvents {
 public:
  struct World {
    ExplicitClient client{kScanner, kDevice};
    Instant now{std::chrono::hours{1}};
    bool runs = false;           // a request has no answer yet
    std::uint8_t kind = 0;       // the one that ran last
    std::uint8_t given_out = 0;  // of its frames, the one that is unanswered: how often
    std::uint8_t offset = 0;     // which fragment that is
    std::uint8_t pieces = 0;     // acknowledged fragments of the request and taken ones of the answer, at most at once
    std::uint8_t still = 0;      // steps since that grew
    bool acknowledge_due = false;
  };

  World initial() const { return {}; }
  std::size_t events() const { return static_cast<std::size_t>(Event::kCount); }
  std::string name(std::size_t event) const { return kNames[event]; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const auto event = static_cast<Event>(number);
    if (number < 4) return start(world, static_cast<std::uint8_t>(number), verdict);
    switch (event) {
      case Event::kCancel:
      case Event::kSilence:
        event == Event::kCancel ? world.client.cancel() : world.client.silence();
        world.runs = world.acknowledge_due = false;
        verdict.require(!world.client.busy(), "a request goes on after it was cancelled");
        break;
      case Event::kTransmit:
        if (!transmit(world, verdict)) return false;
        break;
      case Event::kPassTime:
      case Event::kLongTime:
        pass(world, event == Event::kPassTime ? 1 : 10);
        break;
      case Event::kManyMiddle:
        if (!manyFragments(world, verdict)) return false;
        break;
      default:
        if (!frame(world, event, verdict)) return false;
    }
    takeAnswer(world, event, verdict);
    check(world, verdict);
    return true;
  }

  void describe(const World& world, Key& key) const {
    describeClient(world.client, world.now, key);
    key.add(world.runs).add(world.acknowledge_due);
    if (world.runs) key.add(world.kind).add(world.given_out).add(world.offset).add(world.pieces).add(world.still);
  }

  // With a link that takes frames and a device that answers: what runs is done, and a further read too.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    answerAll(world, of_the_way);
    verdict.require(!world.runs, "a request has no end, and the device answers");
    verdict.require(start(world, 0, of_the_way), "no further request is taken");
    answerAll(world, of_the_way);
    verdict.require(!world.runs && end_ == ExplicitEnd::kDone, "a read is not done, and the device answers");
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  void answerAll(World& world, Verdict& verdict) const {
    for (int i = 0; i < 2 * kLongestStandstill && world.runs; ++i) {
      if (apply(world, static_cast<std::size_t>(Event::kTransmit), verdict)) continue;
      apply(world, static_cast<std::size_t>(Event::kAcknowledged), verdict);
      if (world.runs && !explicitWantsFrame(world)) apply(world, static_cast<std::size_t>(Event::kAnswer), verdict);
    }
  }
  // It has a frame to give out.
  static bool explicitWantsFrame(const World& world) {
    World copy = world;
    CanFrame frame;
    return copy.client.pollTransmit(frame, copy.now);
  }

  static bool start(World& world, std::uint8_t kind, Verdict& verdict) {
    const bool taken =
        world.client.start(request(kind), kind == 3 ? ExplicitPort::kUnconnected : ExplicitPort::kConnected,
                           devicenet::BodyFormat::k8Over8, kAnswerSteps * kWireStep, world.now);
    verdict.require(taken != world.runs, "a request is taken while one runs, or is not although none does");
    if (!taken) return false;
    world.runs = true;
    world.kind = kind;
    world.given_out = world.offset = world.pieces = world.still = 0;
    return true;
  }

  static bool transmit(World& world, Verdict& verdict) {
    CanFrame frame;
    const bool due = world.acknowledge_due;
    if (!world.client.pollTransmit(frame, world.now)) {
      verdict.require(!due, "a fragment is not acknowledged");
      return false;
    }
    world.acknowledge_due = false;
    const bool fragment = (frame.data[0] & 0x80u) != 0;
    const bool acknowledge = fragment && (frame.data[1] & 0xC0u) == 0xC0u;
    verdict.require(acknowledge == due, "an acknowledge nobody waits for, or another frame in its place");
    if (acknowledge) return true;
    verdict.require(world.runs, "a frame of a request that nobody waits for");
    verdict.require(frame.id == (0x400u | kDevice << 3u | (world.kind == 3 ? 6u : 4u)),
                    "a frame with a wrong identifier");
    const auto offset = static_cast<std::uint8_t>(fragment ? (frame.data[1] & 0x3Fu) : 0u);
    if (offset != world.offset) world.given_out = 0;
    world.offset = offset;
    ++world.given_out;
    verdict.require(world.given_out <= (world.kind == 1 ? 1 : 2),
                    "a frame is given out more often than twice, a reset twice");
    return true;
  }

  static void pass(World& world, int steps) {
    world.now += steps * kWireStep;
    world.client.poll(world.now);
    world.still = static_cast<std::uint8_t>(std::min(world.still + (steps > 1 ? 0 : 1), kLongestStandstill + 1));
  }

  static bool manyFragments(World& world, Verdict& verdict) {
    const auto& receiver = explicitReceiverOf(world.client);
    if (!world.runs || !receiverAssemblingOf(receiver) || receiverCountOf(receiver) != kAlike) return false;
    while (receiverCountOf(receiver) < kMostPieces) {
      frame(world, Event::kMiddle, verdict, true);
      if (!world.acknowledge_due) return false;
      transmit(world, verdict);
    }
    return true;
  }

  static bool frame(World& world, Event event, Verdict& verdict, bool one_of_many = false) {
    const bool current = explicitXidOf(world.client);
    const auto& receiver = explicitReceiverOf(world.client);
    const auto response = static_cast<std::uint8_t>(kServices[world.kind] | 0x80u);
    const auto piece = [&](unsigned type, bool xid, unsigned count, std::vector<std::uint8_t> data) {
      data.insert(data.begin(), static_cast<std::uint8_t>(type << 6u | (count & 0x3Fu)));
      return explicitFrame(true, xid, std::move(data));
    };
    const unsigned next = receiverCountOf(receiver);
    const bool alike = !one_of_many && receiverAssemblingOf(receiver) && next >= kAlike && next < kMostPieces;
    CanFrame frame;
    bool own = true;
    switch (event) {
      case Event::kAnswer:
      case Event::kLateAnswer:
        own = event == Event::kAnswer;
        frame = explicitFrame(false, current == own, {response, 1});
        break;
      case Event::kError:
        frame = explicitFrame(false, current, {0x94, 0x14, 0xFF});
        break;
      case Event::kOtherService:
        frame = explicitFrame(false, current, {static_cast<std::uint8_t>(response ^ 0x03u), 1});
        break;
      case Event::kNoResponse:
        frame = explicitFrame(false, current, {kServices[world.kind], 1});
        break;
      case Event::kAcknowledged:
      case Event::kLateAcknowledged:
      case Event::kTooMuch:
      case Event::kWrongAcknowledge: {
        own = event != Event::kLateAcknowledged;
        const unsigned count = explicitCountOf(world.client) + (event == Event::kWrongAcknowledge ? 1u : 0u);
        frame = piece(3, current == own, count, {static_cast<std::uint8_t>(event == Event::kTooMuch ? 1 : 0)});
        break;
      }
      case Event::kFirst:
      case Event::kLateFirst:
        own = event == Event::kFirst;
        frame = piece(0, current == own, 0, {response, 0, 0, 0, 0, 0});
        break;
      case Event::kMiddle:
      case Event::kLateMiddle: {
        own = event == Event::kMiddle;
        if (alike) return false;
        const auto mark = static_cast<std::uint8_t>(next);
        frame = piece(1, current == own, next, {mark, mark, mark, mark, mark, mark});
        break;
      }
      case Event::kLast:
      case Event::kLateLast:
        own = event == Event::kLast;
        frame = piece(2, current == own, next, {static_cast<std::uint8_t>(next)});
        break;
      case Event::kAgain: {
        const auto& last = receiverLastOf(receiver);
        if (!last) return false;
        const unsigned type = last->byte >> 6u;
        const auto mark = static_cast<std::uint8_t>(last->byte & 0x3Fu);
        std::vector<std::uint8_t> data(type == 2 ? 1 : 6, mark);
        if (type == 0) data[0] = response;
        frame = piece(type, last->xid, mark, data);
        own = last->xid == current;
        break;
      }
      case Event::kWrongCount:
        frame = piece(1, current, next + 1, {9});
        break;
      case Event::kEmpty:
        frame = piece(1, current, next, {});
        break;
      default:
        frame = explicitFrame(false, current, {response, 1}, kScanner + 1);
        break;
    }
    const auto before = explicitAcknowledgeOf(world.client);
    const auto& last = receiverLastOf(receiver);
    const bool again = last && last->byte == frame.data[1] && last->xid == ((frame.data[0] & 0x40u) != 0);
    const Heard heard = world.client.handle(frame, world.now);
    verdict.require(heard != Heard::kTaken || (world.runs && own),
                    "a frame is taken that belongs to no request that runs");
    verdict.require(event != Event::kForeign || heard == Heard::kForeign, "an answer to another master is not told");
    const bool progress = heard == Heard::kTaken;
    world.acknowledge_due = explicitAcknowledgeOf(world.client).has_value();
    const bool is_piece =
        event == Event::kFirst || event == Event::kMiddle || event == Event::kLast || event == Event::kAgain;
    verdict.require(!progress || !is_piece || world.acknowledge_due, "a fragment is taken and not acknowledged");
    verdict.require(progress || again || before.has_value() == world.acknowledge_due,
                    "a fragment is acknowledged that was not taken");
    countPieces(world);
    return true;
  }

  // How far it has come: never back again.
  static void countPieces(World& world) {
    const auto sent = static_cast<unsigned>(explicitOffsetOf(world.client) / 6);
    const auto& receiver = explicitReceiverOf(world.client);
    const unsigned taken = receiverAssemblingOf(receiver) ? receiverCountOf(receiver) : 0u;
    const bool all_sent = static_cast<int>(explicitPhaseOf(world.client)) == kAwaitAnswer;
    const auto pieces = static_cast<std::uint8_t>(sent + taken + (all_sent || taken > 0 ? 1u : 0u));
    if (pieces <= world.pieces) return;
    world.pieces = pieces;
    world.still = 0;
  }

  void takeAnswer(World& world, Event event, Verdict& verdict) const {
    const auto answer = world.client.takeAnswer();
    if (!answer) return;
    verdict.require(world.runs, "an answer without a request");
    verdict.require(!world.client.takeAnswer(), "a request has two answers");
    verdict.require(answer->id == 7, "the answer does not bear the id of its request");
    end_ = answer->end;
    world.runs = false;
    if (answer->end != ExplicitEnd::kDone) return;
    verdict.require(event == Event::kAnswer || event == Event::kLast, "done without an answer");
    if (event == Event::kAnswer) {
      verdict.require(answer->data.size() == 1 && answer->data[0] == 1, "the answer is not what the device said");
    } else {
      verdict.require(isWhole(answer->data), "the fragments are not put together as they were sent");
    }
  }

  // Five bytes 0 of the first fragment, six of each between, one of the last, each with the count of its fragment.
  static bool isWhole(const devicenet::ExplicitData& data) {
    for (std::size_t i = 0; i < data.size(); ++i) {
      if (data[i] != (i + 1) / 6) return false;
    }
    return data.size() >= 6 && data.size() % 6 == 0;
  }

  static void check(World& world, Verdict& verdict) {
    verdict.require(world.client.busy() == world.runs, "busy without a request, or a request at a client that is not");
    verdict.require(!world.runs || world.client.nextDeadline().has_value(), "a request waits, and no time-out with it");
    verdict.require(!world.runs || world.still <= kLongestStandstill, "a request goes on without coming any further");
    verdict.require(world.pieces <= kMostPieces + 3, "a message has no end");
  }

  mutable ExplicitEnd end_ = ExplicitEnd::kDone;  // of the last answer
};

TEST(ExplicitClientEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(ExplicitClientEvents{}, "ExplicitClient (DeviceNet)", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
