#include "sim/profibus/module_station.h"

#include "sim/drive_unit.h"

namespace nord_driver::sim {

namespace {

constexpr std::uint16_t kIdent = 0x0BA8;  // BU 0220 8.3.4.6

// Chk_Cfg, one identifier for each slot: BU 0220 4.2.1, 4.2.2.4 and P182 (48, 245, 247, 241, 243).
constexpr std::uint8_t kEmpty = 0x00;
constexpr std::uint8_t kIoByte = 0x30;
constexpr std::array<std::uint8_t, 4> kPpo{0xF5, 0xF7, 0xF1, 0xF3};

constexpr std::uint8_t kOutputs = 0x03;  // DO1 and DO2
constexpr std::size_t kPkwBytes = 8;

// PKW errors: BU 0220 7.2.3.1 prints the same words for both. Here 101: never was there, 102: was there.
constexpr Word kNoSuchInverter = 101;
constexpr Word kInverterLost = 102;

bool carriesParameters(std::uint8_t identifier) noexcept {
  return identifier == kPpo[0] || identifier == kPpo[1];
}
bool isPpo(std::uint8_t identifier) noexcept {
  for (const std::uint8_t known : kPpo) {
    if (known == identifier) return true;
  }
  return false;
}
/// F5h: inputs and outputs, words, 6 of them.
std::size_t lengthOf(std::uint8_t identifier) noexcept {
  if (identifier == kEmpty) return 0;
  return identifier == kIoByte ? 1 : 2u * ((identifier & 0x0Fu) + 1u);
}

}  // namespace

ModuleStation::ModuleStation(const ModuleSettings& settings, Referee* referee)
    : DpStation(settings.address, kIdent, referee),
      settings_(settings),
      parameters_(moduleParameterDefinitions()),
      own_pkw_(parameters_, PkwSettings{}),
      records_(*this, settings.records),
      class2_(*this, settings.records, settings.class2) {
  parameters_.show(180, 0, settings.address);
  parameters_.show(181, 0, moduleBaudRateCode(settings.baud_rate));
  beginAsBuilt();
}

void ModuleStation::connected(unsigned place) noexcept {
  places_[place].ppo_type = driveAt(place)->config().bus.as<DpDriveConfig>().ppo_type;
  beginAsBuilt();
}

void ModuleStation::beginAsBuilt() noexcept {
  configuration_ = {settings_.io_byte ? kIoByte : kEmpty};
  unsigned last = 0;
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (driveAt(place) != nullptr) last = place + 1;
  }
  for (unsigned place = 0; place < last; ++place) {
    const auto ppo = static_cast<std::size_t>(places_[place].ppo_type - 1);
    configuration_.push_back(driveAt(place) == nullptr ? kEmpty : kPpo[ppo]);
  }
}

// Slot 1 has to be there, the I/O byte or empty; the module finds the PPO types out by itself (BU 0220 1.1, 4.2.2.4).
bool ModuleStation::takeConfiguration(ByteView identifiers) noexcept {
  if (identifiers.empty() || identifiers.size() > 1 + kPlaces) return false;
  if (identifiers[0] != kIoByte && identifiers[0] != kEmpty) return false;
  bool anything = identifiers[0] == kIoByte;
  for (const std::uint8_t identifier : identifiers.sub(1)) {
    if (identifier != kEmpty && !isPpo(identifier)) return false;
    anything = anything || identifier != kEmpty;
  }
  if (!anything) return false;
  configuration_.clear();
  for (const std::uint8_t identifier : identifiers) configuration_.push_back(identifier);
  return true;
}

std::size_t ModuleStation::dataLength() const noexcept {
  std::size_t length = 0;
  for (const std::uint8_t identifier : configuration_) length += lengthOf(identifier);
  return length;
}

void ModuleStation::appendInputs(Data& data) const noexcept {
  ByteWriter<Data::capacity()> writer{data};
  if (hasIoByte()) writer.u8(settings_.inputs);
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (!configured(place)) continue;
    const bool there = present(place);
    const std::uint8_t identifier = configuration_[place + 1];
    const std::size_t end = data.size() + lengthOf(identifier);
    if (carriesParameters(identifier)) {
      const PkwWords& answer = there ? driveAt(place)->pkw().answer() : places_[place].refused;
      writer.u16be(answer.pke);
      writer.u16be(answer.ind);
      writer.u16be(answer.pwe1);
      writer.u16be(answer.pwe2);
    }
    if (there) {
      const InverterModel& inverter = driveAt(place)->inverter();
      writer.u16be(inverter.statusWord());
      for (unsigned n = 0; data.size() < end; ++n) writer.u16be(inverter.actualValue(n));
    }
    data.resize(end);  // the process data of an inverter that is off are zero
  }
}

ModuleStation::Slot ModuleStation::readSlot(std::uint8_t identifier, ByteReader& reader) noexcept {
  Slot slot;
  slot.has_order = carriesParameters(identifier);
  if (slot.has_order) {
    slot.order.pke = reader.u16be();
    slot.order.ind = reader.u16be();
    slot.order.pwe1 = reader.u16be();
    slot.order.pwe2 = reader.u16be();
  }
  slot.process.control = reader.u16be();
  const std::size_t words = (lengthOf(identifier) - (slot.has_order ? kPkwBytes : 0)) / 2;
  slot.process.carried = static_cast<unsigned>(words) - 1;
  for (unsigned n = 0; n < slot.process.carried; ++n) slot.process.setpoints[n] = reader.u16be();
  return slot;
}

