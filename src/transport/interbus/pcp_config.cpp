#include "transport/interbus/pcp_config.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "config/setting_checks.h"

namespace nord_driver {

namespace {

constexpr std::int64_t kLastRegister = 65535;
constexpr std::int64_t kLowestReference = 2, kHighestReference = 127;  // 0 and 1 are the master's own

/// A field of a block: its key and its place.
struct FieldKey {
  std::string key;
  unsigned* place;
};

void readFields(const Settings& bus, const std::string& block, const std::vector<FieldKey>& fields) {
  for (const FieldKey& field : fields) {
    *field.place = static_cast<unsigned>(
        integerOr(bus, block + field.key, *field.place, 0, static_cast<std::int64_t>(interbus::kMostBlockWords) - 1));
  }
}

void refuseLayout(const Settings& bus, const std::string& block, const std::string& fault) {
  if (!fault.empty()) throw ConfigError(bus.fullName(block) + fault);
}

bool meet(unsigned a, unsigned a_words, unsigned b, unsigned b_words) {
  return a < b + b_words && b < a + a_words;
}

std::string registersText(unsigned first, unsigned words) {
  return std::to_string(first) + " to " + std::to_string(first + words - 1);
}

}  // namespace

std::optional<PcpMap> readPcp(const Settings& bus) {
  static const char* const kKeys[] = {"invoke/address",    "invoke/service", "invoke/reference", "invoke/index",
                                      "invoke/sub_index",  "invoke/length",  "invoke/data",      "result/address",
                                      "result/function",   "result/service", "result/reference", "result/error",
                                      "result/additional", "result/length",  "result/data",      "initiate",
                                      "timeout",           "first_reference"};
  const bool there = std::any_of(std::begin(kKeys), std::end(kKeys),
                                 [&](const char* key) { return bus.has(std::string("pcp/") + key); });
  if (!there) return std::nullopt;
  PcpMap map;
  map.invoke_address = static_cast<std::uint16_t>(requiredInteger(bus, "pcp/invoke/address", 0, kLastRegister));
  map.result_address = static_cast<std::uint16_t>(requiredInteger(bus, "pcp/result/address", 0, kLastRegister));
  map.result_in_input_registers = integerOr(bus, "pcp/result/function", 3, 3, 4) == 4;
  interbus::PcpInvokeLayout& invoke = map.invoke;
  readFields(bus, "pcp/invoke/",
             {{"service", &invoke.service},
              {"reference", &invoke.reference},
              {"index", &invoke.index},
              {"sub_index", &invoke.sub_index},
              {"length", &invoke.length},
              {"data", &invoke.data}});
  interbus::PcpResultLayout& result = map.result;
  readFields(bus, "pcp/result/",
             {{"service", &result.service},
              {"reference", &result.reference},
              {"error", &result.error},
              {"additional", &result.additional},
              {"length", &result.length},
              {"data", &result.data}});
  refuseLayout(bus, "pcp/invoke/", layoutFault(invoke));
  refuseLayout(bus, "pcp/result/", layoutFault(result));
  map.initiate = booleanOr(bus, "pcp/initiate", map.initiate);
  map.timeout = seconds(numberOr(bus, "pcp/timeout", toSeconds(map.timeout), 0.1, 60.0, "s"));
  return map;
}

void checkPcp(const Settings& bus, const PcpMap& map, const link::ModbusSettings& server) {
  const unsigned invoke_words = blockWords(map.invoke), result_words = blockWords(map.result);
  const auto refuse = [&](const char* key, unsigned address, const std::string& expected) {
    throw wrongSetting(bus, key, std::to_string(address), expected);
  };
  if (map.invoke_address + invoke_words > kLastRegister + 1) {
    refuse("pcp/invoke/address", map.invoke_address, "a block that ends at register 65535 at most");
  }
  if (map.result_address + result_words > kLastRegister + 1) {
    refuse("pcp/result/address", map.result_address, "a block that ends at register 65535 at most");
  }
  for (const WordRange& part : server.outputs.parts) {
    const unsigned first = server.outputs.address + part.first;
    if (!meet(map.invoke_address, invoke_words, first, part.count)) continue;
    refuse("pcp/invoke/address", map.invoke_address,
           "registers outside the output image, which takes " + registersText(first, part.count));
  }
  if (server.watchdog && meet(map.invoke_address, invoke_words, server.watchdog->address, 1)) {
    refuse("pcp/invoke/address", map.invoke_address,
           "registers without that of the watchdog, " + std::to_string(server.watchdog->address));
  }
  if (!map.result_in_input_registers && meet(map.invoke_address, invoke_words, map.result_address, result_words)) {
    refuse("pcp/result/address", map.result_address,
           "registers outside the invoke block, which takes " + registersText(map.invoke_address, invoke_words));
  }
}

void readReferences(const Settings& bus, const std::vector<DriveSettings>& sources,
                    std::vector<InterbusDrive>& drives) {
  const std::int64_t first =
      integerOr(bus, "pcp/first_reference", kLowestReference, kLowestReference, kHighestReference);
  std::vector<std::size_t> ring(drives.size());
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  std::sort(ring.begin(), ring.end(),
            [&](std::size_t a, std::size_t b) { return drives[a].position < drives[b].position; });
  for (std::size_t place = 0; place < ring.size(); ++place) {
    const Settings& settings = *sources[ring[place]].settings;
    const auto reference = integerOr(settings, "communication_reference", first + static_cast<std::int64_t>(place),
                                     kLowestReference, kHighestReference);
    drives[ring[place]].communication_reference = static_cast<std::uint16_t>(reference);
    for (std::size_t i = 0; i < place; ++i) {
      const InterbusDrive& other = drives[ring[i]];
      if (other.communication_reference != reference) continue;
      throw wrongSetting(settings, "communication_reference", std::to_string(reference),
                         "one of its own: drive " + other.name + " has it");
    }
  }
}

}  // namespace nord_driver
