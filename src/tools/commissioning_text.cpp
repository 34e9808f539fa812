#include "tools/commissioning_text.h"

#include "tools/json_text.h"

namespace nord_driver::tools {

using commissioning::Finding;

namespace {

std::string counted(std::size_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

commissioning::Findings of(const CommissionedDrive& drive, const commissioning::Findings& findings) {
  commissioning::Findings own;
  for (const Finding& finding : findings) {
    if (finding.drive == drive.asked.name) own.push_back(finding);
  }
  return own;
}

void write(JsonText& json, const Finding& finding) {
  json.begin('{').key("rule").text(finding.rule).key("severity").text(toString(finding.severity));
  json.key("number").number(finding.key.number).key("parameter_set").number(finding.key.set);
  json.key("index").number(finding.key.index).key("parameter").text(finding.parameter);
  if (finding.raw) json.key("raw").number(*finding.raw);
  json.key("value").text(finding.value).key("why").text(finding.why);
  if (finding.remedy) {
    json.key("remedy_raw").number(finding.remedy->raw).key("remedy").text(finding.remedy->text);
  }
  json.key("advice").text(finding.advice).key("source").text(finding.source).end('}');
}

}  // namespace

std::string checkText(const std::vector<CommissionedDrive>& drives, const commissioning::Findings& findings) {
  std::string text;
  std::size_t asked = 0;
  for (const CommissionedDrive& drive : drives) {
    text += "drive " + drive.asked.name + " (" + drive.asked.identity.address + "), " +
            profile::toString(drive.asked.series) + ": ";
    if (!drive.facts) {
      text += "could not be asked: " + drive.trouble + "\n";
      continue;
    }
    ++asked;
    const commissioning::Findings own = of(drive, findings);
    text += own.empty() ? "nothing found\n" : counted(own.size(), "finding") + "\n";
    for (const Finding& finding : own) {
      std::string severity = toString(finding.severity);
      severity.resize(9, ' ');
      text += "  " + severity + toText(finding) + "\n";
    }
  }
  return text + counted(findings.size(), "finding") + " in " + counted(asked, "drive") + "\n";
}

std::string checkJson(const std::vector<CommissionedDrive>& drives, const commissioning::Findings& findings) {
  JsonText json;
  json.begin('{').key("drives").begin('[');
  for (const CommissionedDrive& drive : drives) {
    json.begin('{').key("name").text(drive.asked.name).key("address").text(drive.asked.identity.address);
    json.key("series").text(profile::toString(drive.asked.series));
    if (drive.facts) json.key("parameter_set").number(drive.set_in_force);
    json.key("trouble").text(drive.trouble).key("findings").begin('[');
    for (const Finding& finding : of(drive, findings)) write(json, finding);
    json.end(']').end('}');
  }
  json.end(']').key("findings").number(static_cast<double>(findings.size())).end('}');
  return json.str() + "\n";
}

std::string fixText(const Fix& fix) {
  const Finding& finding = fix.finding;
  std::string text = finding.drive + ": " + finding.parameter + ": " + finding.value + " -> " + finding.remedy->text;
  if (finding.selects_bus) text += "; from then on the bus commands this drive, and its terminals do not";
  return text;
}

}  // namespace nord_driver::tools
