// Every order of requests, answers, losses and time-outs where the engine and the layer above share the explicit messages
// with one device (DeviceNet): each request has one answer, in turn and in time, and neither keeps the other from its turn.
//
// All requests are one frame long: what fragments do is explored at the client below. The device has no memory, as there.
// Left out: more than two requests of the layer above at a time.
#include "devicenet/explicit_channel.h"
#include "explore/explicit_wire.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(channelClientOf, devicenet::ExplicitChannel, client_)
NORD_EXPLORE_MEMBER(channelOwnerOf, devicenet::ExplicitChannel, owner_)
NORD_EXPLORE_MEMBER(channelLastOf, devicenet::ExplicitChannel, last_)
NORD_EXPLORE_MEMBER(channelOwnOf, devicenet::ExplicitChannel, own_)
NORD_EXPLORE_MEMBER(channelUsersOf, devicenet::ExplicitChannel, users_)

namespace {

using devicenet::ExplicitChannel;
using devicenet::ExplicitEnd;

constexpr std::uint8_t kMostUsers = 2;
// Given out, unanswered, given out again and unanswered.
constexpr int kOneRequest = 4 * kAnswerSteps;
// And before that both transaction ids may be owed a late answer, to be waited for.
constexpr int kLongestWait = 2 * kOneRequest + 2 * kLatenessSteps;

enum class Event : std::uint8_t {
  kSubmit,
  kAsk,
  kCancelOwn,
  kOpen,
  kClose,
  kSilence,
  kTransmit,
  kTransmitFails,
  kAnswer,
  kError,
  kLateAnswer,
  kPassTime,
  kLongTime,
  kCount
};

constexpr const char* kNames[] = {"layer above: a request",
                                  "engine: a request",
                                  "engine: request cancelled",
                                  "open",
                                  "close",
                                  "silence",
                                  "the link takes a frame",
                                  "the link takes a frame and does not send it",
                                  "device: answer",
                                  "device: error response",
                                  "device: answer to the one before",
                                  "time: a step",
                                  "time: many steps"};

class ExplicitChannelEvents {
 public:
  struct World {
    ExplicitChannel channel{kScanner, kDevice, kAnswerSteps* kWireStep};
    Instant now{std::chrono::hours{1}};
    std::uint8_t users = 0;                      // requests of the layer above without an answer
    std::uint32_t next_id = 1, next_answer = 1;  // of theirs
    bool own = false;                            // the engine's has no answer
    std::uint8_t user_waits = 0, own_waits = 0;  // steps
    std::uint8_t turns = 0;                      // of others since the engine asked
  };

  World initial() const { return {}; }
  std::size_t events() const { return static_cast<std::size_t>(Event::kCount); }
  std::string name(std::size_t event) const { return kNames[event]; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    ExplicitChannel& channel = world.channel;
    switch (static_cast<Event>(number)) {
      case Event::kSubmit:
        if (world.users == kMostUsers) return false;
        verdict.require(channel.submit(devicenet::getAttribute(world.next_id++, 4, 20, 3), world.now),
                        "a request is not taken");
        ++world.users;
        break;
      case Event::kAsk:
        channel.ask(devicenet::getAttribute(kOwnId, 5, 1, 9), devicenet::ExplicitPort::kConnected,
                    kAnswerSteps * kWireStep, world.now);
        world.own = true;
        world.own_waits = world.turns = 0;
        break;
      case Event::kCancelOwn:
        channel.cancelOwn();
        world.own = false;
        channel.poll(world.now);  // as the scanner does after everything it hands to a node
        break;
      case Event::kOpen:
        channel.open();
        break;
      case Event::kClose:
        channel.close();
        channel.poll(world.now);
        break;
      case Event::kSilence:
        channel.silence();
        world.own = false;
        verdict.require(!wantsFrame(world), "a frame is left over after silence");
        break;
      case Event::kTransmit:
      case Event::kTransmitFails: {
        CanFrame frame;
        if (!channel.pollTransmit(frame, world.now)) return false;
        verdict.require(world.users > 0 || world.own, "a frame of a request that nobody waits for");
        if (static_cast<Event>(number) == Event::kTransmitFails) channel.notSent(frame);
        break;
      }
      case Event::kPassTime:
      case Event::kLongTime:
        pass(world, static_cast<Event>(number) == Event::kPassTime ? 1 : 10);
        break;
      default:
        answer(world, static_cast<Event>(number));
    }
    takeAnswers(world, verdict);
    check(world, verdict);
    return true;
  }

