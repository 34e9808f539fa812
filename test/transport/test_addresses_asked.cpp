// The addresses in a sentence that nobody answers: a bus may have 126 of them, the sentence has 250 characters.
#include <gtest/gtest.h>

#include <vector>

#include "transport/addresses_asked.h"

namespace nord_driver {
namespace {

std::string asked(const std::vector<unsigned>& addresses) {
  return addressesAsked(addresses.size(), [&](std::size_t i) { return addresses[i]; }).str();
}

TEST(AddressesAsked, AreListedAndOfManyTheFirstOnes) {
  EXPECT_EQ("", asked({}));
  EXPECT_EQ("3", asked({3}));
  EXPECT_EQ("3, 4, 126", asked({3, 4, 126}));
  std::vector<unsigned> many{101, 102, 103, 104, 105, 106, 107, 108};
  EXPECT_EQ("101, 102, 103, 104, 105, 106, 107, 108", asked(many));
  many.resize(126, 126);
  EXPECT_EQ("101, 102, 103, 104, 105, 106, 107, 108 and 118 more", asked(many));
}

}  // namespace
}  // namespace nord_driver
