#include "devicenet/explicit_channel.h"

namespace nord_driver::devicenet {

void ExplicitChannel::handleNewConnection(Instant now) noexcept {
  client_.forgetOwed();
  startNext(now);
}

void ExplicitChannel::close() noexcept {
  open_ = false;
  if (owner_ == Owner::kUser) cancel();
  while (!users_.empty()) endUser(ExplicitEnd::kNotConnected);
}

void ExplicitChannel::endUser(ExplicitEnd end) noexcept {
  ExplicitAnswer answer;
  answer.end = end;
  users_.finish(answer);
}

void ExplicitChannel::cancel() noexcept {
  client_.cancel();
  owner_ = Owner::kNobody;
}

bool ExplicitChannel::submit(const ExplicitRequest& request, Instant now) noexcept {
  if (!isOpen()) {
    ExplicitAnswer answer;
    answer.end = ExplicitEnd::kNotConnected;
    return users_.answer(request, answer);
  }
  if (!users_.submit(request)) return false;
  startNext(now);
  return true;
}

void ExplicitChannel::ask(const ExplicitRequest& request, ExplicitPort port, Duration timeout, Instant now) noexcept {
  cancelOwn();
  own_ = Own{request, port, timeout};
  startNext(now);
}

void ExplicitChannel::cancelOwn() noexcept {
  if (owner_ == Owner::kEngine) cancel();
  own_.reset();
  own_answer_.reset();
}

void ExplicitChannel::silence() noexcept {
  close();
  cancelOwn();
  cancel();
  client_.silence();
}

std::optional<ExplicitAnswer> ExplicitChannel::takeOwnAnswer() noexcept {
  const std::optional<ExplicitAnswer> answer = own_answer_;
  own_answer_.reset();
  return answer;
}

Heard ExplicitChannel::handle(const CanFrame& frame, Instant now) noexcept {
  const Heard heard = client_.handle(frame, now);
  if (heard == Heard::kTaken) used_at_ = now;
  takeAnswer(now);
  return heard;
}

void ExplicitChannel::poll(Instant now) noexcept {
  client_.poll(now);
  takeAnswer(now);
}

void ExplicitChannel::takeAnswer(Instant now) noexcept {
  const std::optional<ExplicitAnswer> answer = client_.takeAnswer();
  if (answer) {
    if (owner_ == Owner::kEngine) own_answer_ = answer;
    if (owner_ == Owner::kUser) users_.finish(*answer);
    owner_ = Owner::kNobody;
  }
  startNext(now);
}

void ExplicitChannel::startNext(Instant now) noexcept {
  while (owner_ == Owner::kNobody && !client_.busy()) {
    const bool user = isOpen() && !users_.empty() && !client_.mustWait(now);
    if (own_ && (!user || last_ == Owner::kUser)) {
      startOwn(now);
    } else if (user) {
      startUser(now);
    } else {
      return;
    }
  }
}

// A request that waits for a transaction id has no time-out of its own yet.
std::optional<Instant> ExplicitChannel::nextDeadline() const noexcept {
  const bool waits = owner_ == Owner::kNobody && isOpen() && !users_.empty();
  return waits ? earlier(client_.nextDeadline(), client_.freeAt()) : client_.nextDeadline();
}

void ExplicitChannel::startOwn(Instant now) noexcept {
  const Own own = *own_;
  own_.reset();
  last_ = Owner::kEngine;
  if (client_.start(own.request, own.port, format_, own.timeout, now)) {
    owner_ = Owner::kEngine;
  } else {
    own_answer_ = ExplicitAnswer{};
    own_answer_->end = ExplicitEnd::kTooLong;
  }
}

void ExplicitChannel::startUser(Instant now) noexcept {
  last_ = Owner::kUser;
  if (client_.start(users_.front(), ExplicitPort::kConnected, format_, timeout_, now)) {
    owner_ = Owner::kUser;
  } else {
    endUser(ExplicitEnd::kTooLong);
  }
}

}  // namespace nord_driver::devicenet