  void describe(const World& world, Key& key) const {
    const ExplicitChannel& channel = world.channel;
    describeClient(channelClientOf(channel), world.now, key);
    key.add(channel.isOpen())
        .add(channelOwnerOf(channel))
        .add(channelLastOf(channel))
        .add(channelOwnOf(channel).has_value());
    key.add(static_cast<std::uint8_t>(channelUsersOf(channel).size()));
    key.add(world.users).add(world.own).add(world.user_waits).add(world.own_waits).add(world.turns);
  }

  // With a link that sends and a device that answers: everybody has an answer, and a further request of each is done.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    world.channel.open();
    answerAll(world, of_the_way);
    verdict.require(world.users == 0 && !world.own, "a request has no end, and the device answers");
    for (const Event event : {Event::kSubmit, Event::kAsk}) {
      user_end_ = own_end_ = ExplicitEnd::kTimedOut;
      apply(world, static_cast<std::size_t>(event), of_the_way);
      answerAll(world, of_the_way);
      const ExplicitEnd end = event == Event::kSubmit ? user_end_ : own_end_;
      verdict.require(end == ExplicitEnd::kDone, "a request is not done, and the device answers");
    }
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  static constexpr std::uint32_t kOwnId = 1'000'000'000;

  static bool wantsFrame(const World& world) {
    World copy = world;
    CanFrame frame;
    return copy.channel.pollTransmit(frame, copy.now);
  }

  void answerAll(World& world, Verdict& verdict) const {
    for (int i = 0; i < 20 + kLatenessSteps && (world.users > 0 || world.own); ++i) {
      // One that waits for a transaction id.
      if (!wantsFrame(world)) apply(world, static_cast<std::size_t>(Event::kPassTime), verdict);
      while (apply(world, static_cast<std::size_t>(Event::kTransmit), verdict)) {
      }
      apply(world, static_cast<std::size_t>(Event::kAnswer), verdict);
    }
  }

  static void answer(World& world, Event event) {
    const bool xid = explicitXidOf(channelClientOf(world.channel)) == (event != Event::kLateAnswer);
    const CanFrame frame =
        event == Event::kError ? explicitFrame(false, xid, {0x94, 0x14, 0xFF}) : explicitFrame(false, xid, {0x8E, 1});
    world.channel.handle(frame, world.now);
  }

  static void pass(World& world, int steps) {
    world.now += steps * kWireStep;
    world.channel.poll(world.now);
    if (steps > 1) return;  // they would have to be counted one by one
    if (world.users > 0) ++world.user_waits;
    if (world.own) ++world.own_waits;
  }

  void takeAnswers(World& world, Verdict& verdict) const {
    while (const auto answer = world.channel.pollAnswer()) {
      verdict.require(world.users > 0, "an answer without a request");
      verdict.require(answer->id == world.next_answer++, "answers come in another order than requests");
      user_end_ = answer->end;
      --world.users;
      world.user_waits = 0;
      if (world.own && answer->end != ExplicitEnd::kNotConnected) ++world.turns;
    }
    if (const auto answer = world.channel.takeOwnAnswer()) {
      verdict.require(world.own, "the engine has an answer without a request");
      verdict.require(answer->id == kOwnId, "the engine has the answer of somebody else");
      own_end_ = answer->end;
      world.own = false;
      world.user_waits = 0;
    }
    if (!world.own) world.own_waits = world.turns = 0;
    if (world.users == 0) world.user_waits = 0;
  }

  static void check(World& world, Verdict& verdict) {
    const bool waits = world.users > 0 || world.own;
    verdict.require(world.channel.isOpen() || world.users == 0, "a request waits at a device that is not connected");
    verdict.require(!waits || world.channel.nextDeadline().has_value() || wantsFrame(world),
                    "a request waits, and neither a time-out nor a frame with it");
    // Its own, and one of the other asker before.
    verdict.require(world.user_waits <= kLongestWait, "a request of the layer above comes no further");
    verdict.require(world.own_waits <= kLongestWait, "a request of the engine has no end");
    verdict.require(world.turns <= 1, "the layer above goes before the engine twice");
  }

  mutable ExplicitEnd user_end_ = ExplicitEnd::kDone, own_end_ = ExplicitEnd::kDone;  // of the last answers
};

TEST(ExplicitChannelEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(ExplicitChannelEvents{}, "ExplicitChannel (DeviceNet)", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
