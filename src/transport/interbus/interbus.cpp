#include "transport/interbus/interbus.h"

#include <algorithm>
#include <utility>

#include "link/modbus/modbus_link.h"
#include "profile/status_word.h"
#include "transport/reopen_interval.h"

namespace nord_driver {

namespace {

std::unique_ptr<link::RegisterLink> connectTo(const link::ModbusSettings& settings) {
  return std::make_unique<link::ModbusLink>(settings);
}

std::string rangeText(unsigned first, unsigned end) {
  return std::to_string(first) + (end - first == 1 ? "" : " to " + std::to_string(end - 1));
}

}  // namespace

InterbusTransport::InterbusTransport() : InterbusTransport(connectTo) {}

InterbusTransport::InterbusTransport(LinkFactory make_link) : make_link_(std::move(make_link)) {}

void InterbusTransport::configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) {
  config_ = readInterbusConfig(bus, drives, cycle_rate);
  if (read_only_) readOnly();
  link_.reset();
  trace_ = std::make_unique<ModbusTrace>(config_);
  config_.server.listener = trace_.get();
  drives_.clear();
  std::vector<PcpDrive> partners;
  for (const InterbusDrive& drive : config_.drives) {
    drives_.emplace_back(drive);
    partners.push_back({drive.communication_reference, drive.array_sub_by_table});
  }
  parameters_.reset();
  if (config_.pcp) parameters_.emplace(*config_.pcp, partners);
  order_ = 0;
  image_.resize(config_.map->outputWords());
  link_ = make_link_(config_.server);
  const auto begins_with_a_stop = [](const InterbusDrive& drive) {
    return drive.drive_profile == InterbusProfile::kDrivecom;
  };
  const bool looks = !read_only_ && std::any_of(config_.drives.begin(), config_.drives.end(), begins_with_a_stop);
  const link::ModbusSettings& server = config_.server;
  // Without what comes over the second connection there are no inputs, and it may have to be made first.
  const bool waits_for_second = server.running && !server.diagnosis.empty();
  const Duration longest = server.response_timeout + (waits_for_second ? server.connect_timeout : Duration::zero());
  first_look_ = looks ? FirstLook{longest} : FirstLook{};
}

// Without parts nothing is written, and function 23 has nothing to write with.
void InterbusTransport::readOnly() {
  link::ModbusSettings& server = config_.server;
  server.outputs.parts.clear();
  server.outputs.function = link::ModbusFunction::kWriteRegisters;
  server.control_words.clear();
  server.watchdog.reset();
  if (server.inputs.function == link::ModbusFunction::kReadWriteRegisters) {
    server.inputs.function = link::ModbusFunction::kReadHoldingRegisters;
  }
  if (!shows_) return;
  const std::size_t words = std::max(config_.map->inputWords(), shown_words_);
  if (words > kMostImageWords || server.inputs.address + words > 65536u) {
    throw ConfigError("the image to show has " + std::to_string(words) + " words from register " +
                      std::to_string(server.inputs.address) + " on, expected at most " +
                      std::to_string(std::min<std::size_t>(kMostImageWords, 65536u - server.inputs.address)));
  }
  server.inputs.parts.clear();
  for (std::size_t first = 0; first < words; first += link::kMostReadRegisters) {
    const std::size_t count = std::min<std::size_t>(link::kMostReadRegisters, words - first);
    server.inputs.parts.push_back({static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(count)});
  }
}

bool InterbusTransport::serveParametersOnly() noexcept {
  read_only_ = true;
  return true;
}

void InterbusTransport::showWords(std::size_t count) {
  shows_ = true;
  shown_words_ = count;
}

std::string InterbusTransport::imageText() const {
  const link::RegisterBlock& inputs = config_.server.inputs;
  const unsigned end = inputs.parts.empty() ? 0 : inputs.parts.back().end();
  return config_.server.server + ", function " + std::to_string(static_cast<unsigned>(inputs.function)) +
         ", registers " + rangeText(inputs.address, inputs.address + end);
}

std::vector<ImageWord> InterbusTransport::image() const {
  std::vector<ImageWord> words;
  for (std::size_t i = 0; i < newest_.size(); ++i) {
    ImageWord word;
    word.word = i;
    word.register_at = config_.server.inputs.address + static_cast<unsigned>(i);
    word.value = newest_[i];
    const interbus::WordMeaning meaning = config_.map->inputMeaning(i);
    if (meaning.kind != interbus::WordKind::kNobodys) word.drive = config_.drives[meaning.drive].name;
    if (meaning.kind == interbus::WordKind::kPcp) word.meaning = "PCP word";
    if (meaning.kind == interbus::WordKind::kValue) word.meaning = "actual value " + std::to_string(meaning.value);
    if (meaning.kind == interbus::WordKind::kHead) {
      const Word head = config_.map->get(meaning.drive, newest_).head;
      word.meaning = "status word";
      word.text = head == 0 ? "silent" : profile::toString(profile::StatusWord{head}.state());
    }
    words.push_back(word);
  }
  return words;
}

