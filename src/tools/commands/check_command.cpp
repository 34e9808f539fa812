// nord_param check: whether the parameters of the drives fit the configuration; --fix writes what would be right.
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "config/yaml_settings.h"
#include "tools/commands/commands.h"
#include "tools/commissioning_check.h"
#include "tools/commissioning_text.h"
#include "tools/urdf_file.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

class CheckCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command =
        line.addCommand("check", "compare the parameters of the drives with what the configuration asks for");
    command.more = {"DRIVE", "its name in the file; without one all drives", &names_};
    command.options.add_options()("json", po::bool_switch(&json_), "for programs")(
        "urdf", po::value(&urdf_)->value_name("FILE"), "the robot's URDF, what robot_description is to the driver")(
        "fix", po::bool_switch(&fix_), "show what would be right, ask, and write it, in RAM")(
        "persistent", po::bool_switch(&persistent_), "with --fix: save it in the EEPROM, which endures 100 000 writes");
    return command;
  }

  int run(ParamProgram& program) override {
    if (!fix_ && persistent_) throw UsageError("--persistent belongs to --fix");
    node::NodeConfig config = node::readNodeConfig(YamlSettings{"", program.file()}, readUrdf(urdf_));
    // As the driver configures it: what protects a drive is the driver's, not this program's.
    const auto transport = program.loader().load(config.transport);
    const node::ConfiguredTransport configured = node::configureTransport(config, *transport);
    const catalogue::Catalogues catalogues =
        program.cataloguesFor(readToolConfig(program.file(), config.cycle.drives.front().name));
    drives_ = drivesToCheck(config, configured.identities, names_, catalogues);

    commissioning::Findings findings = ask(program);
    if (fix_ && !program.endAsked()) {
      std::fputs(checkText(drives_, findings).c_str(), stderr);
      if (!writeFixes(program, findings)) return kFailed;
      findings = ask(program);
    }
    std::fputs((json_ ? checkJson(drives_, findings) : checkText(drives_, findings)).c_str(), stdout);
    return findings.empty() && allAsked() ? kDone : kFailed;
  }

 private:
  bool allAsked() const {
    for (const CommissionedDrive& drive : drives_) {
      if (!drive.facts) return false;
    }
    return true;
  }

  /// One drive that does not answer keeps nobody from the others.
  commissioning::Findings ask(ParamProgram& program) {
    for (CommissionedDrive& drive : drives_) {
      drive.facts.reset();
      drive.trouble.clear();
      if (drive.asked.identity.parameter_channel == "none") {
        drive.trouble = "nothing carries parameters to it as it is configured";
        continue;
      }
      try {
        program.onDrive(drive.asked.name, [&](const catalogue::DriveCatalogue&) -> DriveTask {
          return [&](DriveParameters& parameters) {
            readFacts(drive, parameters, program.endAsked());
            return true;
          };
        });
      } catch (const Trouble& trouble) {
        drive.trouble = trouble.what();
      }
      if (program.endAsked()) break;
    }
    return findingsIn(drives_);
  }

  /// False: nobody agreed, or a drive has not taken a value.
  bool writeFixes(ParamProgram& program, const commissioning::Findings& findings) {
    std::vector<std::vector<Fix>> fixes;
    std::size_t count = 0;
    for (const CommissionedDrive& drive : drives_) {
      fixes.push_back(fixesFor(drive, findings, persistent_));
      count += fixes.back().size();
      for (const Fix& fix : fixes.back()) std::fprintf(stderr, "write %s\n", fixText(fix).c_str());
    }
    if (count == 0) {
      if (!findings.empty()) {
        std::fprintf(stderr, "there is nothing to write: what was found is for a person to decide\n");
      }
      return findings.empty() && allAsked();
    }
    if (!program.isAgreed() && !askFor(count)) return false;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      if (!fixes[i].empty() && !writeTo(program, drives_[i], fixes[i])) return false;
    }
    return true;
  }

  bool askFor(std::size_t count) const {
    if (::isatty(STDIN_FILENO) == 0) {
      std::fprintf(stderr,
                   "nord_param: there is no terminal to ask on: nothing was written; --yes writes without asking\n");
      return false;
    }
    std::fprintf(stderr, "Write %zu value%s into the %s? [y/N] ", count, count == 1 ? "" : "s",
                 persistent_ ? "EEPROM" : "RAM, lost at power off");
    std::string answer;
    std::getline(std::cin, answer);
    if (answer == "y" || answer == "yes") return true;
    std::fprintf(stderr, "nothing was written\n");
    return false;
  }

  static bool writeTo(ParamProgram& program, const CommissionedDrive& drive, const std::vector<Fix>& fixes) {
    return program.onDrive(drive.asked.name, [&](const catalogue::DriveCatalogue&) -> DriveTask {
      return [&](DriveParameters& parameters) {
        for (const Fix& fix : fixes) {
          if (program.endAsked()) throw Trouble("ended before everything was written");
          const ParameterAnswer answer = parameters.write(fix.access);
          if (answer.success && answer.raw == fix.access.request.raw) continue;
          throw Trouble(fix.finding.drive + ": " + fix.finding.parameter + " was not written: " +
                        (answer.message.empty() ? "the drive still has another value" : answer.message));
        }
        return true;
      };
    }) == kDone;
  }

  std::vector<std::string> names_;
  std::string urdf_;  // file
  bool json_ = false, fix_ = false, persistent_ = false;
  std::vector<CommissionedDrive> drives_;
};

}  // namespace

std::unique_ptr<ParamCommand> makeCheckCommand() {
  return std::make_unique<CheckCommand>();
}

}  // namespace nord_driver::tools
