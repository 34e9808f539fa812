#include "tools/restore/restore_json.h"

#include "tools/parameter_json.h"

namespace nord_driver::tools {

std::string restoreJson(const RestoreRecord& record, const std::vector<RestorePlan::LeftOut>& left_out,
                        const std::vector<std::string>& notes, const std::string& state,
                        const catalogue::DriveCatalogue& known) {
  JsonText json;
  json.begin('{').key("drive").text(record.drive).key("file").text(record.file);
  json.key("persistent").boolean(record.persistent).key("state").text(state);
  if (!record.why.empty()) json.key("why").text(record.why);
  json.key("same").whole(static_cast<std::int64_t>(record.same.size()));
  const auto value = [&](const char* key, const catalogue::ParameterAddress& address, std::int32_t raw) {
    json.key(key).begin('{');
    writeValue(json, address, raw, known);
    json.end('}');
  };
  json.key("changes").begin('[');
  for (const RestoreRecord::Change& change : record.changes) {
    json.begin('{');
    writeAddress(json, change.address, known);
    value("before", change.address, change.before);
    value("after", change.address, change.after);
    json.key("state").text(toString(change.state)).end('}');
  }
  json.end(']').key("left_out").begin('[');
  for (const RestorePlan::LeftOut& left : left_out) {
    json.begin('{');
    writeAddress(json, left.address, known);
    if (left.there) value("before", left.address, *left.there);
    value("after", left.address, left.wanted);
    json.key("why").text(left.why).end('}');
  }
  json.end(']').key("notes").begin('[');
  for (const std::string& note : notes) json.text(note);
  return json.end(']').end('}').str() + "\n";
}

}  // namespace nord_driver::tools
