// nord_param restore: a dump back into a drive.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "tools/commands/commands.h"
#include "tools/commands/parameter_words.h"
#include "tools/parameter_name.h"
#include "tools/restore/restore_journal.h"
#include "tools/restore/restore_json.h"
#include "tools/restore/restore_run.h"
#include "tools/restore/restore_turn.h"
#include "tools/terminal_question.h"
#include "tools/watched_parameters.h"

namespace nord_driver::tools {

namespace {

constexpr Duration kThinking = std::chrono::milliseconds{50};

class RestoreCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command =
        line.addCommand("restore", "write a dump back: shows what would be written, asks, writes, verifies");
    addDrive(command, &drive_);
    command.arguments.push_back({"FILE", "what dump has printed; not with --resume and --take-back", &file_, true});
    command.options.add_options()("dry-run", po::bool_switch(&dry_run_), "show what would be written, and end")(
        "persistent", po::bool_switch(&options_.persistent),
        "save it in the EEPROM, which endures 100 000 writes of each value")(
        "save-same", po::bool_switch(&options_.save_same),
        "with --persistent: save what has its value already, too, because it may be in the RAM only")(
        "with-bus-settings", po::bool_switch(&all_),
        "write address, baud rate and the like, too, at the very end: the drive may not answer any more")(
        "without-bus-settings", po::bool_switch(&none_),
        "leave out what the bus goes by: P105, P120, P507 to P515, P543 to P548, P551 and those of the module")(
        "resume", po::bool_switch(&resume_), "go on with a restore that was broken off")(
        "take-back", po::bool_switch(&take_back_), "put back what the last restore has changed")(
        "journal", po::value(&journal_)->value_name("FILE"),
        "where it is noted what was there and what is written; without it restore/DRIVE.journal in the folder "
        "nord_driver of ROS_HOME, or of ~/.ros")("json", po::bool_switch(&json_),
                                                 "for programs; the plan and the question go to stderr");
    return command;
  }

  int run(ParamProgram& program) override {
    yes_ = program.isAgreed();
    checkWords();
    const RestoreJournal journal{journal_.empty() ? journalPath(std::getenv("ROS_HOME"), std::getenv("HOME"), drive_)
                                                  : journal_};
    // Whoever only looks makes no folder and keeps nobody out.
    std::optional<RestoreTurn> turn;
    if (!dry_run_ && (!goesOn() || journal.read())) turn.emplace(journal.path(), drive_);
    const std::optional<RestoreRecord> earlier = journal.read();
    checkJournal(journal, earlier);
    std::optional<Dump> dump;
    if (!goesOn()) dump = settingsIn(file_);
    return program.onDrive(drive_, [&](const catalogue::DriveCatalogue& known) -> DriveTask {
      if (goesOn() && known.series() != earlier->series) {
        throw UsageError("the journal " + journal.path() + " is of a " + profile::toString(earlier->series) +
                         ", drive " + drive_ + " is a " + profile::toString(known.series()));
      }
      return [&](DriveParameters& drive) {
        WatchedParameters watched{drive, program.progress()};
        if (dump) return restore(watched, *dump, journal, program.endAsked());
        return goOn(watched, *earlier, journal, program.endAsked());
      };
    });
  }

 private:
  bool goesOn() const { return resume_ || take_back_; }

  /// Of none at all it could not be told whether they were restored; a dump of an older version may be cut off there.
  static Dump settingsIn(const std::string& file) {
    Dump dump = readDump(file);
    const auto is_setting = [](const Dump::Value& value) { return isSetting(value.address); };
    if (std::any_of(dump.values.begin(), dump.values.end(), is_setting)) return dump;
    throw UsageError(file + " has no settings, expected at least one to restore");
  }

