// The acyclic server of a slave, as far as orders of events go: one response at most, made from the request it took
// last, and fetched by the next telegram, whatever that carries.
#pragma once

#include <vector>

#include "explore/explorer.h"
#include "profibus/record.h"

namespace nord_driver::explore {

struct RecordServer {
  bool has = false;  ///< it took a request, and the response was not fetched
  bool write = false;
  std::uint8_t index = 0;
  bool current = false;  ///< of the request that runs at the master now

  void take(ByteView request) {
    has = current = true;
    write = request[0] == 0x5F;
    index = request[2];
  }
  void describe(Key& key) const {
    key.add(has);
    if (has) key.add(write).add(index).add(current);
  }
  std::vector<std::uint8_t> positive() const {
    if (write) return {0x5F, 0, index, 8};
    return {0x5E, 0, index, 8, 0x15, 0xE4, 0, 0, 0, 0, 0, 1};
  }
  std::vector<std::uint8_t> negative(std::uint8_t code) const {
    return {static_cast<std::uint8_t>(write ? 0xDF : 0xDE), 0x80, code, 0};
  }
};

/// Read 101, write 101, read 102.
inline profibus::RecordRequest recordRequest(std::size_t kind) {
  profibus::RecordRequest request;
  request.index = kind == 2 ? 102 : 101;
  request.write = kind == 1;
  request.length = 8;
  if (request.write) request.data.resize(8);
  return request;
}

constexpr const char* kRecordNames[] = {"request: read record 101", "request: write record 101",
                                        "request: read record 102"};

}  // namespace nord_driver::explore
