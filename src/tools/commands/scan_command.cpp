// nord_param scan: who is on the bus.
#include <cstdio>

#include "config/yaml_settings.h"
#include "tools/commands/commands.h"
#include "tools/scan_text.h"
#include "transport/bus_scanner.h"

namespace nord_driver::tools {

namespace {

class ScanCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand("scan", "tell who is on the bus; the file needs no drives");
    command.options.add_options()("json", boost::program_options::bool_switch(&json_), "for programs");
    return command;
  }

  int run(ParamProgram& program) override {
    Transport& transport = program.transport();
    const auto bus = YamlSettings{"", program.file()}.group("bus");
    const auto node = program.nodeWithBus(*bus);
    const ScanReport report = node ? node->nodes.scan(node->name) : scanBus(program, transport, *bus);
    std::fputs((json_ ? scanJson(report) : scanText(report)).c_str(), stdout);
    if (report.trouble.empty()) return kDone;
    if (!json_) std::fprintf(stderr, "nord_param: %s\n", report.trouble.c_str());
    return kFailed;
  }

 private:
  static ScanReport scanBus(ParamProgram& program, Transport& transport, const Settings& bus) {
    auto* const scanner = dynamic_cast<BusScanner*>(&transport);
    if (scanner == nullptr) {
      throw Trouble("transport " + program.transportName() + " cannot tell who is on its bus");
    }
    program.refuseBusInUse(bus, "rostopic echo /nord_driver/<drive>/device_info, or bus_status");
    if (const std::string why = scanner->quiet(bus); !why.empty())
      std::fprintf(stderr, "nord_param: %s\n", why.c_str());
    return scanner->scan(bus, program.endAsked());
  }

  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeScanCommand() {
  return std::make_unique<ScanCommand>();
}

}  // namespace nord_driver::tools
