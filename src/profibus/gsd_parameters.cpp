#include "profibus/gsd_parameters.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "profibus/slave_config.h"

namespace nord_driver::profibus {

namespace {

constexpr unsigned kMaxReference = 65'535;
constexpr unsigned kLastBit = 7;

struct Integer {
  const char* name;
  std::size_t bytes;
  bool is_signed;
};
constexpr std::array<Integer, 6> kIntegers{{{"Unsigned8", 1, false},
                                            {"Unsigned16", 2, false},
                                            {"Unsigned32", 4, false},
                                            {"Signed8", 1, true},
                                            {"Signed16", 2, true},
                                            {"Signed32", 4, true}}};

/// A data type and its default, before it is known whether one fits into the other.
struct TypedValue {
  std::string name;
  std::int64_t value = 0;
  std::int64_t least = 0;
  std::int64_t most = 0;
  GsdDefault where;
};

bool isSpace(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Reads one statement from the left; spaces before each part are passed over.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  bool word(const char* expected) {
    skipSpaces();
    std::size_t at = at_;
    for (const char* c = expected; *c != '\0'; ++c, ++at) {
      if (at >= text_.size() ||
          std::tolower(static_cast<unsigned char>(text_[at])) != std::tolower(static_cast<unsigned char>(*c))) {
        return false;
      }
    }
    if (at < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at])) != 0) return false;
    at_ = at;
    return true;
  }
  bool sign(char expected) {
    skipSpaces();
    if (at_ >= text_.size() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }
  /// Decimal or 0x, at most 32 bits, with a minus sign perhaps.
  std::optional<std::int64_t> integer() {
    const bool negative = sign('-');
    skipSpaces();
    const bool hexadecimal =
        at_ + 1 < text_.size() && text_[at_] == '0' && (text_[at_ + 1] == 'x' || text_[at_ + 1] == 'X');
    if (hexadecimal) at_ += 2;
    std::int64_t value = 0;
    bool any = false;
    for (; at_ < text_.size(); ++at_, any = true) {
      const auto c = static_cast<unsigned char>(text_[at_]);
      if (hexadecimal ? std::isxdigit(c) == 0 : std::isdigit(c) == 0) break;
      const int digit = std::isdigit(c) != 0 ? c - '0' : std::tolower(c) - 'a' + 10;
      value = value * (hexadecimal ? 16 : 10) + digit;
      if (value > kLongest) return std::nullopt;
    }
    if (!any) return std::nullopt;
    return negative ? -value : value;
  }
  /// What comes next cannot be a part of what was read before.
  bool atBoundary() const { return at_ == text_.size() || isSpace(text_[at_]); }

 private:
  static constexpr std::int64_t kLongest = 0xFFFFFFFF;

  void skipSpaces() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

std::optional<TypedValue> integerField(Scanner& scanner) {
  for (const Integer& type : kIntegers) {
    if (!scanner.word(type.name)) continue;
    const auto bits = static_cast<unsigned>(8 * type.bytes);
    TypedValue typed;
    typed.name = type.name;
    typed.most = (std::int64_t{1} << (type.is_signed ? bits - 1 : bits)) - 1;
    typed.least = type.is_signed ? -typed.most - 1 : 0;
    typed.where.bytes = type.bytes;
    typed.where.mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    return typed;
  }
  return std::nullopt;
}

/// "Bit(3)" and "BitArea(4-6)", of one byte.
std::optional<TypedValue> bitField(Scanner& scanner) {
  const bool one = scanner.word("Bit");
  if (!one && !scanner.word("BitArea")) return std::nullopt;
  if (!scanner.sign('(')) return std::nullopt;
  const auto first = scanner.integer();
  auto last = first;
  if (!one && !scanner.sign('-')) return std::nullopt;
  if (!one) last = scanner.integer();
  if (!first || !last || *first < 0 || *last < 0 || *first > kLastBit || *last > kLastBit) return std::nullopt;
  if (!scanner.sign(')')) return std::nullopt;
  const auto low = static_cast<unsigned>(std::min(*first, *last));
  const auto count = static_cast<unsigned>(std::max(*first, *last)) - low + 1;
  TypedValue typed;
  typed.name = one ? "a bit" : std::to_string(count) + " bits";
  typed.most = (std::int64_t{1} << count) - 1;
  typed.where.mask = static_cast<std::uint32_t>(typed.most) << low;
  typed.where.shift = low;
  return typed;
}

/// "Unsigned16 1000 0-2000": what follows the default is the range a person may choose from.
std::optional<TypedValue> typedValue(const std::string& text) {
  Scanner scanner{text};
  std::optional<TypedValue> typed = integerField(scanner);
  if (!typed) typed = bitField(scanner);
  if (!typed) return std::nullopt;
  const auto value = scanner.integer();
  if (!value || !scanner.atBoundary()) return std::nullopt;
  typed->value = *value;
  return typed;
}

void layOver(const GsdDefault& from, std::size_t offset, std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < offset + from.bytes) bytes.resize(offset + from.bytes, 0);
  for (std::size_t i = 0; i < from.bytes; ++i) {
    const auto down = static_cast<unsigned>(8 * (from.bytes - 1 - i));  // high byte first
    const auto mask = static_cast<std::uint8_t>(from.mask >> down);
    const auto value = static_cast<std::uint8_t>((from.value << from.shift) >> down);
    std::uint8_t& byte = bytes[offset + i];
    byte = static_cast<std::uint8_t>((byte & ~mask) | (value & mask));
  }
}

}  // namespace

