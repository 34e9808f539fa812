#include "canopen/sdo_request.h"

namespace nord_driver::canopen {

SdoRequest sdoRead(std::uint32_t id, std::uint16_t index, std::uint8_t sub_index) noexcept {
  SdoRequest request;
  request.id = id;
  request.index = index;
  request.sub_index = sub_index;
  return request;
}

SdoRequest sdoWrite(std::uint32_t id, std::uint16_t index, std::uint8_t sub_index, std::uint32_t value,
                    std::size_t size) noexcept {
  assert(size == 1 || size == 2 || size == 4);
  SdoRequest request = sdoRead(id, index, sub_index);
  request.write = true;
  for (std::size_t i = 0; i < size && i < sizeof value; ++i) {
    request.data.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  }
  return request;
}

std::optional<std::uint32_t> SdoAnswer::number() const noexcept {
  if (!ok() || data.empty() || data.size() > sizeof(std::uint32_t)) return std::nullopt;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < data.size(); ++i) value |= static_cast<std::uint32_t>(data[i]) << 8 * i;
  return value;
}

}  // namespace nord_driver::canopen
