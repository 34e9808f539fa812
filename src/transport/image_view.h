// A transport whose bus has one image of all drives' words may show it, for those who look for the drives in it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nord_driver/core/bytes.h"

namespace nord_driver {

struct ImageWord {
  std::size_t word = 0;      ///< counted from the image's start
  unsigned register_at = 0;  ///< of the gateway
  Word value = 0;            ///< as it lies there
  std::string drive{};       ///< whose it is as configured; empty: nobody's
  std::string meaning{};     ///< "status word", "actual value 1"
  std::string text{};        ///< what a status word says
};

/// Beside Transport, and only together with Transport::serveParametersOnly(): a transport that shows its image writes
/// none.
class ImageView {
 public:
  virtual ~ImageView() = default;

  /// Before configure(): the image is read from its first word on, and so many words of it at least; 0: up to the last
  /// one that belongs to a drive. Throws ConfigError when the image cannot be so long.
  virtual void showWords(std::size_t count) = 0;
  /// "192.168.0.10:502, function 4, registers 0 to 7".
  virtual std::string imageText() const = 0;
  /// The newest inputs; empty before any have come.
  virtual std::vector<ImageWord> image() const = 0;
};

}  // namespace nord_driver
