// nord_param check-config: reads a configuration as the driver would, and opens nothing.
#include <langinfo.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>

#include "tools/commands/commands.h"
#include "tools/config_check.h"
#include "tools/config_picture.h"
#include "tools/urdf_file.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

// Box-drawing characters where somebody looks who can see them.
bool drawsLines() {
  std::setlocale(LC_CTYPE, "");
  return ::isatty(STDOUT_FILENO) != 0 && std::string(::nl_langinfo(CODESET)) == "UTF-8";
}

class CheckConfigCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command =
        line.addCommand("check-config", "read a configuration without hardware, and show what was understood");
    command.arguments.push_back(
        {"FILE", "the driver's YAML file; --config lays others over it, or names it", &file_, true});
    command.options.add_options()("json", po::bool_switch(&json_), "for programs")(
        "urdf", po::value(&urdf_)->value_name("FILE"), "the robot's URDF, what robot_description is to the driver");
    return command;
  }

  int run(ParamProgram& program) override {
    std::vector<std::string> files;
    if (!file_.empty()) files.push_back(file_);
    files.insert(files.end(), program.files().begin(), program.files().end());
    if (files.empty()) throw UsageError("FILE is missing, expected the driver's YAML file, or --config with it");
    const auto load = [&program](const std::string& name) {
      const auto transport = program.loader().load(name);
      return std::shared_ptr<Transport>(transport.get(), [transport](Transport*) {});
    };
    const CheckedConfig config = checkConfig(files, readUrdf(urdf_), program.port(), load);
    std::fputs((json_ ? configJson(config) : configPicture(config, drawsLines())).c_str(), stdout);
    return config.accepted() ? kDone : kFailed;
  }

 private:
  std::string file_;
  std::string urdf_;  // file
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeCheckConfigCommand() {
  return std::make_unique<CheckConfigCommand>();
}

}  // namespace nord_driver::tools