  void checkWords() {
    if (resume_ && take_back_) throw UsageError("--resume and --take-back contradict each other");
    if (all_ && none_) throw UsageError("--with-bus-settings and --without-bus-settings contradict each other");
    if (file_.empty() && !goesOn()) {
      throw UsageError("FILE is missing, expected what dump has printed, or --resume or --take-back");
    }
    const char* needless = !file_.empty()                        ? "FILE"
                           : dry_run_                            ? "--dry-run"
                           : options_.persistent                 ? "--persistent"
                           : options_.save_same || all_ || none_ ? "what to write"
                                                                 : nullptr;
    if (goesOn() && needless != nullptr) {
      throw UsageError(std::string(needless) + " does not fit --resume and --take-back: the journal says it");
    }
    if (options_.save_same && !options_.persistent) throw UsageError("--save-same needs --persistent");
    if (!yes_ && !dry_run_ && !canAsk()) {
      throw UsageError("restore writes to the drive, and there is no terminal to ask at: expected --yes or --dry-run");
    }
    if (all_) options_.bus_settings = BusSettings::kAll;
    if (none_) options_.bus_settings = BusSettings::kNone;
  }

  void checkJournal(const RestoreJournal& journal, const std::optional<RestoreRecord>& earlier) const {
    if (earlier && earlier->drive != drive_) {
      throw UsageError("the journal " + journal.path() + " is of drive " + earlier->drive + ", not of " + drive_);
    }
    if (!goesOn()) {
      if (!earlier || !earlier->isUnfinished() || dry_run_) return;
      throw Trouble("a restore of drive " + drive_ + " from " + earlier->file +
                    " was broken off: --resume goes on with it, --take-back puts back what was there; or remove " +
                    journal.path());
    }
    if (!earlier) throw UsageError("there is no journal " + journal.path() + ": nothing was begun");
    if (resume_ && earlier->state == RestoreState::kTakingBack) {
      throw Trouble("the restore of drive " + drive_ + " was being taken back" +
                    (earlier->why.empty() ? "" : " (" + earlier->why + ")") + ": --take-back goes on with that");
    }
    if (resume_ && !earlier->isUnfinished()) {
      throw Trouble("the last restore of drive " + drive_ + " is " + toString(earlier->state) +
                    ": there is nothing to go on with");
    }
    if (take_back_ && earlier->state == RestoreState::kTakenBack) {
      throw Trouble("the last restore of drive " + drive_ + " is taken back already");
    }
  }

  // On stdout, where no JSON is.
  void say(const std::string& text) const { std::fputs(text.c_str(), json_ ? stderr : stdout); }

  bool agreed(DriveParameters& drive, const std::string& question, const std::atomic<bool>& end_asked) const {
    if (yes_) return true;
    std::fflush(stdout);
    if (askYesOrNo(
            question, [&drive] { drive.pass(kThinking); }, end_asked))
      return true;
    std::fputs("nord_param: nothing was written\n", stderr);
    return false;
  }

  // At rest: ramps and limits of another machine on one wheel of a base that drives would be none of its own.
  bool mayWrite(DriveParameters& drive, const std::string& question, const std::atomic<bool>& end_asked) const {
    if (!agreed(drive, question, end_asked)) return false;
    const std::string moving = drive.notAtRest();
    if (!moving.empty()) throw Trouble(moving);
    return true;
  }

  bool restore(WatchedParameters& drive, const Dump& dump, const RestoreJournal& journal,
               const std::atomic<bool>& end_asked) {
    if (options_.save_same && !drive.savesSame()) {
      throw Trouble(
          "--save-same does not go through the node, which writes no value that the drive has already: end the "
          "node first");
    }
    drive.expect("reading", dump.values.size());
    const RestorePlan plan = planRestore(drive, dump, options_, end_asked);
    drive.end();
    say("drive " + drive_ + " (" + drive.identity().address + "), from " + file_ + ":\n" +
        planText(plan, drive.known(), options_.persistent));
    if (options_.persistent && !options_.save_same && !plan.same.empty()) {
      say("whether a value that is there already is saved, or in the RAM only, cannot be read: --save-same saves it\n");
    }
    RestoreRecord record = recordOf(plan, drive, std::filesystem::absolute(file_).string(), options_.persistent);
    left_out_ = plan.left_out;
    if (dry_run_ || plan.changes.empty()) {
      tell(record, {}, dry_run_ ? "planned" : "done", drive);
      return true;
    }
    if (!mayWrite(drive, "write this to drive " + drive_ + "?", end_asked)) return false;
    RestoreRun run{drive, record, [&journal](const RestoreRecord& saved) { journal.write(saved); }, end_asked};
    drive.expect("writing", accessesOf(record));
    return ended(run.write(), run, record, drive, journal);
  }

