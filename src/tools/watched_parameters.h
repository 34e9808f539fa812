// The parameters of a drive, with each access shown as progress.
#pragma once

#include <chrono>
#include <string>

#include "tools/drive_parameters.h"
#include "tools/progress_bar.h"

namespace nord_driver::tools {

class WatchedParameters final : public DriveParameters {
 public:
  /// Both must outlive it.
  WatchedParameters(DriveParameters& drive, ProgressBar& bar) : drive_(drive), bar_(bar) {}
  ~WatchedParameters() override { bar_.end(); }
  WatchedParameters(const WatchedParameters&) = delete;
  WatchedParameters& operator=(const WatchedParameters&) = delete;

  /// So many accesses follow.
  void expect(const std::string& what, std::size_t accesses) {
    bar_.begin(what + " " + drive_.name(), accesses, std::chrono::steady_clock::now());
  }
  void end() { bar_.end(); }

  ParameterAnswer read(const catalogue::ParameterAddress& address) override { return shown(drive_.read(address)); }
  ParameterAnswer write(const catalogue::ParameterAccess& access) override { return shown(drive_.write(access)); }
  void pass(Duration time) override { drive_.pass(time); }
  const std::string& name() const override { return drive_.name(); }
  profile::Series series() const override { return drive_.series(); }
  DriveIdentity identity() const override { return drive_.identity(); }
  const catalogue::DriveCatalogue& known() const override { return drive_.known(); }
  std::string whyNotWritten(std::uint16_t number) const override { return drive_.whyNotWritten(number); }
  std::string notAtRest() override { return drive_.notAtRest(); }
  bool savesSame() const override { return drive_.savesSame(); }
  std::string changedByReading() override { return drive_.changedByReading(); }

 private:
  ParameterAnswer shown(ParameterAnswer answer) {
    bar_.advance(std::chrono::steady_clock::now());
    return answer;
  }

  DriveParameters& drive_;
  ProgressBar& bar_;
};

}  // namespace nord_driver::tools
