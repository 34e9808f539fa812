#include "cycle/enable_refusal.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "cycle/user_messages.h"

namespace nord_driver::cycle {

using drive::Refusal;

namespace {

constexpr Refusal kFirst[] = {Refusal::kFault, Refusal::kFaultLatched, Refusal::kOffline};

bool comesFirst(Refusal refusal) noexcept {
  return std::find(std::begin(kFirst), std::end(kFirst), refusal) != std::end(kFirst);
}

// Several clauses in the length of a sentence: one that does not fit is told to be missing.
class Clauses {
 public:
  void add(const char* clause) noexcept {
    constexpr const char* kMore = "; and more";
    const std::size_t length = std::strlen(text_.c_str());
    if (left_out_) return;
    left_out_ = length + std::strlen(clause) + 2 + std::strlen(kMore) > kLongest;
    if (left_out_) clause = kMore + 2;
    Sentence longer;
    longer.format("%s%s%s", text_.c_str(), length == 0 ? "" : "; ", clause);
    text_ = longer;
  }
  const Sentence& text() const noexcept { return text_; }

 private:
  static constexpr std::size_t kLongest = 250;  // of a Sentence

  Sentence text_;
  bool left_out_ = false;
};

Sentence namesOf(Refusal refusal, const std::vector<std::string>& names, const std::vector<Refusal>& refusals,
                 std::size_t from) noexcept {
  Sentence who;
  int count = 0;
  for (std::size_t i = from; i < names.size(); ++i) {
    if (refusals[i] != refusal) continue;
    Sentence longer;
    longer.format("%.100s%s%s", who.c_str(), count == 0 ? "" : ", ", names[i].c_str());
    who = longer;
    ++count;
  }
  Sentence text;
  if (count != 0) text.format("drive%s %.120s", count == 1 ? "" : "s", who.c_str());
  return text;
}

// What to set is told by its value only.
bool hasAValue(Refusal refusal) noexcept {
  return refusal == Refusal::kMinimumFrequency || refusal == Refusal::kUnexpectedFunction ||
         refusal == Refusal::kUnexpectedSource;
}

const char* nextCall(Refusal refusal) noexcept {
  if (refusal == Refusal::kFaultLatched) return " (~acknowledge_faults)";
  return refusal == Refusal::kFault ? " (when its cause is gone: ~acknowledge_faults)" : "";
}

// "drives left, right: the inverter does not answer"
Sentence clauseOf(Refusal refusal, const std::vector<std::string>& names, const std::vector<drive::Drive>& drives,
                  const std::vector<Refusal>& refusals) noexcept {
  Sentence clause;
  if (!hasAValue(refusal)) {
    clause.format("%.130s: %s%s", namesOf(refusal, names, refusals, 0).c_str(), drive::toString(refusal),
                  nextCall(refusal));
    return clause;
  }
  const auto first = static_cast<std::size_t>(std::find(refusals.begin(), refusals.end(), refusal) - refusals.begin());
  const Sentence others = namesOf(refusal, names, refusals, first + 1);
  clause.format("%.190s%s%.50s%s", refusalMessage(names[first].c_str(), refusal, drives[first].report()).c_str(),
                others.empty() ? "" : "; ", others.c_str(), others.empty() ? "" : ": the same");
  return clause;
}

// Beside other reasons: without its numbers and what to do about it.
Sentence shortened(const Sentence& commands) noexcept {
  Sentence text;
  const char* const detail = std::strpbrk(commands.c_str(), "(:");
  std::size_t length =
      detail == nullptr ? std::strlen(commands.c_str()) : static_cast<std::size_t>(detail - commands.c_str());
  while (length > 0 && commands.c_str()[length - 1] == ' ') --length;
  text.format("%.*s", static_cast<int>(length), commands.c_str());
  return text;
}

}  // namespace

Sentence enableRefusalMessage(const std::vector<std::string>& names, const std::vector<drive::Drive>& drives,
                              const std::vector<Refusal>& refusals, const Sentence& commands) noexcept {
  const auto refuses = [](Refusal refusal) { return refusal != Refusal::kNone; };
  const auto drive = std::find_if(refusals.begin(), refusals.end(), refuses);
  if (drive == refusals.end()) return commands;
  const bool single = commands.empty() && std::none_of(drive + 1, refusals.end(), refuses);
  if (single) {
    const auto i = static_cast<std::size_t>(drive - refusals.begin());
    return refusalMessage(names[i].c_str(), *drive, drives[i].report());
  }
  Clauses clauses;
  for (const Refusal refusal : kFirst) {
    if (std::find(refusals.begin(), refusals.end(), refusal) == refusals.end()) continue;
    clauses.add(clauseOf(refusal, names, drives, refusals).c_str());
  }
  for (auto i = refusals.begin(); i != refusals.end(); ++i) {
    if (!refuses(*i) || comesFirst(*i) || std::find(refusals.begin(), i, *i) != i) continue;
    clauses.add(clauseOf(*i, names, drives, refusals).c_str());
  }
  if (!commands.empty()) clauses.add(shortened(commands).c_str());
  return clauses.text();
}

}  // namespace nord_driver::cycle
