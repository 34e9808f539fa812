#include "sim/config_posicon.h"

#include <cmath>
#include <utility>

#include "sim/config_parameters.h"

namespace nord_driver::sim {

namespace {

constexpr int kHighestFunction = 255;  // of a digital input or output
constexpr int kHighestFault = 999;     // as P700 has it

double revolutions(const Group& group, const std::string& key, double otherwise) {
  return group.get<double>(key, otherwise, "revolutions from -50000 to 50000",
                           [](const double& value) { return value >= -posicon::kRange && value <= posicon::kRange; });
}

void readFunctions(const Group& posicon, PosiconSettings& settings, std::vector<std::string>& warnings) {
  if (!posicon.has("functions")) return;
  const std::string path = posicon.keyName("functions");
  const Group group(posicon["functions"], path);
  const std::vector<std::pair<std::string, std::int32_t*>> functions{
      {"reference_run", &settings.inputs.reference_run},
      {"reference_point", &settings.inputs.reference_point},
      {"teach_in", &settings.inputs.teach_in},
      {"quit_teach_in", &settings.inputs.quit_teach_in},
      {"first_array_bit", &settings.inputs.first_array_bit},
      {"reset_position", &settings.inputs.reset_position},
      {"referenced", &settings.outputs.referenced},
      {"position_reached", &settings.outputs.position_reached}};
  std::vector<std::string> known;
  for (const auto& [key, number] : functions) {
    *number = group.integer(key, *number, 0, kHighestFunction);
    known.push_back(key);
  }
  warnOfUnknown(posicon["functions"], path, known, warnings);
}

}  // namespace

void readPosicon(const Group& drive, PosiconSettings& settings, std::vector<std::string>& warnings) {
  if (!drive.has("posicon")) return;
  const std::string path = drive.keyName("posicon");
  const Group group(drive["posicon"], path);
  const std::string kind = group.get<std::string>("encoder", "absolute", "absolute or incremental");
  if (kind != "absolute" && kind != "incremental") {
    refuse(group.keyName("encoder"), group["encoder"], "absolute or incremental");
  }
  if (kind == "incremental") settings.encoder = EncoderKind::kIncremental;
  settings.position = revolutions(group, "position", settings.position);
  if (group.has("reference_switch")) settings.reference_switch = revolutions(group, "reference_switch", 0.0);
  settings.reference_speed =
      group.get<double>("reference_speed", settings.reference_speed, "Hz, negative to the left, not 0",
                        [](const double& value) { return std::isfinite(value) && value != 0.0; });
  settings.increments = group.positive("increments", settings.increments);
  settings.older_increments = group.positive("older_increments", settings.older_increments);
  settings.array_from_zero = group.get<bool>("array_from_zero", settings.array_from_zero, "true or false");
  settings.slip_fault = group.integer("slip_fault", settings.slip_fault, 1, kHighestFault);
  settings.torn_words = group.get<bool>("torn_words", settings.torn_words, "true or false");
  readFunctions(group, settings, warnings);
  static const std::vector<std::string> kKeys{"encoder",    "position",         "reference_switch", "reference_speed",
                                              "increments", "older_increments", "array_from_zero",  "slip_fault",
                                              "torn_words", "functions"};
  warnOfUnknown(drive["posicon"], path, kKeys, warnings);
}

}  // namespace nord_driver::sim
