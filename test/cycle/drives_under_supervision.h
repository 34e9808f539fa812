// Three drives, two of them a base, with a minimal inverter behind each, under one supervisor.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cycle/supervisor.h"
#include "drive/fake_inverter.h"

namespace nord_driver::cycle {

class DrivesUnderSupervision {
 public:
  static constexpr Duration kCycle = std::chrono::milliseconds{10};
  static constexpr DriveIndex kLeft = 0, kRight = 1, kLift = 2;

  explicit DrivesUnderSupervision(bool auto_enable = false) : DrivesUnderSupervision{config(), auto_enable} {}
  explicit DrivesUnderSupervision(const CycleConfig& config, bool auto_enable = false)
      : drives{makeDrives(config)}, supervisor{config, drives, auto_enable} {}

  static CycleConfig config() {
    CycleConfig config;
    config.shutdown_timeout = std::chrono::seconds{1};
    for (const char* name : {"left", "right", "lift"}) {
      DriveSetup setup;
      setup.name = name;
      setup.drive.max_frequency.fill(Hertz{50.0});
      setup.drive.enable_timeout = std::chrono::milliseconds{200};
      setup.drive.shutdown_timeout = config.shutdown_timeout;
      config.drives.push_back(setup);
    }
    config.base = BaseConfig{};
    config.base->left = {kLeft};
    config.base->right = {kRight};
    return config;
  }

  /// One bus cycle; the drives are commanded to stand still unless `velocity` says otherwise.
  void step() {
    now += kCycle;
    for (DriveIndex i = 0; i < drives.size(); ++i) {
      const bool follow = supervisor.groupOf(i).commandAllowed();
      drives[i].setVelocity(RadPerSec{follow ? velocity : 0.0});
      supervisor.groupOf(i).setpointIsZero(!follow || velocity == 0.0);
      outputs[i] = drives[i].pollOutput(now);
      const profile::ProcessInput input = inverters[i].exchange(outputs[i]);
      drives[i].handleInput(input, !inverters[i].silent, now);
    }
    supervisor.update(commands(), now);
    while (const auto completion = supervisor.pollCompletion()) completions.push_back(*completion);
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) step();
  }

  void request(std::uint32_t id, RequestKind kind, DriveIndex drive = kAllDrives,
               Duration patience = std::chrono::seconds{3}) {
    Request request;
    request.id = id;
    request.kind = kind;
    request.drive = drive;
    request.patience = patience;
    supervisor.handleRequest(request, commands(), now);
  }
  /// Asks and runs until the answer has come; "no answer" after 5 s.
  Completion ask(RequestKind kind, DriveIndex drive = kAllDrives, Duration patience = std::chrono::seconds{3}) {
    const std::uint32_t id = ++last_id;
    request(id, kind, drive, patience);
    for (int i = 0; i < 500; ++i) {
      step();
      for (const Completion& completion : completions) {
        if (completion.id == id) return completion;
      }
    }
    Completion none;
    none.message = "no answer";
    return none;
  }
  void bringUp() { run(5); }
  /// What this request was answered with so far.
  std::vector<std::string> answersTo(std::uint32_t id) const {
    std::vector<std::string> answers;
    for (const Completion& completion : completions) {
      if (completion.id == id) answers.push_back((completion.success ? "yes: " : "no: ") + completion.message.str());
    }
    return answers;
  }
  bool allEnabled() const {
    for (const auto& drive : drives) {
      if (drive.report().phase != drive::Phase::kEnabled) return false;
    }
    return true;
  }
  bool noneRuns() const {
    for (const auto& output : outputs) {
      if ((output.control_word & 0x0001) != 0 && (output.control_word & 0x0006) == 0x0006) return false;
    }
    return true;
  }

  std::vector<drive::Drive> drives;
  Supervisor supervisor;
  std::array<drive::FakeInverter, 3> inverters;
  std::array<profile::ProcessOutput, 3> outputs;
  std::vector<Completion> completions;
  Sentence moving;
  Duration to_hear{};  ///< how much longer commands have to be listened to
  double velocity = 0.0;
  Instant now{std::chrono::hours{1}};
  std::uint32_t last_id = 1000;

 private:
  CommandState commands() const {
    CommandState state;
    state.moving = moving;
    state.to_hear = to_hear;
    state.quiet = moving.empty() && to_hear == Duration::zero();
    return state;
  }
  static std::vector<drive::Drive> makeDrives(const CycleConfig& config) {
    std::vector<drive::Drive> drives;
    for (const DriveSetup& setup : config.drives) drives.emplace_back(setup.drive);
    return drives;
  }
};

}  // namespace nord_driver::cycle
