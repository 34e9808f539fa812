// Every order of requests, answers, losses and time-outs at the client of one SDO server. Frames keep their order on
// the bus; how late they come, and whether they come, is anybody's guess, but none outlasts two further requests.
#include <deque>

#include "canopen/sdo_client.h"
#include "explore/explorer.h"
#include "explore/private_member.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(sdoRequestOf, canopen::SdoClient, request_)
NORD_EXPLORE_MEMBER(sdoBufferOf, canopen::SdoClient, buffer_)
NORD_EXPLORE_MEMBER(sdoPhaseOf, canopen::SdoClient, phase_)
NORD_EXPLORE_MEMBER(sdoUploadOf, canopen::SdoClient, segmented_upload_)
NORD_EXPLORE_MEMBER(sdoDownloadOf, canopen::SdoClient, segmented_download_)
NORD_EXPLORE_MEMBER(sdoKnownOf, canopen::SdoClient, known_to_server_)
NORD_EXPLORE_MEMBER(sdoDeadlineOf, canopen::SdoClient, deadline_)
NORD_EXPLORE_MEMBER(sdoClosingOf, canopen::SdoClient, closing_frame_)
NORD_EXPLORE_MEMBER(uploadToggleOf, canopen::SegmentedUpload, toggle_)
NORD_EXPLORE_MEMBER(uploadToSendOf, canopen::SegmentedUpload, to_send_)
NORD_EXPLORE_MEMBER(uploadStartedOf, canopen::SegmentedUpload, started_)
NORD_EXPLORE_MEMBER(uploadLastOf, canopen::SegmentedUpload, last_)
NORD_EXPLORE_MEMBER(downloadConfirmedOf, canopen::SegmentedDownload, confirmed_)
NORD_EXPLORE_MEMBER(downloadToggleOf, canopen::SegmentedDownload, toggle_)
NORD_EXPLORE_MEMBER(downloadToSendOf, canopen::SegmentedDownload, to_send_)
NORD_EXPLORE_MEMBER(downloadStartedOf, canopen::SegmentedDownload, started_)

namespace {

using canopen::SdoBytes;
using canopen::SdoClient;
using canopen::SdoEnd;

constexpr Duration kStepTime = std::chrono::milliseconds{10};
constexpr int kTimeout = 2;  // steps
constexpr std::size_t kInFlight = 2;
constexpr std::size_t kLong = 10;  // bytes of an object that needs two segments

enum class Event : std::uint8_t {
  kRead,
  kReadLong,
  kReadOtherLong,
  kWriteLong,  // requests
  kServe,
  kLost,
  kAbort,
  kWrongToggle,
  kOtherObject,  // the client sends
  kDeliver,
  kLoseAnswer,
  kRepeat,
  kPassTime,
  kCancel,
  kCount
};

constexpr const char* kNames[] = {"request: read 2000h",
                                  "request: read 2002h, 10 bytes",
                                  "request: read 2003h, 10 bytes",
                                  "request: write 2002h, 10 bytes",
                                  "the client sends, the server answers",
                                  "the client sends, the frame is lost",
                                  "the client sends, the server aborts",
                                  "the client sends, the server answers with the wrong toggle bit",
                                  "the client sends, the server answers about another object",
                                  "an answer arrives",
                                  "an answer is lost",
                                  "an answer arrives twice",
                                  "time: a step",
                                  "cancel"};
constexpr std::uint8_t kObjects[] = {0, 2, 3, 2, 1};  // of the requests, and of one that only judge() makes
constexpr std::uint8_t kLast = 4;

/// An answer on its way, and how many requests were begun since.
struct InFlight {
  SdoBytes bytes{};
  std::uint8_t requests = 0;
};

/// Bytes of an object say whose they are.
std::uint8_t byteOf(std::uint8_t object, std::size_t place) {
  return static_cast<std::uint8_t>(object * 16u + place);
}

/// CiA 301 7.2.4.3 from the server's side, for objects 2000h to 2003h, of which the last two are long.
struct Server {
  std::uint8_t object = 0, place = 0;
  bool up = false, down = false, toggle = false;

