#include "devicenet/eds_check.h"

#include <algorithm>

namespace nord_driver::devicenet {

namespace {

std::uint32_t kindsOf(const IoConfig& io) noexcept {
  switch (io.kind) {
    case IoKind::kNone:
      return 0;
    case IoKind::kPoll:
      return eds_kind::kPoll;
    case IoKind::kStrobe:
      return eds_kind::kStrobe;
    case IoKind::kChangeOfState:
      return eds_kind::kChangeOfState;
    case IoKind::kCyclic:
      return eds_kind::kCyclic;
  }
  return 0;
}

class Check {
 public:
  Check(const NodeConfig& config, const EdsAssemblies& assemblies, const EdsFile& file)
      : config_(config), assemblies_(assemblies), file_(file) {}

  std::vector<std::string> run() {
    identity("vendor_id", config_.vendor_id, file_.vendor_id);
    identity("device_type", config_.device_type, file_.device_type);
    identity("product_code", config_.product_code, file_.product_code);
    if (file_.io_line && config_.io.kind != IoKind::kNone) {
      kind();
      const std::uint32_t in_by = kindsOf(config_.io);
      const std::uint32_t out_by = isPolledBesideStrobe(config_.io) ? eds_kind::kPoll : in_by;
      data("Input", file_.inputs, assemblies_.input, config_.io.input_bytes, in_by);
      data("Output", file_.outputs, assemblies_.output, config_.io.output_bytes, out_by);
    }
    return std::move(sentences_);
  }

 private:
  void say(std::size_t line, const std::string& text) {
    sentences_.push_back("line " + std::to_string(line) + ": " + text);
  }

  void identity(const char* key, std::optional<std::uint16_t> demanded, const std::optional<EdsNumber>& told) {
    if (!demanded || !told || *demanded == told->value) return;
    say(told->line,
        std::string{key} + " is " + std::to_string(told->value) + ", configured is " + std::to_string(*demanded));
  }

  const std::optional<EdsNumber>& infoOf(IoKind io) const noexcept {
    switch (io) {
      case IoKind::kStrobe:
        return file_.strobe;
      case IoKind::kChangeOfState:
        return file_.change_of_state;
      case IoKind::kCyclic:
        return file_.cyclic;
      case IoKind::kNone:
      case IoKind::kPoll:
        break;
    }
    return file_.poll;
  }

  void kind() {
    const std::optional<EdsNumber>& info = infoOf(config_.io.kind);
    if (!info) {
      const bool none = !file_.poll && !file_.strobe && !file_.change_of_state && !file_.cyclic;
      if (!none) say(*file_.io_line, std::string{"the device has no process data by "} + toText(config_.io.kind));
      return;
    }
    if (!isPolledBesideStrobe(config_.io)) return;
    if (!file_.poll) return say(*file_.io_line, "the device cannot be polled beside the bit strobe");
    if ((info->value & eds_kind::kPoll) == 0) {
      say(info->line, "the device does not have a bit strobe and a poll at the same time");
    }
  }

  void data(const char* what, const std::vector<EdsProcessData>& told, std::uint8_t assembly, std::size_t bytes,
            std::uint32_t kinds) {
    const auto ours =
        std::find_if(told.begin(), told.end(), [&](const EdsProcessData& data) { return data.assembly == assembly; });
    const std::string name = "assembly " + std::to_string(assembly);
    if (ours != told.end()) {
      const bool fits = assemblies_.variable ? bytes <= ours->bytes : bytes == ours->bytes;
      if (!fits) {
        say(ours->line, name + " has " + (assemblies_.variable ? "at most " : "") + std::to_string(ours->bytes) +
                            " bytes, configured are " + std::to_string(bytes));
      } else if ((ours->kinds & kinds) == 0) {
        say(ours->line, name + " is not exchanged by " + toText(config_.io.kind));
      }
      return;
    }
    const auto long_enough = [&](const EdsProcessData& data) {
      return assemblies_.variable ? bytes <= data.bytes : bytes == data.bytes;
    };
    // Where none has a path that is understood, any of the length may be ours.
    const bool named = std::any_of(told.begin(), told.end(), [](const EdsProcessData& data) { return data.assembly; });
    if (told.empty() || (!named && std::any_of(told.begin(), told.end(), long_enough))) return;
    std::string list;
    for (const EdsProcessData& data : told) {
      list += (list.empty() ? "" : ", ") + std::to_string(named ? data.assembly.value_or(0) : data.bytes);
    }
    say(*file_.io_line,
        named ? std::string{"no "} + what + " is " + name + "; there are those of assemblies " + list
              : std::string{"no "} + what + " has " + std::to_string(bytes) + " bytes; there are those of " + list);
  }

  const NodeConfig& config_;
  const EdsAssemblies& assemblies_;
  const EdsFile& file_;
  std::vector<std::string> sentences_;
};

void fill(std::optional<std::uint16_t>& open, const std::optional<EdsNumber>& told) {
  if (!open && told && told->value != 0) open = static_cast<std::uint16_t>(told->value);
}

}  // namespace

std::vector<std::string> checkAgainstEds(const NodeConfig& config, const EdsAssemblies& assemblies,
                                         const EdsFile& file) {
  return Check{config, assemblies, file}.run();
}

NodeConfig filledFromEds(NodeConfig config, const EdsFile& file) {
  fill(config.vendor_id, file.vendor_id);
  fill(config.device_type, file.device_type);
  fill(config.product_code, file.product_code);
  return config;
}

}  // namespace nord_driver::devicenet