// "With the first valid telegram (control word bit 10 = 1) this watchdog is started" (BU 0220 4.2.3.2); one valid
// control word of several is enough.
void ModuleStation::outputsArrived(ByteView data) noexcept {
  ByteReader reader{data};
  if (hasIoByte()) reader.u8();
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (!configured(place)) continue;
    const Slot slot = readSlot(configuration_[place + 1], reader);
    if ((slot.process.control & stw::kDataValid) == 0) continue;
    valid_data_seen_ = true;
    since_valid_ = Duration::zero();
    cause_stands_ = false;
  }
}

void ModuleStation::takeOutputs(ByteView data) noexcept {
  ByteReader reader{data};
  if (hasIoByte()) {
    output_byte_ = reader.u8();
    parameters_.show(176, 0, output_byte_);
  }
  for (unsigned place = 0; place < kPlaces; ++place) {
    if (configured(place)) command(place, readSlot(configuration_[place + 1], reader));
  }
  endTimeOut();
}

void ModuleStation::command(unsigned place, const Slot& slot) noexcept {
  Place& there = places_[place];
  if (slot.has_order) order(place, slot.order);
  const Word control = slot.process.control;
  there.counters.last_control = control;
  parameters_.show(176, 1 + 4 * place, toSigned(control));
  for (unsigned n = 0; n < 3; ++n) parameters_.show(176, 2 + 4 * place + n, toSigned(slot.process.setpoints[n]));
  if (!present(place)) {
    there.valid_data_seen = false;  // one that comes back begins anew: the master may look before it commands
    return;
  }
  if ((control & stw::kDataValid) != 0) {
    there.valid_data_seen = true;
  } else if (there.valid_data_seen) {
    ++there.counters.zero_control_words;
    if (referee() != nullptr) referee()->broken(Rule::kZeroControlWord);
  }
  // In its time-out the module lets through what an acknowledgement needs, and nothing that would start a motor.
  DriveUnit& drive = *driveAt(place);
  if (timed_out_ && drive.inverter().faultNumber() == 0) return;
  drive.inverter().receive(slot.process);
  drive.parameters().show(740, 0, control);
  for (unsigned n = 0; n < 3; ++n) drive.parameters().show(740, 1 + n, slot.process.setpoints[n]);
}

void ModuleStation::order(unsigned place, const PkwWords& order) noexcept {
  places_[place].refused = PkwWords{};
  if (present(place)) {
    PkwServer& pkw = driveAt(place)->pkw();
    if (referee() != nullptr) referee()->parameterChannel(address(), order, pkw.hasAnswered(order), place);
    pkw.receive(order);
  } else if (order.label() != 0) {
    places_[place].refused = PkwServer::refusal(order, absence(place));
  }
}

Word ModuleStation::absence(unsigned place) const noexcept {
  return places_[place].seen ? kInverterLost : kNoSuchInverter;
}

// BU 0220 4.2.3.1: the module switches all its own outputs to 0.
void ModuleStation::clearOutputs() noexcept {
  output_byte_ = 0;
  for (unsigned place = 0; place < kPlaces; ++place) {
    places_[place].refused = PkwWords{};
    DriveUnit* drive = driveAt(place);
    if (drive == nullptr) continue;
    drive->inverter().receive(ProcessData{});
    drive->pkw().receive(PkwWords{});
  }
}

void ModuleStation::enterDataExchange() noexcept {
  for (Place& place : places_) place.valid_data_seen = false;
}

bool ModuleStation::inverterMissing() const noexcept {
  for (unsigned place = 0; place < kPlaces; ++place) {
    const bool expected = configured(place) || driveAt(place) != nullptr;
    if (expected && !present(place)) return true;
  }
  return false;
}

void ModuleStation::supplyChanged(bool /*on*/) noexcept {
  output_byte_ = 0;
  valid_data_seen_ = cause_stands_ = timed_out_ = false;
  error_ = 0;
  parameters_.restoreFromEeprom();
  parameters_.show(180, 0, settings_.address);
  parameters_.show(181, 0, moduleBaudRateCode(settings_.baud_rate));
  for (Place& place : places_) place.seen = place.valid_data_seen = false;
  showLinks();
  beginAsBuilt();
}

std::uint8_t ModuleStation::outputs() const noexcept {
  if (!powered()) return 0;
  switch (parameters_.value(150)) {
    case 1:
      return 0;
    case 2:
      return 1;
    case 3:
      return 2;
    case 4:
      return 3;
    default:
      return timed_out_ ? std::uint8_t{0} : static_cast<std::uint8_t>(output_byte_ & kOutputs);
  }
}

ExchangeCounters ModuleStation::countersOf(unsigned place) const noexcept {
  ExchangeCounters both = counters();
  const ExchangeCounters& own = places_[place].counters;
  both.zero_control_words = own.zero_control_words;
  both.last_control = own.last_control;
  both.control_before_loss = own.control_before_loss;
  both.status_at_loss = own.status_at_loss;
  return both;
}

}  // namespace nord_driver::sim
