// nord_param write: one parameter of one drive, in RAM unless told otherwise.
#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/param_commands.h"

namespace nord_driver::tools {

namespace {

class WriteCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command = line.addCommand("write", "write one parameter, in RAM unless told otherwise");
    words_.addTo(command);
    command.arguments.push_back({"VALUE", "in the unit that list shows, or the name of a value", &write_.value});
    command.options.add_options()("persistent", po::bool_switch(&write_.persistent),
                                  "save it in the EEPROM, which endures 100 000 writes; writes even what is there")(
        "raw", po::bool_switch(&write_.raw), "VALUE is as transferred; needed where the unit is not known")(
        "json", po::bool_switch(&json_), "for programs");
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(words_.drive, [this](const catalogue::DriveCatalogue& known) -> DriveTask {
      const catalogue::ParameterAccess access = checkedWrite(write_, words_.address(known), known);
      return [this, access](DriveParameters& drive) { return writeParameter(drive, access, json_); };
    });
  }

 private:
  ParameterWords words_;
  WriteOptions write_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeWriteCommand() {
  return std::make_unique<WriteCommand>();
}

}  // namespace nord_driver::tools
