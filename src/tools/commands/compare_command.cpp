// nord_param compare, and its other name diff: what differs between two drives, two dumps, or one of each.
#include <cstdio>
#include <filesystem>
#include <optional>

#include "config/driver_settings.h"
#include "tools/commands/commands.h"
#include "tools/comparison.h"
#include "tools/parameter_json.h"
#include "tools/parameter_name.h"
#include "tools/watched_parameters.h"

namespace nord_driver::tools {

namespace {

class CompareCommand final : public ParamCommand {
 public:
  CompareCommand(std::string name, std::string about) : name_(std::move(name)), about_(std::move(about)) {}

  Command& addTo(CommandLine& line) override {
    Command& command = line.addCommand(name_, about_);
    command.arguments.push_back({"DRIVE", "a drive of the configuration, or a FILE, too", &first_.word});
    command.arguments.push_back({"FILE", "what dump has printed, or a DRIVE, too", &second_.word});
    command.options.add_options()("json", boost::program_options::bool_switch(&json_), "for programs");
    return command;
  }

  int run(ParamProgram& program) override {
    const std::vector<std::string> drives = program.driveNames();
    for (Side* side : {&first_, &second_}) look(*side, drives);
    if (first_.is_drive && second_.is_drive) return compareDrives(program);
    if (first_.is_drive || second_.is_drive) return compareWithFile(program);
    return compareFiles(program);
  }

 private:
  struct Side {
    std::string word;
    bool is_drive = false;
    Dump dump;
  };

  static void look(Side& side, const std::vector<std::string>& drives) {
    std::string names;
    for (const std::string& drive : drives) {
      if (drive == side.word) side.is_drive = true;
      names += (names.empty() ? "" : ", ") + drive;
    }
    std::error_code unreadable;
    const bool is_file = std::filesystem::exists(side.word, unreadable);
    if (side.is_drive && is_file) {
      std::fprintf(stderr, "nord_param: %s is taken for the drive of that name; the file is ./%s\n", side.word.c_str(),
                   side.word.c_str());
    }
    if (side.is_drive) return;
    const bool looks_like_a_file = side.word.find_first_of("/.") != std::string::npos;
    if (!is_file && !looks_like_a_file && !names.empty()) {
      throw UsageError("\"" + side.word + "\" is neither a drive of the configuration nor a file, expected " + names +
                       " or what dump has printed");
    }
    side.dump = readDump(side.word);
  }

  int compareFiles(ParamProgram& program) {
    refuseOtherSeries(first_.word, first_.dump.series, second_.word, second_.dump.series);
    const catalogue::Catalogues catalogues = program.catalogues();
    const catalogue::DriveCatalogue known = knownOf(catalogues, first_.dump.series, program.transportName());
    return tell(differencesOf(first_.dump, second_.dump, known), known, first_.word, second_.word) ? kDone : kFailed;
  }

  int compareWithFile(ParamProgram& program) {
    const Side& drive = first_.is_drive ? first_ : second_;
    const Side& file = first_.is_drive ? second_ : first_;
    return program.onDrive(drive.word, [&](const catalogue::DriveCatalogue& known) -> DriveTask {
      refuseOtherSeries("the dump", file.dump.series, "drive " + drive.word, known.series());
      return [&](DriveParameters& parameters) {
        WatchedParameters watched{parameters, program.progress()};
        watched.expect("comparing", file.dump.values.size());
        const Dump alike = readAlike(watched, file.dump, program.endAsked());
        watched.end();
        return tell(differencesOf(file.dump, alike, watched.known()), watched.known(), "the file", "the drive");
      };
    });
  }

  int compareDrives(ParamProgram& program) {
    if (first_.word == second_.word) throw UsageError("drive " + first_.word + " is the same as itself");
    const auto dump = [&program](DriveParameters& parameters) {
      WatchedParameters watched{parameters, program.progress()};
      watched.expect("reading", knownParameters(watched.known()).size());
      return takeDump(watched, program.endAsked());
    };
    const int first = program.onDrive(first_.word, [&](const catalogue::DriveCatalogue&) -> DriveTask {
      return [&](DriveParameters& drive) {
        first_.dump = dump(drive);
        return true;
      };
    });
    if (first != kDone) return first;
    return program.onDrive(second_.word, [&](const catalogue::DriveCatalogue& known) -> DriveTask {
      refuseOtherSeries("drive " + first_.word, first_.dump.series, "drive " + second_.word, known.series());
      return [&](DriveParameters& drive) {
        const Dump second = dump(drive);
        return tell(differencesOf(first_.dump, second, drive.known()), drive.known(), first_.word, second_.word);
      };
    });
  }

  bool tell(const Differences& differences, const catalogue::DriveCatalogue& known, const std::string& first,
            const std::string& second) const {
    if (json_) {
      std::fputs(differencesJson(differences, known, first, second).c_str(), stdout);
    } else {
      for (const Difference& difference : differences.found) {
        std::printf("%s\n", differenceText(difference, known, first, second).c_str());
      }
      std::printf("%zu of %zu settings differ\n", differences.found.size(), differences.compared);
    }
    return differences.compared > 0 && differences.found.empty();  // nothing compared shows nothing
  }

  std::string name_;
  std::string about_;
  Side first_, second_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeCompareCommand() {
  return std::make_unique<CompareCommand>("compare",
                                          "tell how the settings of two drives, two dumps, or one of each differ");
}

std::unique_ptr<ParamCommand> makeDiffCommand() {
  return std::make_unique<CompareCommand>("diff", "another name for compare");
}

}  // namespace nord_driver::tools
