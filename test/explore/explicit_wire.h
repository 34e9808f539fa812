// The frames a DeviceNet device may answer with, typed from IEC 62026-3 (header, fragment byte), and what decides on the
// behaviour of an ExplicitClient, as bytes of a key.
#pragma once

#include <vector>

#include "devicenet/explicit_client.h"
#include "explore/explorer.h"
#include "explore/private_member.h"

namespace nord_driver::explore {

NORD_EXPLORE_MEMBER(explicitPhaseOf, devicenet::ExplicitClient, phase_)
NORD_EXPLORE_MEMBER(explicitTimersOf, devicenet::ExplicitClient, timers_)
NORD_EXPLORE_MEMBER(explicitXidOf, devicenet::ExplicitClient, xid_)
NORD_EXPLORE_MEMBER(explicitPortOf, devicenet::ExplicitClient, port_)
NORD_EXPLORE_MEMBER(explicitOffsetOf, devicenet::ExplicitClient, offset_)
NORD_EXPLORE_MEMBER(explicitCountOf, devicenet::ExplicitClient, count_)
NORD_EXPLORE_MEMBER(explicitRepeatsOf, devicenet::ExplicitClient, repeats_)
NORD_EXPLORE_MEMBER(explicitBodyOf, devicenet::ExplicitClient, body_)
NORD_EXPLORE_MEMBER(explicitReceiverOf, devicenet::ExplicitClient, receiver_)
NORD_EXPLORE_MEMBER(explicitFurthestOf, devicenet::ExplicitClient, furthest_)
NORD_EXPLORE_MEMBER(explicitAcknowledgeOf, devicenet::ExplicitClient, acknowledge_)
NORD_EXPLORE_MEMBER(explicitOwedOf, devicenet::ExplicitClient, owed_)
NORD_EXPLORE_MEMBER(explicitAnswerOf, devicenet::ExplicitClient, answer_)
NORD_EXPLORE_MEMBER(receiverAssemblingOf, devicenet::ExplicitReceiver, assembling_)
NORD_EXPLORE_MEMBER(receiverLastOf, devicenet::ExplicitReceiver, last_)
NORD_EXPLORE_MEMBER(receiverCountOf, devicenet::ExplicitReceiver, next_count_)
NORD_EXPLORE_MEMBER(receiverBodyOf, devicenet::ExplicitReceiver, body_)

constexpr std::uint8_t kScanner = 5, kDevice = 9;  // MAC ids
constexpr Duration kWireStep = std::chrono::milliseconds{200};
constexpr int kAnswerSteps = 3;       // the time-out the client is given
constexpr int kAcknowledgeSteps = 5;  // its own, for the acknowledge of a fragment
constexpr int kFragmentSteps = 6;     // its own, for the next fragment of an answer
constexpr int kLatenessSteps = 25;    // its own, for the answer to a request that was given up

/// A frame of the device. `xid`: its transaction bit.
inline CanFrame explicitFrame(bool fragment, bool xid, std::vector<std::uint8_t> bytes, std::uint8_t to = kScanner) {
  bytes.insert(bytes.begin(), static_cast<std::uint8_t>((fragment ? 0x80u : 0u) | (xid ? 0x40u : 0u) | to));
  return dataFrame(0x400u | kDevice << 3u | 3u, ByteView{bytes});
}

/// The transaction bit is one state with its opposite: only whether it is that of the request counts. The body of the
/// request is left out: who describes the world adds which request that is.
inline void describeClient(const devicenet::ExplicitClient& client, Instant now, Key& key) {
  const bool xid = explicitXidOf(client);
  const auto& receiver = explicitReceiverOf(client);
  key.add(explicitPhaseOf(client)).add(explicitPortOf(client)).add(static_cast<std::uint8_t>(explicitOffsetOf(client)));
  key.add(explicitCountOf(client)).add(explicitRepeatsOf(client)).add(explicitAnswerOf(client).has_value());
  describeTimers(explicitTimersOf(client), now, kWireStep, kFragmentSteps, key);
  key.add(static_cast<std::uint8_t>(client.busy() ? explicitFurthestOf(client) : 0u));
  // How many late answers are owed, and how long, is left out: the states would have no end.
  for (const auto& on_port : explicitOwedOf(client)) {
    for (const bool own : {true, false}) {
      const auto& owed = on_port[own == xid];
      key.add(owed.answers > 0 && now < owed.until);
    }
  }
  const bool assembling = receiverAssemblingOf(receiver);
  key.add(assembling);
  if (assembling) {
    key.add(receiverCountOf(receiver)).add(static_cast<std::uint8_t>(receiverBodyOf(receiver).size()));
  }
  const auto& last = receiverLastOf(receiver);
  key.add(last.has_value());
  if (last) key.add(last->xid == xid).add(last->byte);
  const auto& acknowledge = explicitAcknowledgeOf(client);
  key.add(acknowledge.has_value());
  if (acknowledge) {
    key.add(((acknowledge->data[0] & 0x40u) != 0) == xid).add(acknowledge->data[1]).add(acknowledge->data[2]);
  }
}

}  // namespace nord_driver::explore
