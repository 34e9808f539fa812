#include "canopen_nodes.h"

namespace nord_driver::bench {

namespace {

std::uint32_t valueOf(unsigned index, unsigned sub_index, unsigned node) {
  if (index == 0x1400 && sub_index == 1) return 0x40000200u + node;
  if (index == 0x1800 && sub_index == 1) return 0x40000180u + node;
  if (index == 0x1400 || index == 0x1800) return 1;  // transmission type: with every SYNC
  return 103;
}

void answerSdo(const can_frame& request, can_frame& response) {
  response = request;
  response.can_id = request.can_id - 0x80;
  std::fill(response.data + 4, response.data + 8, std::uint8_t{0});
  if ((request.data[0] & 0xE0u) != 0x40) {
    response.data[0] = 0x60;
    return;
  }
  const unsigned index = request.data[1] | static_cast<unsigned>(request.data[2]) << 8;
  const std::uint32_t value = valueOf(index, request.data[3], request.can_id & 0x7Fu);
  response.data[0] = index < 0x2000 ? 0x43 : 0x4B;
  for (unsigned i = 0; i < 4; ++i) response.data[4 + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

}  // namespace

CanopenNodes::CanopenNodes(std::size_t nodes) {
  for (std::size_t node = 1; node <= nodes; ++node) {
    can_frame frame{};
    frame.can_id = static_cast<canid_t>(0x180 + node);
    frame.can_dlc = 4;
    frame.data[0] = 0x31;  // BU 0060 p. 96
    frame.data[1] = 0x0B;
    transmit_pdos_.push_back(frame);
  }
}

bool CanopenNodes::operator()(const can_frame& frame, const CanSay& say) const {
  if (frame.can_id == 0x080) {
    for (const can_frame& pdo : transmit_pdos_) {
      if (!say(pdo)) return false;
    }
  } else if (frame.can_id > 0x600 && frame.can_id <= 0x67F) {
    can_frame response{};
    answerSdo(frame, response);
    return say(response);
  }
  return true;
}

}  // namespace nord_driver::bench
