#include "devicenet/error_codes.h"

#include <array>

#include "devicenet/explicit_message.h"

namespace nord_driver::devicenet {
namespace {

struct Meaning {
  std::uint8_t code;
  const char* text;
};

constexpr std::array<Meaning, 42> kGeneral{{
    {0x00, "success, in an error response"},
    {0x01, "a connection on the way failed"},
    {0x02, "a resource that is needed is unavailable"},
    {0x03, "the value of a parameter is invalid"},
    {0x04, "the path has an error"},
    {0x05, "the destination of the path is unknown"},
    {0x06, "only a part was transferred"},
    {0x07, "the connection was lost"},
    {0x08, "the service is not supported"},
    {0x09, "the value of the attribute is invalid"},
    {0x0A, "an attribute of a list failed"},
    {0x0B, "the object is in that state already"},
    {0x0C, "the object cannot do that in its present state"},
    {0x0D, "the object exists already"},
    {0x0E, "the attribute cannot be set"},
    {0x0F, "the privilege is missing"},
    {0x10, "the device cannot do that in its present state"},
    {0x11, "the reply is too large"},
    {0x12, "a primitive value would be fragmented"},
    {0x13, "the request has not enough data"},
    {0x14, "the attribute is not supported"},
    {0x15, "the request has too much data"},
    {0x16, "the object does not exist"},
    {0x17, "fragmentation of this service is not under way"},
    {0x18, "there are no attribute data stored"},
    {0x19, "the store operation failed, the attribute data are not kept"},
    {0x1A, "the request is too large on its way"},
    {0x1B, "the reply is too large on its way"},
    {0x1C, "attributes are missing in the list"},
    {0x1D, "the values of the attributes are invalid"},
    {0x1E, "an embedded service failed"},
    {0x1F, "an error of the manufacturer's own"},
    {0x20, "a parameter of the request is invalid"},
    {0x21, "it was written once and can be written once only"},
    {0x22, "the reply is invalid"},
    {0x23, "the buffer overflowed"},
    {0x24, "the format of the message is wrong"},
    {0x25, "the key in the path does not match"},
    {0x26, "the path has a wrong size"},
    {0x27, "an attribute of the list was not expected"},
    {0x28, "the member id is invalid"},
    {0x29, "the member cannot be set"},
}};

constexpr Meaning kGroup2Only{0x2A, "general failure of a Group-2-only server"};

constexpr std::array<Meaning, 4> kAllocate{{
    {0x01, "allocation conflict, it is allocated already"},
    {0x02, "invalid allocation choice, it does not have these connections"},
    {0x03, "only allocate and release are taken on the unconnected port"},
    {0x04, "resource unavailable, it has no room for the connections"},
}};

template <std::size_t N>
const char* find(const std::array<Meaning, N>& meanings, std::uint8_t code) noexcept {
  for (const Meaning& meaning : meanings) {
    if (meaning.code == code) return meaning.text;
  }
  return nullptr;
}

}  // namespace

const char* generalErrorMeaning(std::uint8_t code) noexcept {
  return code == kGroup2Only.code ? kGroup2Only.text : find(kGeneral, code);
}

const char* additionalErrorMeaning(std::uint8_t asked_service, std::uint8_t code) noexcept {
  const bool has_own = asked_service == service::kAllocate || asked_service == service::kRelease;
  return has_own ? find(kAllocate, code) : nullptr;
}

Sentence errorText(std::uint8_t asked_service, std::uint8_t general, std::uint8_t additional) noexcept {
  const char* meaning = generalErrorMeaning(general);
  Sentence text;
  text.format("refuses: %s (%02Xh)", meaning != nullptr ? meaning : "an error code that is reserved",
              unsigned{general});
  if (additional == kNoAdditionalCode) return text;
  const char* more = additionalErrorMeaning(asked_service, additional);
  Sentence whole;
  if (more != nullptr) {
    whole.format("%.150s: %s (additional code %02Xh)", text.c_str(), more, unsigned{additional});
  } else {
    whole.format("%.200s, additional code %02Xh", text.c_str(), unsigned{additional});
  }
  return whole;
}

}  // namespace nord_driver::devicenet
