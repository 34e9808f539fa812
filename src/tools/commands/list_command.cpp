// nord_param list: the drives of the file and what is known of their parameters. Opens no bus.
#include <cstdio>

#include "tools/commands/commands.h"
#include "tools/parameter_list.h"

namespace nord_driver::tools {

namespace {

class ListCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand("list", "the drives of the file, and every known parameter");
    command.options.add_options()("parameter", boost::program_options::value(&described_)->value_name("PARAMETER"),
                                  "everything that is known of one parameter: range, names of values, source")(
        "json", boost::program_options::bool_switch(&json_), "for programs");
    return command;
  }

  int run(ParamProgram& program) override {
    Transport& transport = program.transport();
    const ToolConfig config = readToolConfig(program.file(), transport.endPoint());
    const catalogue::Catalogues catalogues = program.cataloguesFor(config);
    transport.configure(*config.bus, config.drives, config.cycle.cycle_rate);
    const std::string text = json_                ? listJson(config, transport, catalogues, described_)
                             : described_.empty() ? listText(config, transport, catalogues)
                                                  : descriptionText(config, transport, catalogues, described_);
    std::fputs(text.c_str(), stdout);
    return kDone;
  }

 private:
  std::string described_;  // empty: list them all
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeListCommand() {
  return std::make_unique<ListCommand>();
}

}  // namespace nord_driver::tools
