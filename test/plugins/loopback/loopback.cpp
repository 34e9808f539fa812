// A transport as somebody else writes it, in a package of its own: a cable that ends where it begins, and at it drives
// that exist in this file alone. doc/plugins.md goes through it.
#include <nord_driver/transport/transport.h>

#include <algorithm>
#include <map>
#include <pluginlib/class_list_macros.hpp>
#include <string>
#include <vector>

namespace loopback {

using namespace nord_driver;
using profile::ParameterRequest;
using profile::ParameterResult;
using Reason = profile::ParameterReason;

/// What a NORD inverter does with control words (BU 2700 6.4.3), in its plainest form.
class Drive {
 public:
  /// False: the word says that it is not to be evaluated (BU 2700 6.4.1 note 2).
  bool obey(const profile::ProcessOutput& output) {
    const unsigned word = output.control_word;
    if ((word & 0x0400u) == 0) return false;
    set_ = word & 0xC000u;
    const bool runs = state_ == kOperationEnabled;
    if ((word & 0x0Fu) == 0x0Fu) {  // on: one state further in each cycle
      if (runs) rampTo(output.setpoints[0]);
      state_ = state_ == kReadyToSwitchOn ? kSwitchedOn : state_ == kSwitchOnDisabled ? state_ : kOperationEnabled;
    } else if ((word & 0x06u) == 0x06u) {  // OFF1: down the ramp
      if (runs) rampTo(0);
      if (!runs || speed_ == 0) state_ = kReadyToSwitchOn;
    } else {  // OFF2, OFF3: at once
      speed_ = 0;
      state_ = kSwitchOnDisabled;
    }
    return true;
  }
  profile::ProcessInput tell() const {
    profile::ProcessInput input;
    input.status_word = static_cast<Word>(0x0B00u | state_ | set_);
    input.actual_values[0] = speed_;
    return input;
  }
  ParameterResult access(const ParameterRequest& request) {
    constexpr std::int32_t kLargest = 10'000;
    ParameterResult result;
    result.id = request.id;
    const auto found = parameters_.find(request.number);
    if (found == parameters_.end()) {
      return refused(result, Reason::kNoSuchParameter, 1, "nobody has told this drive of such a parameter");
    }
    const bool write = request.action != profile::ParameterAction::kRead;
    if (write && request.raw > kLargest) {
      return refused(result, Reason::kOutOfLimits, 2, "that is more than this drive can remember");
    }
    if (write) found->second = request.raw;
    result.outcome = profile::ParameterOutcome::kDone;
    result.raw = found->second;
    return result;
  }

 private:
  enum State : unsigned {
    kSwitchOnDisabled = 0x70,
    kReadyToSwitchOn = 0x31,
    kSwitchedOn = 0x33,
    kOperationEnabled = 0x37
  };

  static ParameterResult refused(ParameterResult result, Reason reason, int code, const char* why) {
    result.outcome = profile::ParameterOutcome::kRefused;
    result.reason = reason;
    result.text.format("loopback error %d, %s", code, why);
    return result;
  }
  void rampTo(std::int16_t setpoint) {
    speed_ = static_cast<std::int16_t>(speed_ + std::clamp(setpoint - speed_, -512, 512));
  }

  State state_ = kSwitchOnDisabled;
  unsigned set_ = 0;        // bits 14 and 15
  std::int16_t speed_ = 0;  // 16384: P105
  std::map<unsigned, std::int32_t> parameters_{{102, 200}, {103, 200}, {104, 0}, {105, 500},
                                               {513, 0},   {543, 1},   {546, 1}, {560, 1}};
};

class Loopback final : public Transport {
 public:
  EndPoint endPoint() const noexcept override { return {"cable", "loopback cable", "A"}; }
  bool serveParametersOnly() noexcept override { return true; }

  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double /*cycle_rate*/) override {
    const auto cable = bus.text("cable");
    if (!cable || cable->empty()) throw ConfigError(bus.fullName("cable") + " is missing: expected A, B or cut");
    cable_ = *cable;
    for (const DriveSettings& drive : drives) {
      const auto address = drive.settings->integer("address").value_or(0);
      if (address >= 1 && address <= 9) {
        addresses_.push_back(address);
        continue;
      }
      throw ConfigError(drive.settings->fullName("address") + ": " + std::to_string(address) +
                        " is not valid, expected a whole number from 1 to 9");
    }
    drives_.resize(drives.size());
  }
  void exchange(const std::vector<profile::ProcessOutput>& outputs,
                std::vector<DriveExchange>& inputs) noexcept override {
    ++cycles_;
    for (DriveIndex i = 0; i < drives_.size(); ++i) {
      inputs[i] = {};
      if (!connected()) continue;
      if (!drives_[i].obey(outputs[i])) ++ignored_;
      inputs[i].input = drives_[i].tell();
      inputs[i].module_answers = inputs[i].inverter_answers = true;
    }
  }
  bool submit(DriveIndex drive, const ParameterRequest& request) noexcept override {
    return !results_.full() && results_.push_back(drives_[drive].access(request));
  }
  std::optional<ParameterResult> pollResult() noexcept override { return results_.takeFront(); }

  bool connected() const noexcept override { return cable_ != "cut"; }
  Sentence busText() const noexcept override { return connected() ? "" : "the loopback cable is cut: join it again"; }
  DriveIdentity identity(DriveIndex drive) const override {
    DriveIdentity identity;
    identity.address = "loopback place " + std::to_string(addresses_[drive]);
    identity.parameter_channel = "loopback";
    return identity;
  }
  BusCounters counters() const noexcept override {
    BusCounters counters;
    counters.add(bus_counter::kCycles, cycles_);
    counters.add({"ignored_words", "control words with bit 10 = 0, which a drive does not evaluate"}, ignored_);
    return counters;
  }

 private:
  std::string cable_;
  std::vector<std::int64_t> addresses_;
  std::vector<Drive> drives_;
  FixedVector<ParameterResult, 16> results_;
  std::uint64_t cycles_ = 0, ignored_ = 0;
};

}  // namespace loopback

PLUGINLIB_EXPORT_CLASS(loopback::Loopback, nord_driver::Transport)
