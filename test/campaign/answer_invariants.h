// The invariants of requests and their answers.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/invariant.h"

namespace nord_driver::test {

class EveryCallAnswered final : public Invariant {
 public:
  const char* name() const override { return "EveryCallAnswered"; }
  const char* sentence() const override {
    return "services wait for the drive to confirm (service_timeout) and tell what they saw last when it does not: "
           "within "
           "the asker's patience and one cycle";
  }
  std::optional<std::string> look(const Moment& moment) override;
};

class NoCallAnsweredTwice final : public Invariant {
 public:
  const char* name() const override { return "NoCallAnsweredTwice"; }
  const char* sentence() const override { return "one completion for each request (architecture, decision 5)"; }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  std::map<std::uint32_t, int> answers_;
};

/// What an answer says is so: enabled drives are, disabled ones are at rest, a value read was there.
class AnswersAreTrue final : public Invariant {
 public:
  const char* name() const override { return "AnswersAreTrue"; }
  const char* sentence() const override {
    return "they wait for the drive to confirm; write_parameter: the value read back; a refused answer has a sentence";
  }
  std::optional<std::string> look(const Moment& moment) override;

 private:
  std::optional<std::string> judge(const Moment& moment, const cycle::Completion& answer, const Call& call) const;

  std::vector<Instant> enabled_at_, rested_at_;  // when each drive was so last
};

}  // namespace nord_driver::test
