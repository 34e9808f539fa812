#include "link/modbus/modbus_exchange.h"

#include <algorithm>

namespace nord_driver::link {

namespace {

Word wordAt(const RegisterImage& image, std::size_t i) noexcept {
  return i < image.size() ? image[i] : Word{0};
}

bool runsAt(std::uint16_t word, Word run_bits, const RegisterImage& image) noexcept {
  return (wordAt(image, word) & run_bits) == run_bits;
}

/// NORD's 0000 orders nothing: without bit 10 no drive takes the word, and goes on as it was told before (BU 2700 7.1.1).
/// To a drive with DRIVECOM, which would coast, it is not sent.
bool ordersAt(std::uint16_t word, const RegisterImage& image) noexcept {
  return wordAt(image, word) != 0;
}

/// The control word at this place does not run, and lacks a bit it had: that it runs no more, or stops quickly now.
bool stopsAt(std::uint16_t word, Word run_bits, const RegisterImage& written, const RegisterImage& next) noexcept {
  if (!ordersAt(word, next)) return false;
  const unsigned lost = static_cast<unsigned>(wordAt(written, word)) & ~static_cast<unsigned>(wordAt(next, word));
  return !runsAt(word, run_bits, next) && (lost & run_bits) != 0;
}

/// How many control words of a part do.
std::ptrdiff_t stopsIn(const ModbusSettings& settings, std::size_t part, const RegisterImage& written,
                       const RegisterImage& next) noexcept {
  const WordRange& range = settings.outputs.parts[part];
  return std::count_if(settings.control_words.begin(), settings.control_words.end(), [&](std::uint16_t word) {
    return word >= range.first && word < range.end() && stopsAt(word, settings.run_bits, written, next);
  });
}

WordRange registersOf(const RegisterBlock& block, std::size_t part) noexcept {
  return {static_cast<std::uint16_t>(block.address + block.parts[part].first), block.parts[part].count};
}

}  // namespace

PartOrder stopsFirst(const ModbusSettings& settings, const RegisterImage& written, const RegisterImage& next) noexcept {
  const auto stops = [&](std::uint8_t part) noexcept { return stopsIn(settings, part, written, next); };
  PartOrder order;
  for (std::size_t i = 0; i < settings.outputs.parts.size(); ++i) order.push_back(static_cast<std::uint8_t>(i));
  // Insertion: stable, and without the memory std::stable_sort takes.
  for (std::size_t i = 1; i < order.size(); ++i) {
    for (std::size_t k = i; k > 0 && stops(order[k]) > stops(order[k - 1]); --k) std::swap(order[k], order[k - 1]);
  }
  return order;
}

bool ModbusExchange::stops(const RegisterImage& next) const noexcept {
  return std::any_of(settings_.control_words.begin(), settings_.control_words.end(),
                     [&](std::uint16_t word) { return stopsAt(word, settings_.run_bits, written_, next); });
}

bool ModbusExchange::ask(const ModbusRequest& request, const Wakeup& stop) noexcept {
  if (connection_.exchange(request, stop)) {
    ++requests_;
    return true;
  }
  reason_ = connection_.reason();
  trouble_ = connection_.trouble();
  exception_ = connection_.exception();
  if (trouble_ == ModbusTrouble::kException) ++refusals_;
  return false;
}

void ModbusExchange::addWrite(std::size_t part, const RegisterImage& outputs, ModbusRequest& request) noexcept {
  note(part, outputs, false);
  request.function = settings_.outputs.function;
  request.write = registersOf(settings_.outputs, part);
  request.values = outputs.data() + settings_.outputs.parts[part].first;
}

void ModbusExchange::addRead(std::size_t part, ModbusRequest& request) const noexcept {
  request.function = settings_.inputs.function;
  request.read = registersOf(settings_.inputs, part);
}

void ModbusExchange::note(std::size_t part, const RegisterImage& outputs, bool answered) noexcept {
  const WordRange& range = settings_.outputs.parts[part];
  written_.resize(std::max<std::size_t>(written_.size(), range.end()));
  for (const std::uint16_t word : settings_.control_words) {
    const bool in_part = word >= range.first && word < range.end();
    const bool counts = answered ? ordersAt(word, outputs) : runsAt(word, settings_.run_bits, outputs);
    if (in_part && counts) written_[word] = outputs[word];
  }
}

void ModbusExchange::takeRead(std::size_t part, RegisterInputs& inputs) noexcept {
  const WordRange& range = settings_.inputs.parts[part];
  inputs.words.resize(std::max<std::size_t>(inputs.words.size(), range.end()));
  for (std::size_t i = 0; i < range.count; ++i) inputs.words[range.first + i] = connection_.answered(i);
}

// Behind a part that was refused only what stops is written: a drive hears that whatever another one's registers do. More
// would feed the server's watchdog, which is what stops the drives of the part that was refused.
bool ModbusExchange::mayWrite(std::size_t part, const RegisterImage& outputs) const noexcept {
  return refusals_ == 0 || stopsIn(settings_, part, written_, outputs) > 0;
}

bool ModbusExchange::moveImages(const RegisterImage& outputs, RegisterInputs& inputs, const Wakeup& stop) noexcept {
  const PartOrder order = stopsFirst(settings_, written_, outputs);
  const std::size_t reads = settings_.inputs.parts.size();
  const bool both = settings_.inputs.function == ModbusFunction::kReadWriteRegisters;
  // Where each request does both, the shorter image's last part is moved again, which changes nothing.
  for (std::size_t i = 0; i < (both ? std::max(order.size(), reads) : order.size()); ++i) {
    const std::size_t part = order[std::min(i, order.size() - 1)], read_part = std::min(i, reads - 1);
    if (!mayWrite(part, outputs)) continue;
    ModbusRequest request;
    addWrite(part, outputs, request);
    if (both) addRead(read_part, request);
    if (ask(request, stop)) {
      note(part, outputs, true);
      if (both) takeRead(read_part, inputs);
    } else if (trouble_ != ModbusTrouble::kException) {
      return false;
    }
  }
  return refusals_ == 0 && (both || readImage(settings_.inputs.function, inputs, stop));
}

bool ModbusExchange::readImage(ModbusFunction function, RegisterInputs& inputs, const Wakeup& stop) noexcept {
  inputs.asked = std::chrono::steady_clock::now();
  for (std::size_t part = 0; part < settings_.inputs.parts.size(); ++part) {
    ModbusRequest request;
    addRead(part, request);
    request.function = function;
    if (!ask(request, stop)) return false;
    takeRead(part, inputs);
  }
  return true;
}

bool ModbusExchange::look(RegisterInputs& inputs, const Wakeup& stop) noexcept {
  const ModbusFunction function = settings_.inputs.function;
  const bool writes_too = function == ModbusFunction::kReadWriteRegisters;
  refusals_ = 0;
  inputs.words.clear();
  if (!readImage(writes_too ? ModbusFunction::kReadHoldingRegisters : function, inputs, stop)) return false;
  inputs.received = std::chrono::steady_clock::now();
  return true;
}

bool ModbusExchange::run(const RegisterImage& outputs, RegisterInputs& inputs, const Wakeup& stop) noexcept {
  refusals_ = 0;
  for (const WordRange& part : settings_.outputs.parts) {
    if (part.end() <= outputs.size()) continue;
    trouble_ = ModbusTrouble::kNone;
    reason_.format("the output image has %zu words, expected %u", outputs.size(), part.end());
    return false;
  }
  inputs.words.clear();
  inputs.asked = std::chrono::steady_clock::now();
  if (!moveImages(outputs, inputs, stop)) return false;
  inputs.received = std::chrono::steady_clock::now();
  return true;
}

}  // namespace nord_driver::link
