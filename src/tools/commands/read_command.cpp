// nord_param read: one parameter of one drive.
#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/param_commands.h"

namespace nord_driver::tools {

namespace {

class ReadCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand("read", "read one parameter");
    words_.addTo(command);
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(words_.drive, [this](const catalogue::DriveCatalogue& known) -> DriveTask {
      const catalogue::ParameterAddress address = words_.address(known);
      return [address](DriveParameters& drive) { return readParameter(drive, address); };
    });
  }

 private:
  ParameterWords words_;
};

}  // namespace

std::unique_ptr<ParamCommand> makeReadCommand() {
  return std::make_unique<ReadCommand>();
}

}  // namespace nord_driver::tools