  /// False: nothing is answered.
  bool serve(const SdoBytes& request, SdoBytes& answer) {
    const unsigned command = request[0] >> 5;
    answer = {0, request[1], request[2], request[3]};
    if (command == 4) {
      up = down = false;
      return false;
    }
    if (command == 1 || command == 2) {
      *this = {};
      object = request[1];
      const bool is_long = command == 2 ? object >= 2 : (request[0] & 2u) == 0;
      if (command == 1) {
        down = is_long;
        answer[0] = 0x60;
      } else if (is_long) {
        up = true;
        answer[0] = 0x41;
        answer[4] = kLong;
      } else {
        answer[0] = 0x4F;
        answer[4] = byteOf(object, 0);
      }
      return true;
    }
    const bool asked = (request[0] & 0x10u) != 0;
    if (!(command == 3 ? up : command == 0 && down) || asked != toggle) {
      up = down = false;
      answer = {0x80, object, 0x20, 0, 0, 0, 0x03, 0x05};
      return true;
    }
    answer = {};
    answer[0] = static_cast<std::uint8_t>((down ? 0x20u : 0u) | (toggle ? 0x10u : 0u));
    toggle = !toggle;
    if (up) segment(answer);
    if (down && (request[0] & 1u) != 0) down = false;
    return true;
  }
  void segment(SdoBytes& answer) {
    std::size_t count = 0;
    for (; count < 7 && place < kLong; ++count) answer[1 + count] = byteOf(object, place++);
    answer[0] = static_cast<std::uint8_t>(answer[0] | (7u - count) << 1 | (place == kLong ? 1u : 0u));
    if (place == kLong) up = false;
  }
};

class SdoEvents {
 public:
  struct World {
    SdoClient client{canopen::defaultSdoChannel(5), kTimeout* kStepTime};
    Server server;
    std::deque<InFlight> answered;
    Instant now{std::chrono::hours{1}};
    bool runs = false;
    std::uint8_t kind = 0;
    std::uint8_t quiet = 0;  // steps without a frame to the client
  };

  World initial() const { return {}; }
  std::size_t events() const { return static_cast<std::size_t>(Event::kCount); }
  std::string name(std::size_t event) const { return kNames[event]; }

  bool apply(World& world, std::size_t number, Verdict& verdict) const {
    const auto event = static_cast<Event>(number);
    if (event <= Event::kWriteLong) return start(world, static_cast<std::uint8_t>(number), verdict);
    switch (event) {
      case Event::kDeliver:
      case Event::kRepeat:
        return deliver(world, event == Event::kRepeat, verdict);
      case Event::kLoseAnswer:
        if (world.answered.empty()) return false;
        world.answered.pop_front();
        return true;
      case Event::kCancel:
        world.client.cancel();
        world.runs = false;
        verdict.require(!world.client.busy(), "a cancelled request goes on");
        return true;
      case Event::kPassTime:
        pass(world);
        takeAnswer(world, verdict);
        verdict.require(!world.runs || world.quiet < kTimeout, "a request has no end");
        return true;
      default:
        return send(world, event);
    }
  }

  void describe(const World& world, Key& key) const {
    const SdoClient& client = world.client;
    key.add(sdoPhaseOf(client)).add(sdoKnownOf(client)).add(world.runs).add(world.kind);
    const auto frame = [&](const SdoBytes& bytes) {
      for (const std::uint8_t byte : bytes) key.add(byte);
    };
    key.add(sdoClosingOf(client).has_value());
    if (sdoClosingOf(client)) frame(*sdoClosingOf(client));
    if (world.runs) {
      const auto& up = sdoUploadOf(client);
      const auto& down = sdoDownloadOf(client);
      key.add(ticks(world.now, sdoDeadlineOf(client), kStepTime, kTimeout)).add(world.quiet);
      key.add(sdoRequestOf(client).index).add(sdoBufferOf(client).size());
      for (const std::uint8_t byte : sdoBufferOf(client)) key.add(byte);
      key.add(uploadToggleOf(up)).add(uploadToSendOf(up)).add(uploadStartedOf(up)).add(uploadLastOf(up)[0]);
      key.add(downloadConfirmedOf(down)).add(downloadToggleOf(down)).add(downloadToSendOf(down));
      key.add(downloadStartedOf(down));
    }
    const Server& server = world.server;
    key.add(server.up).add(server.down);
    if (server.up || server.down) key.add(server.object).add(server.place).add(server.toggle);
    key.add(world.answered.size());
    for (const InFlight& answer : world.answered) {
      frame(answer.bytes);
      key.add(answer.requests);
    }
  }

