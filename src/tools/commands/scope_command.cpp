// nord_param scope: what a drive did over time, as CSV and as a picture.
#include <boost/optional.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>

#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/scope_cycles.h"
#include "tools/scope_observer.h"
#include "tools/scope_scale.h"
#include "tools/scope_svg.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

constexpr double kLongest = 3600.0;  // s

std::string contentsOf(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) throw UsageError(file + ": this file cannot be read, or is empty");
  return text.str();
}

void put(const std::string& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw Trouble(file + ": this file cannot be written");
}

class ScopeCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command =
        line.addCommand("scope", "write the process data of a drive, cycle by cycle, and draw them; moves nothing");
    addDrive(command, &drive_);
    command.options.add_options()("duration", po::value(&duration_)->value_name("SECONDS"),
                                  "s to look on (10); Ctrl-C ends it earlier")(
        "csv", po::value(&csv_)->value_name("FILE"), "where the values go; stdout when neither file is named")(
        "svg", po::value(&svg_)->value_name("FILE"), "where the picture goes")(
        "from", po::value(&from_)->value_name("FILE"),
        "a trace of the driver (.txt), or an earlier --csv, in place of the bus or the node; needs no --config")(
        "max-frequency", po::value(&max_frequency_)->value_name("HZ"),
        "P105, in Hz: what 100 % is, where it cannot be read; without it a trace is drawn in %")(
        "current", po::value(&current_)->value_name("WORD"),
        "which actual value, 1 to 3, is the current (P543 to P545 = 3)")(
        "json", po::bool_switch(&json_),
        "for programs: one JSON object a line and cycle on stdout, in place of the CSV");
    return command;
  }

  int run(ParamProgram& program) override {
    if (duration_.value > kLongest) throw UsageError("--duration is too long, expected at most 3600 s");
    if (max_frequency_ && !(*max_frequency_ > 0.0 && *max_frequency_ <= 1000.0)) {
      throw UsageError("--max-frequency is not valid, expected more than 0 to 1000 Hz");
    }
    if (!from_.empty()) return write(read());
    if (auto node = program.nodeWith({drive_})) return recordThrough(*node, program.endAsked());
    return program.onDrives({drive_}, "rosservice call /nord_driver/write_trace, and look at its file with --from",
                            [this, &program](ParameterLink&) -> LinkTask {
                              return [this, &program](ParameterLink& link) {
                                return recordOver(link, program.endAsked()) == kDone;
                              };
                            });
  }

 private:
  ScopeRecord read() const {
    const std::string text = contentsOf(from_);
    try {
      const bool is_csv = text.compare(0, 8, "# drive:") == 0;
      ScopeRecord record = is_csv ? readScopeCsv(text) : readScopeTrace(text, drive_);
      if (record.drive != drive_) throw UsageError("it is of drive \"" + record.drive + "\", not of " + drive_);
      if (max_frequency_) record.max_frequency = *max_frequency_;
      return record;
    } catch (const UsageError& error) {
      throw UsageError(from_ + ": " + error.what());
    }
  }

  std::optional<double> typedFrequency() const {
    return max_frequency_ ? std::optional<double>{*max_frequency_} : std::nullopt;
  }

  /// What came before a drive was refused is written all the same.
  int recordOver(ParameterLink& link, const std::atomic<bool>& end_asked) const {
    ScopeRecord record;
    record.drive = drive_;
    readScale(link, typedFrequency(), link.positions(0), record);
    ScopeObserver observer{static_cast<std::size_t>(std::ceil(duration_.value / toSeconds(link.period()))) + 10};
    link.setObserver(&observer);
    std::string ended;
    try {
      link.exchangeUntil(link.now() + seconds(duration_.value), end_asked);
    } catch (const Trouble& trouble) {
      ended = trouble.what();
    }
    link.setObserver(nullptr);
    record.samples = observer.samples();
    const int done = write(record);
    if (!ended.empty()) throw Trouble(ended);
    return done;
  }

  /// What came before the node ended is written all the same.
  int recordThrough(const NodeWithDrives& node, const std::atomic<bool>& end_asked) const {
    ScopeRecord record;
    record.drive = drive_;
    const DriveDescription& described = node.drives.front();
    readScale(*node.nodes.open(node.name, described), typedFrequency(), described.positions, record);
    ScopeCycles cycles{duration_.value};
    const auto feed = node.nodes.cyclesOf(node.name, drive_);
    std::string ended;
    try {
      while (!end_asked && !cycles.done()) cycles.take(feed->take());
    } catch (const Trouble& trouble) {
      ended = trouble.what();
    }
    record.samples = cycles.samples();
    write(record);
    if (!ended.empty()) throw Trouble(ended);
    if (cycles.restarted())
      throw Trouble("node " + node.name + " was started anew meanwhile: this is what came before");
    if (cycles.missing() == 0) return kDone;
    throw Trouble(std::to_string(cycles.missing()) + " of the cycles are missing, " +
                  std::to_string(record.samples.size()) + " came: this computer or the network was too slow");
  }

  int write(ScopeRecord record) const {
    if (current_.value > 0) record.current_word = current_.value;
    const std::string picture = svg_.empty() ? std::string{} : scopeSvg(record);
    if (!csv_.empty()) put(csv_, scopeCsv(record));
    if (!svg_.empty()) put(svg_, picture);
    if (json_) {
      std::fputs(scopeJson(record).c_str(), stdout);
    } else if (csv_.empty() && svg_.empty()) {
      std::fputs(scopeCsv(record).c_str(), stdout);
    }
    return kDone;
  }

  std::string drive_;
  Seconds duration_{10.0};
  std::string csv_, svg_, from_;  // files
  boost::optional<double> max_frequency_;
  WholeNumber<1, 3> current_;  // 0: not given
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeScopeCommand() {
  return std::make_unique<ScopeCommand>();
}

}  // namespace nord_driver::tools
