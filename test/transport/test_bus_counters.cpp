// Counters by name, and the ones that the buses of this package tell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "transport/canopen/canopen_counters.h"
#include "transport/profibus/profibus_counters.h"

namespace nord_driver {
namespace {

TEST(BusCounters, AreFoundByTheirNames) {
  BusCounters counters;
  counters.add(bus_counter::kRetries, 7);
  counters.add({"lamps", "lamps that went out"}, 2);
  EXPECT_EQ(7u, counters.value(bus_counter::kRetries));
  EXPECT_EQ(7u, counters.value("retries"));
  EXPECT_EQ(2u, counters.value("lamps"));
  EXPECT_EQ(0u, counters.value("ropes")) << "nobody counts them";
  EXPECT_STREQ("lamps that went out", (counters.begin() + 1)->meaning);
}

TEST(BusCounters, WhatIsTooMuchIsLeftOut) {
  BusCounters counters;
  for (std::size_t i = 0; i <= BusCounters::kCapacity; ++i) counters.add({"one", "of many"}, i);
  EXPECT_EQ(BusCounters::kCapacity, counters.size());
}

// A name is a key of /diagnostics and of scripts: told once, readable, and with a meaning; and none is left out.
void expectSound(const BusCounters& counters) {
  EXPECT_LT(counters.size(), BusCounters::kCapacity);
  std::set<std::string> names;
  for (const NamedCounter& counter : counters) {
    EXPECT_TRUE(names.insert(counter.name).second) << counter.name << " stands there twice";
    EXPECT_TRUE(std::regex_match(counter.name, std::regex("[a-z][a-z0-9_]*"))) << counter.name;
    EXPECT_STRNE("", counter.meaning) << counter.name;
  }
}

TEST(ProfibusCounters, SayWhatTheyMean) {
  profibus::Counters master;
  master.retries = 3;
  master.unexpected = 4;
  master.busy = 5;
  link::LineCounters line;
  line.collisions = 10;
  line.framing_errors = 6;
  const BusCounters counters = profibusCounters(master, line, 8);
  expectSound(counters);
  EXPECT_EQ(3u, counters.value(bus_counter::kRetries));
  EXPECT_EQ(14u, counters.value(bus_counter::kUnexpected)) << "what came at once with our own counts, too";
  EXPECT_EQ(10u, counters.value("collisions"));
  EXPECT_EQ(6u, counters.value("framing_errors"));
  EXPECT_EQ(5u, counters.value("busy_line"));
  EXPECT_EQ(8u, counters.value(bus_counter::kStale));
}

// The controller repeats frames and checks them: what it tells are error frames, and nothing here is a retry.
TEST(CanopenCounters, SayWhatTheyMean) {
  canopen::MasterConfig config;
  config.nodes.resize(1);
  config.nodes[0].id = 3;
  const canopen::Master master{config};
  link::CanCounters line;
  line.bus_errors = 3;
  line.no_acknowledge = 4;
  line.dropped = 5;
  line.bus_off = 1;
  const BusCounters counters = canopenCounters(master, line);
  expectSound(counters);
  EXPECT_EQ(3u, counters.value("error_frames"));
  EXPECT_EQ(4u, counters.value("no_acknowledge"));
  EXPECT_EQ(5u, counters.value(bus_counter::kOverruns));
  EXPECT_EQ(1u, counters.value("bus_off"));
  for (const NamedCounter& counter : counters) {
    EXPECT_STRNE("retries", counter.name);
    EXPECT_STRNE("checksum_errors", counter.name);
  }
}

}  // namespace
}  // namespace nord_driver
