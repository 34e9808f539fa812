#include "tools/commands/parameter_words.h"

#include "tools/param_commands.h"

namespace nord_driver::tools {

void addDrive(Command& command, std::string* drive) {
  command.arguments.push_back({"DRIVE", "its name in the file", drive});
}

void ParameterWords::addTo(Command& command) {
  namespace po = boost::program_options;
  addDrive(command, &drive);
  command.arguments.push_back(
      {"PARAMETER", "its number or name: 105, P105, P700[-01], \"Maximum frequency\"", &parameter});
  command.options.add_options()("set", po::value(&set)->value_name("SET"),
                                "parameter set 1 to 4; without it the set in force")(
      "index", po::value(&index)->value_name("INDEX"), "array element, [-01] = 1");
}

catalogue::ParameterAddress ParameterWords::address(const catalogue::DriveCatalogue& known) const {
  return addressOf(parameter, set.value, index.value, known);
}

}  // namespace nord_driver::tools
