#include "canopen/dictionary_text.h"

#include "canopen/sdo_abort.h"

namespace nord_driver::canopen {

std::optional<std::uint32_t> numberOf(const SdoAnswer& answer, std::size_t size) noexcept {
  const std::optional<std::uint32_t> number = answer.number();
  if (!number || size >= sizeof(std::uint32_t)) return number;
  return *number & ((std::uint32_t{1} << (8 * size)) - 1);
}

Sentence refusalText(const char* what, const SdoRequest& request, const SdoAnswer& answer) noexcept {
  Sentence text;
  const char* verb = request.write ? "written" : "read";
  if (answer.ok()) {
    text.format("%s (%04Xh:%u) cannot be %s: %u bytes came", what, unsigned{request.index}, unsigned{request.sub_index},
                verb, static_cast<unsigned>(answer.data.size()));
    return text;
  }
  const char* meaning = abortMeaning(answer.abort_code);
  text.format("%s (%04Xh:%u) cannot be %s: abort %04X %04Xh (%s)", what, unsigned{request.index},
              unsigned{request.sub_index}, verb, static_cast<unsigned>(answer.abort_code >> 16),
              static_cast<unsigned>(answer.abort_code & 0xFFFFu), meaning != nullptr ? meaning : "no standard code");
  return text;
}

}  // namespace nord_driver::canopen
