#include "node/broker_parameters.h"

#include <utility>

#include "profile/parameter_shape.h"
#include "tools/counted_write.h"

namespace nord_driver::node {

using profile::ParameterOutcome;
using tools::ParameterAnswer;

namespace {

ParameterAnswer answerOf(const cycle::Completion& completion, const catalogue::ParameterAccess& access) {
  const profile::ParameterResult& result = completion.parameter;
  ParameterAnswer answer;
  answer.success = completion.success;
  answer.refused = result.outcome == ParameterOutcome::kRefused;
  answer.unknown = answer.refused && result.refused_number == access.request.number &&
                   result.reason == profile::ParameterReason::kNoSuchParameter;
  answer.passing = answer.refused && mayPass(result.reason);
  answer.message = completion.message.str();
  answer.raw = result.raw;
  answer.value = catalogue::valueOf(access.entry, result.raw, access.request.index);
  answer.entry = access.entry;
  answer.set = profile::hasSets(access.request.shape) ? access.request.parameter_set : std::uint8_t{0};
  return answer;
}

}  // namespace

BrokerParameters::BrokerParameters(const BrokerDrive& drive, Duration patience, CarryOut carry_out)
    : drive_(drive), patience_(patience), carry_out_(std::move(carry_out)) {}

cycle::Completion BrokerParameters::ask(cycle::RequestKind kind, const catalogue::ParameterAccess& access) const {
  cycle::Request request;
  request.kind = kind;
  request.drive = drive_.index;
  request.patience = patience_;
  request.parameter = access.request;
  return carry_out_(request);
}

ParameterAnswer BrokerParameters::read(const catalogue::ParameterAddress& address) {
  const catalogue::ParameterAccess access = catalogue::accessTo(address, drive_.known);
  if (!access.error.empty()) throw tools::Trouble(access.error);
  return answerOf(ask(cycle::RequestKind::kReadParameter, access), access);
}

ParameterAnswer BrokerParameters::write(const catalogue::ParameterAccess& access) {
  const tools::CountedWrite write = tools::countedWrite(
      drive_.eeprom, access.request, [&] { return ask(cycle::RequestKind::kWriteParameter, access); });
  ParameterAnswer answer;
  if (write.completion) answer = answerOf(*write.completion, access);
  if (!write.refusal.empty()) {
    answer.refused = true;
    answer.message = write.refusal;
  }
  if (!write.note.empty()) answer.message += (answer.message.empty() ? "" : "; ") + write.note;
  return answer;
}

}  // namespace nord_driver::node
