// nord_param watch: some drives, live.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "tools/commands/commands.h"
#include "tools/drive_watch.h"
#include "tools/node_watch.h"

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

/// The bus goes on while nothing is drawn.
struct LinkPace {
  ParameterLink& link;
  const std::atomic<bool>& end_asked;
  Instant now() const { return link.now(); }
  void waitUntil(Instant moment) { link.exchangeUntil(moment, end_asked); }
};

/// The node has the bus.
struct NodePace {
  const std::atomic<bool>& end_asked;
  Instant now() const { return std::chrono::steady_clock::now(); }
  void waitUntil(Instant moment) const {
    while (!end_asked && now() < moment) std::this_thread::sleep_for(std::chrono::milliseconds{20});
  }
};

class WatchCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command =
        line.addCommand("watch", "show drives twice a second until Ctrl-C, at rest over the bus; moves nothing");
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
    if (auto node = program.nodeWith(drives)) {
      NodeWatch watch{node->nodes, node->name, node->drives, parameters_};
      show([&watch] { return watch.look(); }, watch.labels(), NodePace{program.endAsked()}, program.endAsked());
      return kDone;
    }
    return program.onDrives(
        drives, "rostopic echo /nord_driver/" + first_ + "/status", [this, &program](ParameterLink& link) -> LinkTask {
          return [this, &program, watch = DriveWatch{link, parameters_}](ParameterLink& connected) mutable {
            show([&watch] { return watch.look(); }, watch.labels(), LinkPace{connected, program.endAsked()},
                 program.endAsked());
            return true;
          };
        });
  }

 private:
  /// Until Ctrl-C; a `look` that cannot be done any more ends it with its reason.
  template <typename Look, typename Pace>
  void show(Look look, const std::vector<std::string>& labels, Pace pace, const std::atomic<bool>& end_asked) {
    const bool terminal = ::isatty(STDOUT_FILENO) != 0 && !json_;
    const Instant start = pace.now();
    Screen screen;
    for (Instant next = start; !end_asked; pace.waitUntil(next)) {
      next = std::max(next + kRedraw, pace.now());
      const std::vector<WatchedDrive> drives = look();
      if (!json_ && once_) {
        std::fputs(watchTable(drives, labels).c_str(), stdout);
      } else if (terminal) {
        screen.draw(watchTable(drives, labels));
      } else {
        print(toSeconds(pace.now() - start), drives, labels);
      }
      if (once_ || std::ferror(stdout) != 0) return;
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
