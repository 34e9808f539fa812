// The turn of each request, its result under its own id, and the one limit over both.
#include <gtest/gtest.h>

#include "core/request_queue.h"

namespace nord_driver {
namespace {

struct Request {
  int id = 0;
  char what = ' ';
};
struct Result {
  int id = 0;
  int value = 0;
};

TEST(RequestQueue, RequestsHaveTheirTurnAndResultsTheirIds) {
  RequestQueue<Request, Result, 4> queue;
  EXPECT_TRUE(queue.empty());
  ASSERT_TRUE(queue.submit({7, 'a'}));
  ASSERT_TRUE(queue.submit({9, 'b'}));
  EXPECT_EQ(2u, queue.size());
  EXPECT_EQ('a', queue.front().what);
  EXPECT_FALSE(queue.pollResult());

  queue.finish({0, 100});
  EXPECT_EQ('b', queue.front().what);
  queue.finish({0, 200});
  EXPECT_TRUE(queue.empty());

  const auto first = queue.pollResult();
  ASSERT_TRUE(first);
  EXPECT_EQ(7, first->id);
  EXPECT_EQ(100, first->value);
  EXPECT_EQ(9, queue.pollResult()->id);
  EXPECT_FALSE(queue.pollResult()) << "each result comes once";
}

// Otherwise a finished request could find no room for its result.
TEST(RequestQueue, ResultsNobodyFetchedTakeRoom) {
  RequestQueue<Request, Result, 2> queue;
  ASSERT_TRUE(queue.submit({1, 'a'}));
  ASSERT_TRUE(queue.submit({2, 'b'}));
  EXPECT_FALSE(queue.submit({3, 'c'}));
  queue.finish({});
  EXPECT_FALSE(queue.submit({3, 'c'}));
  EXPECT_FALSE(queue.answer({3, 'c'}, {}));
  ASSERT_TRUE(queue.pollResult());
  EXPECT_TRUE(queue.submit({3, 'c'}));
  EXPECT_EQ('b', queue.front().what);
}

TEST(RequestQueue, AnAnswerNeedsNoTurn) {
  RequestQueue<Request, Result, 2> queue;
  ASSERT_TRUE(queue.submit({1, 'a'}));
  ASSERT_TRUE(queue.answer({2, 'b'}, {0, 5}));
  EXPECT_EQ(1u, queue.size());
  const auto result = queue.pollResult();
  ASSERT_TRUE(result);
  EXPECT_EQ(2, result->id);
  EXPECT_EQ(5, result->value);
}

}  // namespace
}  // namespace nord_driver
