// nord_param dump: every known parameter of one drive, as YAML.
#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/param_commands.h"

namespace nord_driver::tools {

namespace {

class DumpCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand("dump", "print every known parameter as YAML");
    addDrive(command, &drive_);
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(drive_, [&program](const catalogue::DriveCatalogue&) -> DriveTask {
      return [&program](DriveParameters& drive) { return dumpParameters(drive, program.endAsked()); };
    });
  }

 private:
  std::string drive_;
};

}  // namespace

std::unique_ptr<ParamCommand> makeDumpCommand() {
  return std::make_unique<DumpCommand>();
}

}  // namespace nord_driver::tools
