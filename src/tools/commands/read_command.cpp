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
    command.options.add_options()("json", boost::program_options::bool_switch(&json_), "for programs");
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(words_.drive, [this](const catalogue::DriveCatalogue& known) -> DriveTask {
      const catalogue::ParameterAddress address = words_.address(known);
      return [this, address](DriveParameters& drive) { return readParameter(drive, address, json_); };
    });
  }

 private:
  ParameterWords words_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeReadCommand() {
  return std::make_unique<ReadCommand>();
}

}  // namespace nord_driver::tools
