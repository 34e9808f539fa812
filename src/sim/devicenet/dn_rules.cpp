// What the rules of the referee say. The sections of the volume are not to be had: where no manual of a maker prints a
// rule, it is named after what it is about.

#include "sim/devicenet/dn_referee.h"

namespace nord_driver::sim {

const char* toString(DnRule rule) noexcept {
  switch (rule) {
    case DnRule::kExtendedFrame:
      return "a frame with a 29 bit identifier: DeviceNet uses 11 bits";
    case DnRule::kRemoteFrame:
      return "a remote frame: DeviceNet has none";
    case DnRule::kIdOfANode:
      return "a frame with an identifier that a slave sends itself";
    case DnRule::kUnknownId:
      return "a frame with an identifier that nobody listens to";
    case DnRule::kDuplicateMacLength:
      return "a duplicate-MAC message that is not seven bytes long";
    case DnRule::kBeforeDuplicateCheck:
      return "a frame before the duplicate-MAC check has ended: two requests, a second after each";
    case DnRule::kDuplicateMacUnanswered:
      return "a duplicate-MAC request for the scanner's own MAC id that it did not answer";
    case DnRule::kSecondMaster:
      return "a second scanner, or a second MAC id of the first one";
    case DnRule::kHeaderMac:
      return "an explicit message with another MAC id than the scanner's in its first byte";
    case DnRule::kUnconnectedService:
      return "something else than allocate or release of class 3, instance 1, on the unconnected port";
    case DnRule::kChoice:
      return "an allocation with choice bits that cannot be: none, reserved ones, change of state with cyclic, "
             "acknowledge suppression without them";
    case DnRule::kAllocateWithoutExplicit:
      return "an allocation of process data of a slave that has no explicit connection (group 2 only)";
    case DnRule::kReleaseChoice:
      return "a release with choice bits that were not allocated";
    case DnRule::kExplicitBeforeAllocation:
      return "an explicit message to a slave whose explicit connection is not allocated";
    case DnRule::kExplicitLength:
      return "an explicit message that is too short or too long for what it says";
    case DnRule::kExplicitWhilePending:
      return "an explicit request to a slave that has not answered the one before";
    case DnRule::kFragmentOrder:
      return "a fragment of an explicit message before the one before was acknowledged";
    case DnRule::kFragmentUnacknowledged:
      return "a fragment of an explicit message that was not acknowledged within a second";
    case DnRule::kIoBeforeAllocation:
      return "process data to a slave whose I/O connection is not allocated";
    case DnRule::kIoBeforePacketRate:
      return "process data before the expected packet rate was set";
    case DnRule::kIoSizesUnread:
      return "process data before produced and consumed size were read (class 5, attributes 7 and 8)";
    case DnRule::kIoSize:
      return "process data of another length than the connection consumes";
    case DnRule::kIoFragments:
      return "process data of more than eight bytes without fragments, or with fragments out of order";
    case DnRule::kIoAfterTimeout:
      return "process data later than four times the expected packet rate, without an allocation in between";
    case DnRule::kNoPacketRate:
      return "an expected packet rate of zero: nobody would notice that the scanner is gone";
    case DnRule::kStrobeLength:
      return "a bit strobe that is not eight bytes long";
    case DnRule::kStrobeBit:
      return "a bit strobe with the bit of a module that is polled as well: it keeps its last outputs (BU 0280 4.2.1)";
    case DnRule::kAcknowledgeUnasked:
      return "an acknowledge of data that nobody wants acknowledged";
    case DnRule::kChangeUnacknowledged:
      return "change of state or cyclic data that were not acknowledged";
    case DnRule::kZeroControlWord:
      return "a control word with bit 10 = 0 after valid ones: it is not evaluated, the drive runs on (BU 0280 7.2.1)";
    case DnRule::kCount:
      break;
  }
  return "?";
}

}  // namespace nord_driver::sim
