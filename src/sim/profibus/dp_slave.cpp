#include "sim/profibus/dp_slave.h"

namespace nord_driver::sim {

namespace {

constexpr std::size_t kPkwBytes = 8;

// P746, BU 2700 7.2: bit 0 ready, bit 1 connected to the master, high byte 06h PROFIBUS.
constexpr std::int32_t kModuleReady = 0x0601;
constexpr std::int32_t kModuleConnected = 0x0603;

}  // namespace

DpSlave::DpSlave(DriveUnit& drive, Referee* referee)
    : DpStation(drive.config().address, drive.config().bus.as<DpDriveConfig>().ident, referee),
      settings_(drive.config().bus.as<DpDriveConfig>()),
      parameters_(drive.parameters()),
      inverter_(drive.inverter()),
      pkw_(drive.pkw()) {
  if (referee != nullptr) referee->outputLength(address(), DpSlave::dataLength());
}

bool DpSlave::takeConfiguration(ByteView identifiers) noexcept {
  const Configuration expected = configuration();
  return identifiers == ByteView{expected};
}

void DpSlave::appendInputs(Data& data) const noexcept {
  const std::size_t length = dataLength();
  if (!inverterMissing()) {
    ByteWriter<Data::capacity()> writer{data};
    if (settings_.ppo_type <= 2) {
      const PkwWords& answer = pkw_.answer();
      writer.u16be(answer.pke);
      writer.u16be(answer.ind);
      writer.u16be(answer.pwe1);
      writer.u16be(answer.pwe2);
    }
    writer.u16be(inverter_.statusWord());
    writer.u16be(inverter_.actualValue(0));
    if (data.size() < length) {
      writer.u16be(inverter_.actualValue(swapsWords() ? 2 : 1));
      writer.u16be(inverter_.actualValue(swapsWords() ? 1 : 2));
    }
  }
  data.resize(length);  // words without use, and everything of an inverter that is off, are zero
}

void DpSlave::takeOutputs(ByteView data) noexcept {
  const bool missing = inverterMissing();
  ByteReader reader{data};
  if (settings_.ppo_type <= 2) {
    PkwWords order;
    order.pke = reader.u16be();
    order.ind = reader.u16be();
    order.pwe1 = reader.u16be();
    order.pwe2 = reader.u16be();
    if (!missing) {
      if (referee() != nullptr) referee()->parameterChannel(address(), order, pkw_.hasAnswered(order));
      pkw_.receive(order);
    }
  }
  ProcessData process;
  process.control = reader.u16be();
  process.setpoints[0] = reader.u16be();
  if (reader.remaining() >= 4) {
    process.setpoints[swapsWords() ? 2 : 1] = reader.u16be();
    process.setpoints[swapsWords() ? 1 : 2] = reader.u16be();
  } else {
    process.carried = 1;
  }
  counted().last_control = process.control;
  if (missing) {
    valid_data_seen_ = false;  // one that comes back begins anew: the master may look before it commands
    return;
  }
  if ((process.control & stw::kDataValid) != 0) {
    valid_data_seen_ = true;
  } else if (valid_data_seen_) {
    ++counted().zero_control_words;
    if (referee() != nullptr) referee()->broken(Rule::kZeroControlWord);
  }
  inverter_.receive(process);
  parameters_.show(740, 0, process.control);
  display(740, inverter_.wideSetpoint(), process.setpoints);
}

void DpSlave::showStatus() noexcept {
  if (inverterMissing()) return;
  parameters_.show(741, 0, inverter_.statusWord());
  display(741, inverter_.wideActual(), {inverter_.actualValue(0), inverter_.actualValue(1), inverter_.actualValue(2)});
  parameters_.show(746, 0, state() == SlaveState::kDataExchange ? kModuleConnected : kModuleReady);
}

void DpSlave::display(unsigned number, bool wide, const std::array<Word, 3>& values) noexcept {
  if (!wide) {
    for (unsigned i = 0; i < 3; ++i) parameters_.show(number, displayElement(i), values[i]);
    return;
  }
  const WideField& field = inverter_.wideField();
  parameters_.show(number, displayElement(0), values[field.low]);
  parameters_.show(number, displayElement(0) + 1, values[field.high]);
  parameters_.show(number, displayElement(1), values[field.other()]);
}

// P740 and P741 of SK 700E and 750E have the high word of a 32-bit value 1 in between (BU 0020 6.1.3).
unsigned DpSlave::displayElement(unsigned value) const noexcept {
  const Series series = parameters_.device().series;
  const bool gap = series == Series::kSk700e || series == Series::kSk750e;
  return 1 + value + (gap && value > 0 ? 1u : 0u);
}

// Zeros have bit 10 = 0, so the inverter does not evaluate them. What stops the drive is the fault, not the zeros.
void DpSlave::clearOutputs() noexcept {
  inverter_.receive(ProcessData{});
  pkw_.receive(PkwWords{});
}

void DpSlave::masterLost() noexcept {
  counted().control_before_loss = counters().last_control;
  counted().status_at_loss = inverter_.statusWord();
  if (inverterLink(0)) inverter_.masterLost();
}

// BU 0020 7.2 with the ident number 7531h: PPO types 2 and 4 reserve six words for the process data, two of them
// unused.
DpStation::Configuration DpSlave::configuration() const noexcept {
  switch (settings_.ppo_type) {
    case 1:
      return {0xF3, 0xF1};
    case 2:
      return {0xF3, 0xF5};
    case 3:
      return {0xF1};
    default:
      return {0xF5};
  }
}

std::size_t DpSlave::dataLength() const noexcept {
  const std::size_t parameters = settings_.ppo_type <= 2 ? kPkwBytes : 0;
  const std::size_t words = settings_.ppo_type % 2 == 1 ? 2 : 6;
  return parameters + 2 * words;
}

}  // namespace nord_driver::sim
