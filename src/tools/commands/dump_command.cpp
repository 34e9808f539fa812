// nord_param dump: every known parameter of one drive, or what deviates from the factory.
#include <cstdio>

#include "tools/changed_dump.h"
#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/parameter_json.h"
#include "tools/parameter_name.h"
#include "tools/watched_parameters.h"

namespace nord_driver::tools {

namespace {

class DumpCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command = line.addCommand("dump", "print every known parameter as YAML");
    addDrive(command, &drive_);
    command.options.add_options()("changed", po::bool_switch(&changed_),
                                  "only settings that deviate from the factory setting, as far as it is known")(
        "json", po::bool_switch(&json_), "JSON in place of YAML: for programs; compare and restore read YAML");
    return command;
  }

  int run(ParamProgram& program) override {
    return program.onDrive(drive_, [&](const catalogue::DriveCatalogue& known) -> DriveTask {
      return [this, &program, count = knownParameters(known).size()](DriveParameters& drive) {
        WatchedParameters watched{drive, program.progress()};
        watched.expect("reading", count);
        const Dump dump = takeDump(watched, program.endAsked());
        watched.end();
        changed_ ? printChanged(drive, dump) : print(drive, dump);
        return true;
      };
    });
  }

 private:
  void print(const DriveParameters& drive, const Dump& dump) const {
    const std::string text = json_ ? dumpJson(dump, drive, "missing", dump.missing)
                                   : dumpText(dump, drive.known(), drive.name(), drive.identity().address);
    std::fputs(text.c_str(), stdout);
  }

  void printChanged(const DriveParameters& drive, const Dump& dump) const {
    const ChangedDump changed = changedOnly(dump, drive.known());
    const std::string text = json_ ? dumpJson(changed.dump, drive, "factory_setting_not_known", changed.unknown)
                                   : changedText(changed, drive.known(), drive.name(), drive.identity().address);
    std::fputs(text.c_str(), stdout);
    if (changed.unknown.empty()) return;
    std::fprintf(stderr,
                 "nord_param: %zu settings are left out, because the catalogue does not know their factory setting; a "
                 "dump without --changed has them\n",
                 changed.unknown.size());
  }

  std::string drive_;
  bool changed_ = false;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeDumpCommand() {
  return std::make_unique<DumpCommand>();
}

}  // namespace nord_driver::tools
