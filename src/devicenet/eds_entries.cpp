#include "devicenet/eds_entries.h"

#include <limits>
#include <utility>

#include "core/text.h"

namespace nord_driver::devicenet {

namespace {

bool isSpace(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

class Splitter {
 public:
  Splitter(const std::string& text, std::vector<EdsProblem>& problems)
      : text_(text), problems_(problems), at_(textBegin(text)) {}

  std::vector<EdsEntry> split() {
    while (skipSpace()) {
      if (text_[at_] == '[') {
        section();
      } else {
        entry();
      }
    }
    return std::move(entries_);
  }

 private:
  char take() noexcept {
    const char c = text_[at_++];
    if (c == '\n') ++line_;
    return c;
  }

  /// Past white space and comments; false at the end.
  bool skipSpace() noexcept {
    while (at_ < text_.size()) {
      if (text_[at_] == '$') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (isSpace(text_[at_])) {
        take();
      } else {
        return true;
      }
    }
    return false;
  }

  void section() {
    EdsEntry made;
    made.line = line_;
    ++at_;
    while (at_ < text_.size() && text_[at_] != ']' && text_[at_] != '\n') made.section += take();
    if (at_ < text_.size() && text_[at_] == ']') {
      ++at_;
    } else {
      problems_.push_back({made.line, "\"[" + trimmed(made.section) + "\" has no closing bracket"});
    }
    made.section = lowerCase(trimmed(made.section));
    section_ = made.section;
    entries_.push_back(std::move(made));
  }

  /// From its key to its semicolon. One that has none ends before the next section.
  void entry() {
    EdsEntry made;
    made.section = section_;
    made.line = line_;
    while (at_ < text_.size() && text_[at_] != '=' && text_[at_] != '\n' && text_[at_] != ';') made.key += take();
    const std::string name = trimmed(made.key);
    made.key = lowerCase(name);
    if (at_ == text_.size() || text_[at_] != '=') {
      if (at_ < text_.size()) take();
      problems_.push_back({made.line, "\"" + name + "\" is no section, no key with a value and no comment"});
      return;
    }
    ++at_;
    const bool whole = fields(made);
    if (!whole) problems_.push_back({made.line, "\"" + name + "\" does not end with a semicolon"});
    if (section_.empty()) {
      problems_.push_back({made.line, "\"" + name + "\" stands before the first section"});
    } else {
      entries_.push_back(std::move(made));
    }
  }

  /// False when the semicolon is missing.
  bool fields(EdsEntry& made) {
    EdsField field;
    bool begun = false, in_line = true;
    const auto end = [&] {
      if (!begun) field.line = line_;
      field.text = trimmed(field.text);
      made.fields.push_back(std::exchange(field, EdsField{}));
      begun = false;
    };
    for (; skipSpace(); in_line = false) {
      const char c = text_[at_];
      // A section begins a line; nothing else does with a bracket.
      if (c == '[' && !in_line && beginsLine()) break;
      if (!begun && c != ',' && c != ';') field.line = line_;
      begun = begun || (c != ',' && c != ';');
      if (c == '"') {
        quoted(field);
      } else if (c == ',' || c == ';') {
        ++at_;
        end();
        if (c == ';') return true;
      } else {
        while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ';' && text_[at_] != '"' && text_[at_] != '$' &&
               text_[at_] != '\n') {
          field.text += take();
        }
      }
    }
    end();
    return false;
  }

  bool beginsLine() const noexcept {
    for (std::size_t i = at_; i > 0; --i) {
      if (text_[i - 1] == '\n') return true;
      if (!isSpace(text_[i - 1])) return false;
    }
    return true;
  }

  /// Texts side by side are one text.
  void quoted(EdsField& field) {
    const std::size_t begun = line_;
    ++at_;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') {
      if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      field.text += take();
    }
    if (at_ < text_.size() && text_[at_] == '"') {
      ++at_;
    } else {
      problems_.push_back({begun, "a text has no closing quotation mark"});
    }
  }

  const std::string& text_;
  std::vector<EdsProblem>& problems_;
  std::size_t at_;
  std::size_t line_ = 1;
  std::string section_;
  std::vector<EdsEntry> entries_;
};

}  // namespace

std::vector<EdsEntry> splitEds(const std::string& text, std::vector<EdsProblem>& problems) {
  return Splitter{text, problems}.split();
}

std::optional<std::uint32_t> edsNumber(const std::string& text) {
  const bool hexadecimal = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  const unsigned base = hexadecimal ? 16 : 10;
  if (text.empty()) return std::nullopt;
  std::uint64_t value = 0;
  for (std::size_t i = hexadecimal ? 2 : 0; i < text.size(); ++i) {
    const char c = text[i];
    const unsigned digit = c >= '0' && c <= '9'   ? static_cast<unsigned>(c - '0')
                           : c >= 'a' && c <= 'f' ? static_cast<unsigned>(c - 'a') + 10u
                           : c >= 'A' && c <= 'F' ? static_cast<unsigned>(c - 'A') + 10u
                                                  : 99u;
    if (digit >= base) return std::nullopt;
    value = value * base + digit;
    if (value > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  }
  return static_cast<std::uint32_t>(value);
}

}  // namespace nord_driver::devicenet
