#include "sim/devicenet/dn_referee.h"

namespace nord_driver::sim {

namespace {

using std::chrono::milliseconds;

constexpr Duration kCheckTime = milliseconds(1000);
constexpr Duration kCheckTolerance = milliseconds(50);   // a frame waits for the bus, a thread for the processor
constexpr Duration kLongestPause = milliseconds(10000);  // between them: a queue was full
constexpr Duration kAnswerTime = milliseconds(500);
constexpr Duration kFragmentTime = milliseconds(1000);
constexpr Duration kChangeTime = milliseconds(100);
constexpr Duration kRequestTime = milliseconds(150);  // then the answer is lost, and it may be asked again
constexpr unsigned kTimeoutMultiplier = 4;

constexpr std::uint8_t kDeviceNetClass = 3;
constexpr std::uint8_t kConnectionClass = 5;
constexpr std::uint8_t kState = 1;
constexpr std::uint8_t kPacketRate = 9;
constexpr std::uint8_t kProducedSize = 7;
constexpr std::uint8_t kConsumedSize = 8;

constexpr unsigned kMostInAFrame = 8, kMostFragments = 5;  // of a poll: four inverters and a control byte in 33 bytes
constexpr unsigned kPollIo = 0, kStrobeIo = 1, kChangeIo = 2;
constexpr std::uint8_t kProducesItself = dn::kChoiceChangeOfState | dn::kChoiceCyclic;
constexpr std::array<std::uint8_t, 3> kBits{dn::kChoicePoll, dn::kChoiceStrobe, kProducesItself};

}  // namespace

void DnReferee::advance(Instant now) noexcept {
  now_ = now;
  if (second_check_ && now_ - last_check_ >= kCheckTime - kCheckTolerance) online_ = true;
  if (answer_due_ && now_ >= *answer_due_) {
    answer_due_.reset();
    broken(DnRule::kDuplicateMacUnanswered);
  }
  for (View& view : views_) {
    if (view.received_fragment && now_ >= view.fragment_due) {
      view.received_fragment.reset();
      broken(DnRule::kFragmentUnacknowledged);
    }
    if (view.change_due && now_ >= *view.change_due) {
      view.change_due.reset();
      broken(DnRule::kChangeUnacknowledged);
    }
  }
}

void DnReferee::stoodStill() noexcept {
  answer_due_.reset();
  for (View& view : views_) {
    view.received_fragment.reset();
    view.change_due.reset();
    for (Io& io : view.io) io.last.reset();
  }
}

void DnReferee::masterFrame(const CanFrame& frame) noexcept {
  judgeMaster(frame);
  given_.reset();
}

void DnReferee::judgeMaster(const CanFrame& frame) noexcept {
  if (frame.extended) return broken(DnRule::kExtendedFrame);
  if (frame.remote) return broken(DnRule::kRemoteFrame);
  if (dn::isGroup2(frame.id) && dn::messageOfGroup2(frame.id) == dn::kDuplicateMac) return duplicateMac(frame);
  if (!online_) broken(DnRule::kBeforeDuplicateCheck);
  judgeOnline(frame);
}

// Two requests, a second apart, and a second more: then it is on-line. Whoever is on-line answers.
void DnReferee::duplicateMac(const CanFrame& frame) noexcept {
  if (frame.size != 7) broken(DnRule::kDuplicateMacLength);
  const auto mac = static_cast<std::uint8_t>(dn::macOfGroup2(frame.id));
  if (views_[mac].exists) return broken(DnRule::kIdOfANode);
  if (!master_) master_ = mac;
  if (*master_ != mac) return broken(DnRule::kSecondMaster);
  if (frame.size > 0 && (frame.data[0] & dn::kAnswer) != 0) {
    answer_due_.reset();
    return;
  }
  // Any one may be the first: after bus-off it begins anew, and knows nothing any more.
  const Duration since = now_ - last_check_;
  second_check_ = checked_ && since >= kCheckTime - kCheckTolerance && since <= kLongestPause;
  checked_ = true;
  online_ = false;
  for (View& view : views_) {
    const bool exists = view.exists;
    view = View{};
    view.exists = exists;
  }
  last_check_ = now_;
}

void DnReferee::judgeOnline(const CanFrame& frame) noexcept {
  if (frame.id >= dn::kGroup3) {
    if (frame.id >= dn::kNotAllowed || frame.id < dn::kGroup4) broken(DnRule::kUnknownId);
    return;
  }
  if (!dn::isGroup2(frame.id)) {
    if (!master_ || (frame.id & dn::kMacMask) != *master_) broken(DnRule::kIdOfANode);
    return;
  }
  const unsigned mac = dn::macOfGroup2(frame.id);
  View& view = views_[mac];
  const unsigned message = dn::messageOfGroup2(frame.id);
  // Asking for a slave that is not there is how one finds out.
  const bool nobody = !view.exists && (message == dn::kMasterExplicit || message == dn::kPoll);
  if (nobody) return broken(DnRule::kUnknownId);
  switch (message) {
    case dn::kStrobeCommand:
      if (master_ && mac != *master_) return broken(DnRule::kSecondMaster);
      return strobe(frame);
    case dn::kMulticastPoll:
      return broken(DnRule::kUnknownId);
    case dn::kAcknowledge:
      if ((view.choice & kProducesItself) == 0 || (view.choice & dn::kChoiceNoAcknowledge) != 0) {
        broken(DnRule::kAcknowledgeUnasked);
      }
      view.change_due.reset();
      return;
    case dn::kSlaveExplicit:
      return broken(DnRule::kIdOfANode);
    case dn::kMasterExplicit:
      return explicitMessage(view, frame);
    case dn::kPoll:
      return io(view, frame);
    default:
      return unconnected(view, frame);
  }
}

// Allocate and release: class 3, instance 1, and a choice that can be.
void DnReferee::unconnected(View& view, const CanFrame& frame) noexcept {
  if (frame.size < 4) return broken(DnRule::kExplicitLength);
  const std::uint8_t header = frame.data[0];
  if (master_ && (header & dn::kMacMask) != *master_) broken(DnRule::kHeaderMac);
  const std::uint8_t service = frame.data[1];
  const bool allocate = service == dn::kAllocate;
  const bool known = allocate || service == dn::kRelease;
  // Whose it is: a module may refuse to tell it here, asking is no harm.
  if (service == dn::kGetSingle && frame.size == 5 && frame.data[2] == kDeviceNetClass && frame.data[4] == 5) return;
  if (!known || (header & dn::kFragmented) != 0 || frame.data[2] != kDeviceNetClass || frame.data[3] != 1) {
    return broken(DnRule::kUnconnectedService);
  }
  if (frame.size != (allocate ? 6 : 5)) return broken(DnRule::kExplicitLength);
  const std::uint8_t choice = frame.data[4];
  const bool reserved = (choice & (dn::kChoiceMulticast | dn::kChoiceReserved)) != 0;
  const bool both = (choice & kProducesItself) == kProducesItself;
  const bool suppresses_nothing = (choice & dn::kChoiceNoAcknowledge) != 0 && (choice & kProducesItself) == 0;
  if (!allocate) {
    const bool foreign = view.choice != 0 && (choice & ~unsigned{view.choice}) != 0;
    if (choice == 0 || reserved || foreign) broken(DnRule::kReleaseChoice);
    end(view, choice);
  } else {
    if (master_ && frame.data[5] != *master_) broken(DnRule::kSecondMaster);
    const bool without_explicit = ((choice | view.choice) & dn::kChoiceExplicit) == 0;
    const bool impossible = choice == 0 || reserved || both || suppresses_nothing;
    if (impossible) broken(DnRule::kChoice);
    if (!impossible && without_explicit) broken(DnRule::kAllocateWithoutExplicit);
  }
  Request request;
  request.service = service;
  request.class_id = kDeviceNetClass;
  request.instance = 1;
  request.value = choice;
  request.unconnected = true;
  view.pending = request;
  view.asked = given_.value_or(now_);
}

void DnReferee::explicitMessage(View& view, const CanFrame& frame) noexcept {
  if (frame.size < 2) return broken(DnRule::kExplicitLength);
  const std::uint8_t header = frame.data[0];
  if (master_ && (header & dn::kMacMask) != *master_) broken(DnRule::kHeaderMac);
  if ((view.choice & dn::kChoiceExplicit) == 0) {
    if (view.refused) return;
    if (view.on_their_way == 0) return broken(DnRule::kExplicitBeforeAllocation);
    --view.on_their_way;
    return;
  }
  if ((header & dn::kFragmented) != 0) {
    const dn::Fragment kind = dn::kindOf(frame.data[1]);
    const std::uint8_t count = frame.data[1] & dn::kFragmentCount;
    if (kind == dn::Fragment::kAcknowledgement) {
      if (frame.size != 3) broken(DnRule::kExplicitLength);
      if (view.received_fragment == count) view.received_fragment.reset();
      return;
    }
    if (frame.size < 3) broken(DnRule::kExplicitLength);
    const bool again = view.sent_fragment == count;
    if (kind == dn::Fragment::kFirst ? count != 0 : view.sent_fragment.has_value() && !again) {
      broken(DnRule::kFragmentOrder);
    }
    view.sent_fragment = count;
    if (kind != dn::Fragment::kFirst || frame.size < 5) return;
  } else {
    if (frame.size < 4) return broken(DnRule::kExplicitLength);
    view.sent_fragment.reset();
  }
  const std::size_t at = (header & dn::kFragmented) != 0 ? 2 : 1;
  Request request;
  request.service = frame.data[at];
  request.class_id = frame.data[at + 1];
  request.instance = at + 2 < frame.size ? frame.data[at + 2] : std::uint8_t{0};
  if (at + 3 < frame.size) request.attribute = frame.data[at + 3];
  if (at + 5 < frame.size) request.value = static_cast<std::uint16_t>(frame.data[at + 4] | frame.data[at + 5] << 8);
  const Instant asked = given_.value_or(now_);
  if (view.pending && !view.pending->unconnected && asked - view.asked < kRequestTime) {
    const bool same = view.pending->service == request.service && view.pending->class_id == request.class_id &&
                      view.pending->instance == request.instance && view.pending->attribute == request.attribute;
    if (!same || (header & dn::kFragmented) == 0) broken(DnRule::kExplicitWhilePending);
  }
  const bool io_rate = request.service == dn::kSetSingle && request.class_id == kConnectionClass &&
                       request.attribute == kPacketRate && request.instance > 1;
  if (io_rate && request.value == 0) broken(DnRule::kNoPacketRate);
  view.pending = request;
  view.asked = asked;
}

void DnReferee::strobe(const CanFrame& frame) noexcept {
  if (frame.size != 8) broken(DnRule::kStrobeLength);
  // One command for all: a slave that is not ready for it yet lets it pass.
  bool any = false, runs = false;
  for (std::size_t mac = 0; mac < views_.size(); ++mac) {
    View& view = views_[mac];
    if ((view.choice & dn::kChoiceStrobe) == 0) continue;
    any = true;
    Io& strobe = view.io[kStrobeIo];
    if (!strobe.running) continue;
    runs = true;
    ioMessage(strobe, strobe, strobe.consumed.value_or(frame.size));
    const bool own_bit = frame.size == 8 && (frame.data[mac / 8] >> mac % 8 & 1u) != 0;
    if (own_bit && (view.choice & dn::kChoicePoll) != 0) broken(DnRule::kStrobeBit);
  }
  if (!runs) broken(any ? DnRule::kIoBeforePacketRate : DnRule::kIoBeforeAllocation);
}

// Change of state and cyclic: by the instance of the poll, when the module has told that it is there without one.
void DnReferee::io(View& view, const CanFrame& frame) noexcept {
  const bool polled = (view.choice & dn::kChoicePoll) != 0;
  const Io& inputs = view.io[polled ? kPollIo : kChangeIo];
  Io& io = view.io[polled || view.io[kPollIo].told ? kPollIo : kChangeIo];
  const bool allocated = polled || (view.choice & kProducesItself) != 0;
  if (!allocated || !io.running) {
    if (view.on_their_way > 0) {
      --view.on_their_way;
      return;
    }
    return broken(allocated ? DnRule::kIoBeforePacketRate : DnRule::kIoBeforeAllocation);
  }
  const std::size_t expected = io.consumed.value_or(frame.size);
  if (expected <= 8) return ioMessage(io, inputs, frame.size);
  if (frame.size < 2) return broken(DnRule::kIoFragments);
  const dn::Fragment kind = dn::kindOf(frame.data[0]);
  const std::uint8_t count = frame.data[0] & dn::kFragmentCount;
  const bool only = kind == dn::Fragment::kFirst && count == dn::kOnlyFragment;
  if (kind == dn::Fragment::kFirst) {
    io.collected = 0;
    if (count != 0 && !only) broken(DnRule::kIoFragments);
  } else if (kind == dn::Fragment::kAcknowledgement || count != io.next_fragment) {
    broken(DnRule::kIoFragments);
  }
  io.next_fragment = (count + 1u) & dn::kFragmentCount;
  io.collected += frame.size - 1u;
  if (kind == dn::Fragment::kLast || only) ioMessage(io, inputs, io.collected);
}

// It must have read how long its data are, they must be so long, and come before four times the packet rate is over.
void DnReferee::ioMessage(Io& io, const Io& inputs, std::size_t size) noexcept {
  const bool first = !io.last;
  if (first && (!inputs.produced || !io.consumed)) broken(DnRule::kIoSizesUnread);
  if (io.consumed && size != *io.consumed) broken(DnRule::kIoSize);
  const Duration limit = milliseconds(kTimeoutMultiplier * io.packet_rate);
  if (!first && io.packet_rate > 0 && now_ - *io.last > limit) broken(DnRule::kIoAfterTimeout);
  io.last = now_;
}

void DnReferee::begin(View& view, std::uint8_t choice) noexcept {
  view.choice = static_cast<std::uint8_t>(view.choice | choice);
  clearIo(view, choice);
}

void DnReferee::end(View& view, std::uint8_t choice) noexcept {
  view.choice = static_cast<std::uint8_t>(view.choice & ~unsigned{choice});
  clearIo(view, choice);
  if ((choice & kProducesItself) != 0) view.change_due.reset();
}

// The instance of the poll goes with change of state, too, unless it is polled.
void DnReferee::clearIo(View& view, std::uint8_t choice) noexcept {
  for (std::size_t i = 0; i < kBits.size(); ++i) {
    if ((choice & kBits[i]) != 0) view.io[i] = Io{};
  }
  if ((choice & kProducesItself) != 0 && (view.choice & dn::kChoicePoll) == 0) view.io[kPollIo] = Io{};
}

void DnReferee::delivered(const CanFrame& frame) noexcept {
  if (frame.extended || frame.remote) return;
  if (frame.id < dn::kGroup2) {
    View& view = views_[frame.id & dn::kMacMask];
    const bool asks = frame.id >> 6 == dn::kChangeOfState && (view.choice & kProducesItself) != 0 &&
                      (view.choice & dn::kChoiceNoAcknowledge) == 0;
    if (asks && !view.change_due) view.change_due = now_ + kChangeTime;
    return;
  }
  if (!dn::isGroup2(frame.id)) return;
  View& view = views_[dn::macOfGroup2(frame.id)];
  if (!view.exists) return;
  if (dn::messageOfGroup2(frame.id) == dn::kDuplicateMac) {
    if (frame.size > 0 && (frame.data[0] & dn::kAnswer) != 0) return;
    // It has started anew: nothing is allocated any more.
    const bool in_fragments = view.io[kPollIo].consumed.value_or(0) > kMostInAFrame;
    if (view.choice != 0) view.on_their_way = in_fragments ? kTolerance * kMostFragments : kTolerance;
    end(view, 0xFF);
    view.pending.reset();
    view.received_fragment.reset();
    view.sent_fragment.reset();
    return;
  }
  if (dn::messageOfGroup2(frame.id) == dn::kSlaveExplicit) answer(view, frame);
}

void DnReferee::answer(View& view, const CanFrame& frame) noexcept {
  if (frame.size < 2) return;
  // What another scanner is answered, refused or not, is no answer to the request that is under way.
  if (master_ && (frame.data[0] & dn::kMacMask) != *master_) return;
  if ((frame.data[0] & dn::kFragmented) != 0) {
    const dn::Fragment kind = dn::kindOf(frame.data[1]);
    const std::uint8_t count = frame.data[1] & dn::kFragmentCount;
    if (kind == dn::Fragment::kAcknowledgement) {
      if (view.sent_fragment == count) view.sent_fragment.reset();
      return;
    }
    view.received_fragment = count;
    view.fragment_due = now_ + kFragmentTime;
    if (kind == dn::Fragment::kFirst) view.pending.reset();  // no value of more than a frame matters here
    return;
  }
  if (!view.pending) return;
  const Request request = *view.pending;
  view.pending.reset();
  const std::uint8_t service = frame.data[1];
  if (request.service == dn::kAllocate) view.refused = service == (dn::kError | dn::kAnswer);
  if (service != (request.service | dn::kAnswer)) return;
  answered(view, request, frame.bytes().sub(2));
}

void DnReferee::answered(View& view, const Request& request, ByteView data) noexcept {
  if (request.service == dn::kAllocate) return begin(view, static_cast<std::uint8_t>(request.value));
  if (request.class_id != kConnectionClass || request.instance < 2 || request.instance > 4) return;
  Io& io = view.io[request.instance - 2u];
  ByteReader reader{data};
  const std::uint16_t value = reader.u16le();
  if (request.service == dn::kSetSingle && request.attribute == kPacketRate) {
    io.packet_rate = reader.ok() ? value : request.value;
    io.running = true;
    io.last.reset();
  }
  io.told = io.told || request.attribute != kState || (!data.empty() && data[0] != 0);
  if (request.service != dn::kGetSingle || !reader.ok()) return;
  if (request.attribute == kProducedSize) io.produced = value;
  if (request.attribute == kConsumedSize) io.consumed = value;
  if (request.attribute == kPacketRate) io.packet_rate = value;
}

void DnReferee::foreignFrame(const CanFrame& frame) noexcept {
  const bool asks_for_us = online_ && master_ && frame.id == dn::group2(dn::kDuplicateMac, *master_) && !frame.remote &&
                           frame.size == 7 && (frame.data[0] & dn::kAnswer) == 0;
  if (asks_for_us) answer_due_ = now_ + kAnswerTime;
}

}  // namespace nord_driver::sim
