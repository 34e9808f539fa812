// What the bus says of itself: each event once, the last one for a while, and a reason is not drowned by what it
// causes.
#include <gtest/gtest.h>

#include "transport/canopen/canopen_bus_events.h"

namespace nord_driver {
namespace {

using canopen::CanopenEvent;
using canopen::CanopenEventKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Instant kStart{std::chrono::hours{1}};
constexpr unsigned kNodeId = 50;

CanopenEvent event(CanopenEventKind kind, const char* text, Instant at, std::size_t node = canopen::kNoNode) {
  CanopenEvent made;
  made.kind = kind;
  made.text = text;
  made.at = at;
  made.node = node;
  return made;
}

TEST(CanopenBusEventsTest, EachIsToldOnceAndTheLastIsShownForTenSeconds) {
  CanBusEvents events;
  EXPECT_STREQ("", events.text(kStart).c_str());
  takeEvent(event(CanopenEventKind::kForeignNode, "node 9 is not configured", kStart), kNodeId, events);
  takeEvent(event(CanopenEventKind::kMalformed, "a frame of 3 bytes", kStart + seconds{1}, 0), kNodeId, events);
  EXPECT_STREQ("node 9 is not configured", events.poll()->text.c_str());
  EXPECT_STREQ("node 50: a frame of 3 bytes", events.poll()->text.c_str());
  EXPECT_FALSE(events.poll());
  EXPECT_STREQ("node 50: a frame of 3 bytes", events.text(kStart + milliseconds{10'999}).c_str());
  EXPECT_STREQ("", events.text(kStart + seconds{11}).c_str());
}

TEST(CanopenBusEventsTest, WhatADriveTellsItselfIsLeftOut) {
  CanBusEvents events;
  takeEvent(event(CanopenEventKind::kEmergency, "EMCY 4310h", kStart, 0), kNodeId, events);
  EXPECT_FALSE(events.poll());
  EXPECT_STREQ("", events.text(kStart).c_str());
}

TEST(CanopenBusEventsTest, WhatOthersTellTheirOwnNodesIsLeftOut) {
  CanBusEvents events;
  takeEvent(event(CanopenEventKind::kForeignCommand, "NMT for node 33", kStart), kNodeId, events);
  EXPECT_FALSE(events.poll());
  EXPECT_STREQ("", events.text(kStart).c_str());
}

TEST(CanopenBusEventsTest, AnotherMasterIsShownRatherThanWhatComesOfIt) {
  CanBusEvents events;
  EXPECT_FALSE(events.isExplained(kStart));
  takeEvent(event(CanopenEventKind::kSecondMaster, "another master", kStart), kNodeId, events);
  takeEvent(event(CanopenEventKind::kToggleError, "toggles", kStart + seconds{1}, 0), kNodeId, events);
  EXPECT_TRUE(events.isExplained(kStart + seconds{1}));
  EXPECT_STREQ("another master", events.text(kStart + seconds{1}).c_str());
  events.poll();
  EXPECT_STREQ("node 50: toggles", events.poll()->text.c_str()) << "told all the same";
  EXPECT_FALSE(events.isExplained(kStart + seconds{10}));
}

TEST(CanopenBusEventsTest, ARefusalIsToldAndLeftToTheDriveToShow) {
  CanBusEvents events;
  takeEvent(event(CanopenEventKind::kNodeRefused, "is another device", kStart, 0), kNodeId, events);
  const auto told = events.poll();
  ASSERT_TRUE(told);
  EXPECT_TRUE(told->warning);
  EXPECT_STREQ("node 50: is another device", told->text.c_str());
  EXPECT_STREQ("", events.text(kStart).c_str());
  takeEvent(event(CanopenEventKind::kDoubleId, "two nodes answer", kStart, 0), kNodeId, events);
  EXPECT_TRUE(events.poll());
  takeEvent(event(CanopenEventKind::kNodeRefused, "two nodes answer", kStart, 0), kNodeId, events);
  EXPECT_FALSE(events.poll()) << "told once";
}

TEST(CanopenBusEventsTest, LostFramesAreToldOnceASecondWithTheirNumber) {
  CanBusEvents events;
  events.noteLostFrames("can0", 0, kStart);
  EXPECT_FALSE(events.poll());
  events.noteLostFrames("can0", 3, kStart);
  EXPECT_STREQ("can0: received frames were lost, 3 since the start: this computer took them too late",
               events.poll()->text.c_str());
  events.noteLostFrames("can0", 5, kStart + milliseconds{999});
  EXPECT_FALSE(events.poll());
  events.noteLostFrames("can0", 5, kStart + seconds{1});
  EXPECT_STREQ("can0: received frames were lost, 5 since the start: this computer took them too late",
               events.poll()->text.c_str());
  events.noteLostFrames("can0", 5, kStart + seconds{9});
  EXPECT_FALSE(events.poll());
}

}  // namespace
}  // namespace nord_driver
