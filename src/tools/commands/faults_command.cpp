// nord_param faults: what a drive tells of its faults, in words.
#include <cstdio>

#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/fault_report.h"

namespace nord_driver::tools {

namespace {

class FaultsCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand("faults", "tell what stands in the way of a drive, and its last five faults");
    addDrive(command, &drive_);
    command.options.add_options()("json", boost::program_options::bool_switch(&json_), "for programs");
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(drive_, [this, &program](const catalogue::DriveCatalogue&) -> DriveTask {
      return [this, &program](DriveParameters& drive) {
        const FaultReport report = readFaults(drive, program.endAsked());
        std::fputs((json_ ? faultJson(report, drive) : faultText(report, drive)).c_str(), stdout);
        return true;
      };
    });
  }

 private:
  std::string drive_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeFaultsCommand() {
  return std::make_unique<FaultsCommand>();
}

}  // namespace nord_driver::tools
