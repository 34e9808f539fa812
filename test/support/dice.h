// Chance of a test, the same for the same seed.
#pragma once

#include <cstdint>
#include <random>

namespace nord_driver::test {

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : random_{seed} {}
  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }
  bool coin() { return below(2) == 0; }
  /// Both ends included.
  int from(int least, int most) { return least + static_cast<int>(below(static_cast<unsigned>(most - least + 1))); }
  /// In a thousand steps.
  double from(double least, double most) { return least + (most - least) * 0.001 * below(1001); }

 private:
  std::mt19937 random_;
};

}  // namespace nord_driver::test