  // A drive of the same name may be another one, in another configuration; but one whose address was restored is somewhere else.
  static void requireSamePlace(const DriveParameters& drive, const RestoreRecord& record, const std::string& journal) {
    const bool moved =
        std::any_of(record.changes.begin(), record.changes.end(), [](const RestoreRecord::Change& change) {
          return stageOf(change.address.number) == RestoreStage::kReach && change.state != ChangeState::kPending;
        });
    const std::string here = drive.identity().address;
    if (moved || here == record.address) return;
    throw Trouble("the journal " + journal + " is of " + record.address + ", and drive " + record.drive + " is " +
                  here + " here: nothing was written");
  }

  bool goOn(WatchedParameters& drive, RestoreRecord record, const RestoreJournal& journal,
            const std::atomic<bool>& end_asked) {
    requireSamePlace(drive, record, journal.path());
    RestoreRun run{drive, record, [&journal](const RestoreRecord& saved) { journal.write(saved); }, end_asked};
    if (take_back_) {
      if (!mayWrite(drive, "put back what the restore from " + record.file + " has changed in drive " + drive_ + "?",
                    end_asked)) {
        return false;
      }
      drive.expect("taking back", 2 * record.changes.size());
      return ended(run.takeBack(), run, record, drive, journal);
    }
    drive.expect("reading", record.changes.size());
    run.lookAgain();
    drive.end();
    RestorePlan rest;
    rest.same = record.same;
    for (const RestoreRecord::Change& change : record.changes) {
      if (change.state != ChangeState::kWritten) rest.changes.push_back(change);
    }
    say("drive " + drive_ + " (" + drive.identity().address + "), the rest of " + record.file + ":\n" +
        planText(rest, drive.known(), record.persistent));
    if (!mayWrite(drive, "write this to drive " + drive_ + "?", end_asked)) return false;
    drive.expect("writing", accessesOf(record));
    return ended(run.write(), run, record, drive, journal);
  }

  bool ended(RestoreEnd end, const RestoreRun& run, const RestoreRecord& record, WatchedParameters& drive,
             const RestoreJournal& journal) const {
    drive.end();
    for (const std::string& note : run.notes()) std::fprintf(stderr, "nord_param: %s\n", note.c_str());
    const std::string go_on = " (journal " + journal.path() + ")\n";
    switch (end) {
      case RestoreEnd::kVerified:
        say(std::to_string(record.changes.size()) + " written and read back, " +
            std::to_string(record.changes.size() + record.same.size()) + " verified" +
            (record.persistent ? ", in the EEPROM\n" : ", in RAM: lost at power off\n"));
        break;
      case RestoreEnd::kDiffers:
        say("not everything is as it should be: --resume writes it again, --take-back puts back what was there" +
            go_on);
        break;
      case RestoreEnd::kTakenBack:
        say((record.why.empty() ? "" : "refused, " + record.why + "\n") + "taken back: drive " + drive_ +
            " has what it had before\n");
        break;
      case RestoreEnd::kTakenBackInPart:
        say((record.why.empty() ? "" : "refused, " + record.why + "\n") +
            (record.isUnfinished() ? "taken back in part: --take-back tries the rest again" + go_on
                                   : "taken back, but for what this restore has not written\n"));
        break;
    }
    tell(record, run.notes(), end == RestoreEnd::kDiffers ? "differs" : toString(record.state), drive);
    return end == RestoreEnd::kVerified || (end == RestoreEnd::kTakenBack && take_back_);
  }

  void tell(const RestoreRecord& record, const std::vector<std::string>& notes, const std::string& state,
            const DriveParameters& drive) const {
    if (json_) std::fputs(restoreJson(record, left_out_, notes, state, drive.known()).c_str(), stdout);
  }

  std::string drive_;
  std::string file_;
  std::string journal_;
  RestoreOptions options_;
  std::vector<RestorePlan::LeftOut> left_out_;
  bool yes_ = false;
  bool dry_run_ = false;
  bool all_ = false;
  bool none_ = false;
  bool resume_ = false;
  bool take_back_ = false;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<ParamCommand> makeRestoreCommand() {
  return std::make_unique<RestoreCommand>();
}

}  // namespace nord_driver::tools