void GsdParameters::begin(const GsdStatement& statement) {
  const std::string& value = statement.value;
  number_ = gsdNumber(value.substr(0, value.find_first_of("\"'")), kMaxReference);
  typed_ = false;
  if (!number_) problem(statement.line, "ExtUserPrmData without a number");
}

// The first line is the data type with the default; the others are of no interest.
void GsdParameters::takeLine(const GsdStatement& statement) {
  if (!number_ || typed_) return;
  typed_ = true;
  const auto typed = typedValue(statement.text);
  const std::string name = "ExtUserPrmData " + std::to_string(*number_);
  if (!typed) {
    return problem(statement.line, name + ": \"" + statement.text + "\" is no data type and default of a parameter");
  }
  if (typed->value < typed->least || typed->value > typed->most) {
    return problem(statement.line,
                   name + ": the default " + std::to_string(typed->value) + " does not fit into " + typed->name);
  }
  GsdDefault made = typed->where;
  made.value = static_cast<std::uint32_t>(typed->value);
  defaults_.emplace(*number_, made);
}

void GsdParameters::refer(const GsdStatement& statement, std::optional<std::size_t> module) {
  const auto offset = gsdNumber(statement.argument, kMaxUserParameters - 1);
  const auto number = gsdNumber(statement.value, kMaxReference);
  if (!offset || !number) {
    return problem(statement.line, "Ext_User_Prm_Data_Ref needs (offset) = number, in 237 bytes at most");
  }
  references_.push_back({statement.line, module, *offset, *number});
}

void GsdParameters::lay(std::optional<std::size_t> module, std::vector<std::uint8_t>& bytes) {
  for (const Reference& reference : references_) {
    if (reference.module != module) continue;
    const auto found = defaults_.find(reference.number);
    if (found == defaults_.end()) {
      problem(reference.line, "Ext_User_Prm_Data_Ref names ExtUserPrmData " + std::to_string(reference.number) +
                                  ", which gives no default: the constant bytes are kept");
    } else if (reference.offset + found->second.bytes > kMaxUserParameters) {
      problem(reference.line, "Ext_User_Prm_Data_Ref needs (offset) = number, in 237 bytes at most");
    } else {
      layOver(found->second, reference.offset, bytes);
    }
  }
}

}  // namespace nord_driver::profibus
