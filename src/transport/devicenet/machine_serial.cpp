#include "transport/devicenet/machine_serial.h"

#include <unistd.h>

#include <array>
#include <fstream>

namespace nord_driver {

// FNV-1a, 32 bits: the machine's own id is not for others to see.
std::uint32_t serialNumberOf(const std::string& identity) noexcept {
  std::uint32_t hash = 2166136261u;
  for (const char c : identity) {
    hash ^= static_cast<std::uint8_t>(c);
    hash *= 16777619u;
  }
  return hash == 0 ? 1 : hash;
}

std::uint32_t machineSerialNumber() {
  std::string identity;
  std::getline(std::ifstream{"/etc/machine-id"}, identity);
  if (identity.empty()) {
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) == 0) identity = name.data();
  }
  return serialNumberOf(identity);
}

}  // namespace nord_driver