  // With a server that answers: what runs ends, and a further read is carried out.
  void judge(const World& found, Verdict& verdict) const {
    World world = found;
    Verdict of_the_way;
    talk(world, of_the_way);
    verdict.require(!world.runs, "a request has no end, and the server answers");
    verdict.require(start(world, kLast, of_the_way), "no further request is taken");
    talk(world, of_the_way);
    verdict.require(!world.runs && done_, "a read is not carried out, and the server answers");
    verdict.require(of_the_way.holds(), of_the_way.problem().c_str());
  }

 private:
  void talk(World& world, Verdict& verdict) const {
    for (int i = 0; i < 12 && world.runs; ++i) {
      while (send(world, Event::kServe)) {
      }
      while (deliver(world, false, verdict)) {
      }
      if (i > 6) pass(world);
      takeAnswer(world, verdict);
    }
  }

  static bool start(World& world, std::uint8_t kind, Verdict& verdict) {
    if (world.runs) return false;
    canopen::SdoRequest request = canopen::sdoRead(kind + 1u, static_cast<std::uint16_t>(0x2000 + kObjects[kind]), 0);
    request.write = kind == 3;
    std::vector<std::uint8_t> data;
    for (std::size_t i = 0; request.write && i < kLong; ++i) data.push_back(byteOf(8, i));
    verdict.require(world.client.start(request, ByteView{data}, world.now), "a request is not taken, and none runs");
    world.runs = true;
    world.kind = kind;
    world.quiet = 0;
    // An answer is not held on the bus over two further requests.
    std::deque<InFlight> kept;
    for (InFlight answer : world.answered) {
      if (++answer.requests < 2) kept.push_back(answer);
    }
    world.answered = kept;
    return true;
  }

  static bool send(World& world, Event event) {
    CanFrame frame;
    if (world.answered.size() == kInFlight || !world.client.pollTransmit(frame)) return false;
    if (event == Event::kLost) return true;
    SdoBytes answer{};
    if (!world.server.serve(frame.data, answer)) return event == Event::kServe;
    const bool is_segment = (answer[0] >> 5) < 2;
    if (event == Event::kWrongToggle && !is_segment) return false;
    if (event == Event::kOtherObject && is_segment) return false;
    if (event == Event::kAbort) {
      answer = {0x80, world.server.object, 0x20, 0, 0, 0, 0x02, 0x06};
      world.server = {};
    }
    if (event == Event::kWrongToggle) answer[0] = static_cast<std::uint8_t>(answer[0] ^ 0x10u);
    if (event == Event::kOtherObject) answer[1] = 0x77;
    world.answered.push_back({answer, 0});
    return true;
  }

  bool deliver(World& world, bool twice, Verdict& verdict) const {
    if (world.answered.empty()) return false;
    const CanFrame frame = dataFrame(0x585, world.answered.front().bytes);
    world.answered.pop_front();
    for (int i = 0; i < (twice ? 2 : 1); ++i) world.client.handle(frame, world.now);
    world.quiet = 0;
    takeAnswer(world, verdict);
    return true;
  }

  static void pass(World& world) {
    world.now += kStepTime;
    world.quiet = static_cast<std::uint8_t>(std::min(world.quiet + 1, kTimeout));
    world.client.poll(world.now);
  }

  void takeAnswer(World& world, Verdict& verdict) const {
    const auto answer = world.client.takeAnswer();
    if (!answer) return;
    verdict.require(world.runs, "an answer without a request");
    verdict.require(answer->id == world.kind + 1u, "the answer to another request");
    done_ = answer->ok();
    if (done_ && world.kind != 3) {
      const std::uint8_t object = kObjects[world.kind];
      const std::size_t size = object >= 2 ? kLong : 1;
      bool own = answer->data.size() >= size;
      for (std::size_t i = 0; own && i < size; ++i) own = answer->data[i] == byteOf(object, i);
      verdict.require(own, "the bytes of another object");
    }
    world.runs = false;
    verdict.require(!world.client.takeAnswer(), "a request has two answers");
  }

  mutable bool done_ = false;  // the last answer was
};

TEST(SdoEventsTest, EveryOrderKeepsTheRules) {
  exploreAll(SdoEvents{}, "SdoClient", 1000);
}

}  // namespace
}  // namespace nord_driver::explore
