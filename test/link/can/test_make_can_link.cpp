#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link/can/can_id_filter.h"
#include "link/can/make_can_link.h"
#include "link/can/socket_can.h"
#include "link/can/virtual_can.h"
#include "link/can/virtual_can_hub.h"

namespace nord_driver::link {
namespace {

using ::testing::HasSubstr;

CanSettings named(const std::string& interface) {
  CanSettings settings;
  settings.interface = interface;
  return settings;
}

TEST(MakeCanLink, ChoosesByTheName) {
  EXPECT_NE(nullptr, dynamic_cast<SocketCan*>(makeCanLink(named("can0")).get()));
  EXPECT_NE(nullptr, dynamic_cast<SocketCan*>(makeCanLink(named("can0"), CanRole::kOwner).get()));
  EXPECT_NE(nullptr, dynamic_cast<VirtualCan*>(makeCanLink(named("virtual:x")).get()));
  EXPECT_NE(nullptr, dynamic_cast<VirtualCanHub*>(makeCanLink(named("virtual:x"), CanRole::kOwner).get()));
}

TEST(MakeCanLink, WrongSettingsAreSaidAtTheOpening) {
  for (const CanRole role : {CanRole::kMember, CanRole::kOwner}) {
    for (const char* name : {"a b", "virtual:a b"}) {
      const auto link = makeCanLink(named(name), role);
      EXPECT_FALSE(link->open());
      EXPECT_FALSE(link->isOpen());
      EXPECT_THAT(link->lastError(), HasSubstr("a b"));
    }
  }
}

// As CAN_RAW filters do with EFF and RTR in the mask.
TEST(CanIdFilter, PassesDataFramesOfItsIdentifiersOnly) {
  const CanIdFilter filter{{0x1B2, 0x732}};
  CanFrame extended = dataFrame(0x1B2, {});
  extended.extended = true;
  EXPECT_TRUE(filter.passes(dataFrame(0x1B2, {})));
  EXPECT_TRUE(filter.passes(dataFrame(0x732, {})));
  EXPECT_FALSE(filter.passes(dataFrame(0x1B3, {})));
  EXPECT_FALSE(filter.passes(extended));
  EXPECT_FALSE(filter.passes(remoteFrame(0x732, 1)));
  const CanIdFilter guarding{{0x1B2, 0x732}, {0x732}};
  EXPECT_TRUE(guarding.passes(remoteFrame(0x732, 1)));
  EXPECT_TRUE(guarding.passes(dataFrame(0x732, {})));
  EXPECT_FALSE(guarding.passes(remoteFrame(0x1B2, 1)));
  const CanIdFilter everything{{}};
  EXPECT_TRUE(everything.passes(extended));
  EXPECT_TRUE(everything.passes(remoteFrame(0x732, 1)));
}

}  // namespace
}  // namespace nord_driver::link
