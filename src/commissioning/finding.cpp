#include "commissioning/finding.h"

namespace nord_driver::commissioning {

const char* toString(Severity severity) noexcept {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kNote:
      return "note";
  }
  return "";
}

std::string toText(const Finding& finding) {
  std::string text = finding.parameter;
  if (!finding.value.empty()) text += " = " + finding.value;
  text += ": " + finding.why;
  if (finding.remedy) {
    text += "; set it to " + finding.remedy->text;
  } else if (!finding.advice.empty()) {
    text += "; " + finding.advice;
  }
  if (!finding.source.empty()) text += " (" + finding.source + ")";
  return text;
}

}  // namespace nord_driver::commissioning
