// The parameters a GSD file offers to an engineering tool (ExtUserPrmData): their defaults, laid into user parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "profibus/gsd_file.h"
#include "profibus/gsd_lines.h"

namespace nord_driver::profibus {

/// Where a default goes: bytes, high byte first, or some bits of one byte.
struct GsdDefault {
  std::uint32_t value = 0;
  std::size_t bytes = 1;
  std::uint32_t mask = 0xFF;  ///< the bits that are its own
  unsigned shift = 0;         ///< of the value, towards them
};

/// Reads the blocks ExtUserPrmData and remembers the references to them: a definition counts wherever it stands.
class GsdParameters {
 public:
  explicit GsdParameters(std::vector<GsdProblem>& problems) noexcept : problems_(problems) {}

  /// "ExtUserPrmData = 7 ..." begins a block; takeLine() is every statement in it.
  void begin(const GsdStatement& statement);
  void takeLine(const GsdStatement& statement);

  /// "Ext_User_Prm_Data_Ref(offset) = number", of module `module`, or of the station without one.
  void refer(const GsdStatement& statement, std::optional<std::size_t> module);
  /// Once everything is read: the defaults of the references of `module` (or of the station) over `bytes`.
  void lay(std::optional<std::size_t> module, std::vector<std::uint8_t>& bytes);

 private:
  struct Reference {
    std::size_t line = 0;
    std::optional<std::size_t> module;
    std::size_t offset = 0;
    unsigned number = 0;
  };

  void problem(std::size_t line, const std::string& text) { problems_.push_back({line, text}); }

  std::vector<GsdProblem>& problems_;
  std::map<unsigned, GsdDefault> defaults_;
  std::vector<Reference> references_;
  std::optional<unsigned> number_;  // of the block being read
  bool typed_ = false;              // its data type was there
};

}  // namespace nord_driver::profibus