// The link connects, and connects again, by itself; only a computer out of threads keeps it from opening.
bool InterbusTransport::linkReady() noexcept {
  const Instant now = link_->now();
  if (now < next_open_) return false;
  if (link_->open()) return true;
  next_open_ = now + kReopenInterval;
  return false;
}

void InterbusTransport::exchange(const std::vector<profile::ProcessOutput>& outputs,
                                 std::vector<DriveExchange>& inputs) noexcept {
  ++counts_.cycles;
  const Instant begin = link_->now();
  if (linkReady()) {
    const bool all_answered = link_->take().outputs == given_;
    giveOutputs(outputs);
    if (all_answered) waitForAnswer(begin + config_.answer_window);
  }
  report_ = link_->report();
  takeInputs(inputs);
  serveParameters();
}

// After the inputs, so that an order goes out behind the images of its cycle. A drive that does not answer is not asked.
void InterbusTransport::serveParameters() noexcept {
  if (!parameters_) return;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (!drives_[i].answers()) parameters_->handleOffline(i);
  }
  takeAnswer();
  if (!watch_.isGood()) return;
  if (const auto order = parameters_->pollOrder(link_->now())) order_ = link_->order(*order);
}

void InterbusTransport::takeAnswer() noexcept {
  if (order_ == 0) return;
  const link::RegisterAnswer& answer = link_->answer();
  if (answer.number != order_) return;
  order_ = 0;
  parameters_->handleAnswer(answer);
}

void InterbusTransport::giveOutputs(const std::vector<profile::ProcessOutput>& outputs) noexcept {
  if (first_look_.isDue()) {
    given_ = link_->look();
    return;
  }
  for (DriveIndex i = 0; i < drives_.size(); ++i) config_.map->put(i, drives_[i].toWords(outputs[i]), image_);
  given_ = link_->give(image_);
}

void InterbusTransport::waitForAnswer(Instant until) noexcept {
  while (link_->report().state == link::LinkState::kConnected && link_->take().outputs != given_ &&
         link_->now() < until) {
    link_->waitAnswers(until);
  }
}

void InterbusTransport::takeInputs(std::vector<DriveExchange>& inputs) noexcept {
  const link::RegisterInputs& newest = link_->take();
  const InputWorth before = watch_.worth();
  watch_.handle(newest, link_->now());
  running_ = newest.running;
  if (shows_) newest_ = newest.words;
  if (!watch_.isFresh()) ++counts_.without_inputs;
  tellRing(before);
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].takeInput(config_.map->get(i, newest.words), watch_, inputs[i]);
  }
  first_look_.handle(watch_, report_, link_->now());
}

// A gateway that falls silent meanwhile says nothing of its ring.
void InterbusTransport::tellRing(InputWorth before) noexcept {
  const InputWorth worth = watch_.worth();
  const bool stands = worth == InputWorth::kRingStands;
  if (worth == before || (!stands && worth != InputWorth::kGood) || stands == ring_stood_) return;
  ring_stood_ = stands;
  BusEvent event;
  event.warning = stands;
  if (stands) {
    ++counts_.ring_stops;
    event.text.format("the ring behind %s stands: register %u holds %04Xh", config_.server.server.c_str(),
                      config_.server.running ? config_.server.running->address : 0u, running_);
  } else {
    event.text.format("the ring behind %s runs again", config_.server.server.c_str());
  }
  events_.push_back(event);
}

bool InterbusTransport::submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept {
  if (!parameters_) return unserved_.push_back(request.id);
  if (!parameters_->submit(drive, request)) return false;
  drives_[drive].handleSubmitted(request);
  return true;
}

std::optional<profile::ParameterResult> InterbusTransport::pollResult() noexcept {
  if (!parameters_) return pollUnserved();
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (const auto result = parameters_->pollResult(i)) {
      drives_[i].handleResult(*result);
      return result;
    }
  }
  return std::nullopt;
}

std::optional<profile::ParameterResult> InterbusTransport::pollUnserved() noexcept {
  const auto id = unserved_.takeFront();
  if (!id) return std::nullopt;
  profile::ParameterResult result;
  result.id = *id;
  result.outcome = profile::ParameterOutcome::kNoChannel;
  result.text =
      "its gateway carries process data only, no PCP; read or set it at the inverter (ControlBox, ParameterBox, NORD "
      "CON)";
  return result;
}

profile::ParameterCapabilities InterbusTransport::parameterCapabilities(DriveIndex /*drive*/) const noexcept {
  return InterbusParameters::capabilities();
}

