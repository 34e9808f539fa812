// nord_param watch: some drives, live.
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/commands/commands.h"
#include "tools/drive_watch.h"

namespace nord_driver::tools {

namespace {

constexpr Duration kRedraw = std::chrono::milliseconds{500};

// Where somebody looks, the table stays in its place.
class Screen {
 public:
  void draw(const std::string& table) {
    std::fputs("\x1b[?7l", stdout);  // a line too long is cut off, so that the lines can be counted
    if (lines_ > 0) std::printf("\x1b[%zuA", lines_);
    std::size_t start = 0;
    lines_ = 0;
    for (std::size_t end; (end = table.find('\n', start)) != std::string::npos; start = end + 1, ++lines_) {
      std::printf("%s\x1b[K\n", table.substr(start, end - start).c_str());
    }
    std::fputs("\x1b[?7h", stdout);
    std::fflush(stdout);
  }

 private:
  std::size_t lines_ = 0;
};

class WatchCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command = line.addCommand("watch", "show drives at rest twice a second until Ctrl-C; moves nothing");
    command.arguments.push_back({"DRIVE", "its name in the file", &first_});
    command.more = {"DRIVE", "further ones", &further_};
    command.options.add_options()("parameter", po::value(&parameters_)->value_name("PARAMETER"),
                                  "a parameter to read each time; may be given several times")(
        "once", po::bool_switch(&once_), "show them once, and end")("json", po::bool_switch(&json_),
                                                                    "one JSON object a line and drive");
    return command;
  }

  int run(ParamProgram& program) override {
    std::vector<std::string> drives{first_};
    drives.insert(drives.end(), further_.begin(), further_.end());
    return program.onDrives(drives, [this, &program](ParameterLink& link) -> LinkTask {
      return [this, &program, watch = DriveWatch{link, parameters_}](ParameterLink& connected) mutable {
        show(connected, watch, program.endAsked());
        return true;
      };
    });
  }

 private:
  void show(ParameterLink& link, DriveWatch& watch, const std::atomic<bool>& end_asked) {
    const bool terminal = ::isatty(STDOUT_FILENO) != 0 && !json_;
    const Instant start = link.now();
    Screen screen;
    for (Instant next = start; !end_asked; link.exchangeUntil(next, end_asked)) {
      next = std::max(next + kRedraw, link.now());
      const std::vector<WatchedDrive> drives = watch.look();
      if (!json_ && once_) {
        std::fputs(watchTable(drives, watch.labels()).c_str(), stdout);
      } else if (terminal) {
        screen.draw(watchTable(drives, watch.labels()));
      } else {
        print(toSeconds(link.now() - start), drives, watch.labels());
      }
      if (once_) return;
    }
  }

  void print(double time, const std::vector<WatchedDrive>& drives, const std::vector<std::string>& labels) const {
    for (const WatchedDrive& drive : drives) {
      std::fputs((json_ ? watchJson(time, drive, labels) : watchLine(time, drive, labels)).c_str(), stdout);
    }
    std::fflush(stdout);
  }

  std::string first_;  // drive
  std::vector<std::string> further_;
  std::vector<std::string> parameters_;
  bool once_ = false;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeWatchCommand() {
  return std::make_unique<WatchCommand>();
}

}  // namespace nord_driver::tools
