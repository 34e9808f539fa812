#include "canopen/boot_sentences.h"

namespace nord_driver::canopen {

Sentence doubleId() noexcept {
  return Sentence{"two nodes answer with this id: is it set twice, by switches or P515?"};
}

Sentence stoppedFirst() noexcept {
  return Sentence{"was found operational, with nobody who commands it: its drives are stopped before it is set up"};
}

Sentence askedBySync() noexcept {
  return Sentence{"is asked by SYNC whether a drive of it is enabled, before it is set up"};
}

Sentence restarted() noexcept {
  return Sentence{"has restarted by itself: it sent its boot-up"};
}

Sentence restartsAgainAndAgain() noexcept {
  return Sentence{
      "sends its boot-up again and again: two nodes with this id, or a heartbeat that says 0, or a supply that "
      "breaks down"};
}

Sentence leftByItself(NmtState state) noexcept {
  Sentence text;
  text.format("is %s now, which we did not tell it", toText(state));
  return text;
}

Sentence toldByAnother(NmtCommand command) noexcept {
  Sentence text;
  text.format("was told \"%s\" by another master", toText(command));
  return text;
}

Sentence stoppedAnswering(const SdoRequest& request) noexcept {
  Sentence text;
  text.format("stopped answering in its start-up (SDO %04Xh:%u)", unsigned{request.index}, unsigned{request.sub_index});
  return text;
}

Sentence doesNotAnswer(const Sentence& lost_why) noexcept {
  if (lost_why.empty()) return Sentence{"does not answer: is it powered, and are its node id and bit rate right?"};
  Sentence text;
  text.format("%s; since then it does not answer: is it powered and connected?", lost_why.c_str());
  return text;
}

}  // namespace nord_driver::canopen