DriveNote InterbusTransport::note(DriveIndex drive) const noexcept {
  return {drives_[drive].note(watch_)};
}

Sentence InterbusTransport::busText() const noexcept {
  const char* server = config_.server.server.c_str();
  Sentence text = report_.text;
  if (!text.empty()) return text;
  switch (watch_.worth()) {
    case InputWorth::kNone:
      text.format("waits for the gateway %s", server);
      break;
    case InputWorth::kOld:
      text.format("the inputs of %s are %.0f ms old, more than drive_timeout (%.0f ms)", server,
                  1e3 * toSeconds(watch_.age()), 1e3 * toSeconds(watch_.timeout()));
      break;
    case InputWorth::kRingStands:
      text.format("%s answers, but says that its ring does not run (register %u holds %04Xh)", server,
                  config_.server.running ? config_.server.running->address : 0u, running_);
      break;
    case InputWorth::kGood: {
      const auto answers = [](const InterbusDriveState& drive) { return drive.answers(); };
      if (std::any_of(drives_.begin(), drives_.end(), answers)) break;
      text.format(
          "%s answers, but every status word is 0: are the inverters on, does the ring run, are function, address and "
          "offsets of the inputs right?",
          server);
      break;
    }
  }
  return text;
}

// P513 watches what comes from the ring (BU 0070 5.1), and a gateway may keep the ring going for a computer that is
// dead: only when it ends its outputs does P513 come to act. 0 as a control word stops nothing by itself.
DriveIdentity InterbusTransport::identity(DriveIndex drive) const {
  const InterbusDrive& config = config_.drives[drive];
  DriveIdentity identity;
  identity.address = "InterBus position " + std::to_string(config.position);
  if (config.drive_profile == InterbusProfile::kDrivecom) {
    identity.address += ", DRIVECOM 21";
    identity.nord_profile = false;
    identity.parameter_sets = 1;
  }
  identity.process_values = config.ppo_type == 1 ? 1 : 3;
  if (parameters_) identity.parameter_channel = "PCP (experimental)";
  identity.timeout_notices = false;
  identity.sends_words = !read_only_;
  if (config_.server.watchdog) {
    const bool drivecom = config.drive_profile == InterbusProfile::kDrivecom;
    identity.timeout_needed = !drivecom;
    identity.protected_by = "watchdog of the gateway (register " + std::to_string(config_.server.watchdog->address) +
                            " = " + std::to_string(config_.server.watchdog->value) + "), which ends its outputs: " +
                            (drivecom ? "zeros are DRIVECOM's \"voltage disabled\", and the motor coasts"
                                      : "with P513 > 0 the inverter trips E10 and the motor coasts");
  }
  return identity;
}

std::vector<std::string> InterbusTransport::warnings() const {
  std::vector<std::string> sentences;
  const link::ModbusSettings& server = config_.server;
  if (parameters_) {
    sentences.emplace_back(
        "bus/pcp: the parameter channel by Compact PCP is experimental: it was tried with the simulated gateway only");
  }
  if (!server.running) {
    sentences.emplace_back(
        "bus/running is not configured: where the ring stands and the gateway goes on answering, old status words look "
        "like new ones");
  }
  if (read_only_) return sentences;  // nothing is written, and nothing is to be watched
  for (const InterbusDrive& drive : config_.drives) {
    if (drive.drive_profile != InterbusProfile::kDrivecom) continue;
    sentences.push_back(
        "drive " + drive.name +
        ": with profile: drivecom the inverter takes control word and setpoint from the ring only while "
        "its object 6002h (PA data enabled) is FFh (BU 0070 6.3.2), which the driver does not read: "
        "check it where the drive does not obey");
  }
  if (!server.watchdog) {
    sentences.emplace_back(
        "bus/watchdog is not configured: when this computer dies, a gateway that keeps its ring going repeats the last "
        "control words for ever, and P513 of the inverters does not notice");
  }
  for (const WordRange& words : config_.map->unclaimedOutputs(link::mostRegistersWritten(server.outputs.function))) {
    const unsigned address = server.outputs.address;
    sentences.push_back("output words " + rangeText(words.first, words.end()) + " of the image (registers " +
                        rangeText(address + words.first, address + words.end()) +
                        ") lie between two drives, belong to none and are written as 0 in each cycle: whatever else is "
                        "connected there is switched off");
  }
  return sentences;
}

void InterbusTransport::close() noexcept {
  if (link_) link_->close();
}

ScanReport InterbusTransport::scan(const Settings& /*bus*/, const std::atomic<bool>& /*end_asked*/) {
  ScanReport report;
  report.bus = "InterBus";
  report.number_name = "position";
  report.trouble =
      "the image of a gateway has no addresses, and does not tell who is on the ring: the gateway's own tool does; "
      "nord_param image shows the words and those that change";
  return report;
}

}  // namespace nord_driver
