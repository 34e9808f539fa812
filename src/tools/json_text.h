// A JSON text, written in the order it is told.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nord_driver::tools {

/// `JsonText json; json.begin('{'); json.key("name").text("left"); json.end('}');`
class JsonText {
 public:
  /// '{' or '['.
  JsonText& begin(char bracket);
  /// '}' or ']'.
  JsonText& end(char bracket);
  JsonText& key(const std::string& name);
  JsonText& text(const std::string& value);
  /// What is no number or infinite is null.
  JsonText& number(double value);
  /// With every digit.
  JsonText& whole(std::int64_t value);
  JsonText& boolean(bool value);

  const std::string& str() const noexcept { return text_; }

 private:
  void separate();

  std::string text_;
  bool first_ = true;  // in its object or list
  bool after_key_ = false;
};

}  // namespace nord_driver::tools
