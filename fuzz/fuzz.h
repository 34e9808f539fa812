// What every fuzz target uses: a source of choices, and a check that ends the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "nord_driver/core/bytes.h"

/// The entry point of libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nord_driver::fuzz {

inline void require(bool good) {
  if (!good) std::abort();
}

/// Spends the fuzzer's bytes as numbers; zeros when they are used up.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : reader_(ByteView{data, size}), left_(size) {}

  bool empty() const { return left_ == 0; }
  std::uint8_t byte() {
    if (left_ > 0) --left_;
    return reader_.u8();
  }
  std::uint8_t below(unsigned limit) { return static_cast<std::uint8_t>(byte() % limit); }
  /// Up to `count` bytes.
  FixedBytes<256> bytes(std::size_t count) {
    FixedBytes<256> taken;
    while (taken.size() < count && !empty()) taken.push_back(byte());
    return taken;
  }

 private:
  ByteReader reader_;
  std::size_t left_;
};

}  // namespace nord_driver::fuzz
