// An element of the position array is read when it is chosen, and no answer is taken for that of another one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/element_reader.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;
using ::testing::HasSubstr;

profile::ParameterResult result(ParameterOutcome outcome, std::int32_t raw = 0) {
  profile::ParameterResult answer;
  answer.outcome = outcome;
  answer.raw = raw;
  return answer;
}

TEST(ElementReaderTest, ReadsOnceWhatIsAskedFor) {
  ElementReader reader;
  EXPECT_FALSE(reader.pollRequest());
  reader.ask(5);
  const auto request = reader.pollRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(613, request->number);
  EXPECT_EQ(5, request->index);
  EXPECT_EQ(profile::ParameterShape::kArray, request->shape);
  EXPECT_FALSE(reader.pollRequest());
  EXPECT_FALSE(reader.poll());
  reader.handleResult(result(ParameterOutcome::kDone, -51'000), "lift");
  const auto read = reader.poll();
  ASSERT_TRUE(read && read->known);
  EXPECT_EQ(5, read->element);
  EXPECT_EQ(-51'000, read->raw);
  EXPECT_FALSE(reader.poll());
  EXPECT_FALSE(reader.isAsked());
  EXPECT_FALSE(reader.pollRequest());
}

TEST(ElementReaderTest, SaysWhyNobodyKnowsIt) {
  ElementReader reader;
  reader.ask(5);
  reader.pollRequest();
  reader.handleResult(result(ParameterOutcome::kBusy), "lift");
  EXPECT_FALSE(reader.poll()) << "not asked at all";
  ASSERT_TRUE(reader.pollRequest());
  reader.handleResult(result(ParameterOutcome::kTimeout), "lift");
  const auto read = reader.poll();
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->known);
  EXPECT_THAT(read->why.str(), HasSubstr("P613"));
}

TEST(ElementReaderTest, ForgetsWhatIsForgotten) {
  ElementReader reader;
  reader.ask(5);
  reader.pollRequest();
  reader.forget();
  reader.handleResult(result(ParameterOutcome::kDone, 1), "lift");
  EXPECT_FALSE(reader.poll());
  reader.ask(6);
  reader.handleResult(result(ParameterOutcome::kDone, 1), "lift");
  EXPECT_FALSE(reader.poll()) << "6 has not been asked for yet";
}

// The transport need not repeat which parameter was refused, and a drive that went away has answered, too.
TEST(ElementReaderTest, NamesItsParameterWhateverHappened) {
  ElementReader reader;
  reader.ask(5);
  reader.pollRequest();
  profile::ParameterResult refused = result(ParameterOutcome::kRefused);
  refused.reason = profile::ParameterReason::kReadOnly;
  reader.handleResult(refused, "lift");
  const auto read = reader.poll();
  ASSERT_TRUE(read);
  EXPECT_THAT(read->why.str(), ::testing::StartsWith("drive lift refuses P613"));
  reader.ask(6);
  reader.pollRequest();
  reader.handleResult(result(ParameterOutcome::kOffline), "lift");
  const auto away = reader.poll();
  ASSERT_TRUE(away);
  EXPECT_EQ(6, away->element);
  EXPECT_FALSE(away->known);
  EXPECT_EQ("drive lift does not answer", away->why.str());
}

// What it has asked for before is over; whether that has to be answered first is for its caller to know.
TEST(ElementReaderTest, AsksForTheNewestChoiceAtOnce) {
  ElementReader reader;
  reader.ask(5);
  reader.pollRequest();
  reader.ask(6);
  const auto request = reader.pollRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(6, request->index);
  reader.handleResult(result(ParameterOutcome::kDone, 1), "lift");
  reader.ask(7);
  EXPECT_FALSE(reader.poll()) << "what was read of 6 is not chosen any more";
}

}  // namespace
}  // namespace nord_driver::cycle
