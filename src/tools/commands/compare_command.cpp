// nord_param compare: the settings of a drive against a dump.
#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/param_commands.h"

namespace nord_driver::tools {

namespace {

class CompareCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand("compare", "tell how the settings of a drive differ from a dump");
    addDrive(command, &drive_);
    command.arguments.push_back({"FILE", "what dump has printed", &dump_});
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(drive_, [this, &program](const catalogue::DriveCatalogue&) -> DriveTask {
      return [&program, reference = readDump(dump_)](DriveParameters& drive) {
        return compareParameters(drive, reference, program.endAsked());
      };
    });
  }

 private:
  std::string drive_;
  std::string dump_;
};

}  // namespace

std::unique_ptr<ParamCommand> makeCompareCommand() {
  return std::make_unique<CompareCommand>();
}

}  // namespace nord_driver::tools
