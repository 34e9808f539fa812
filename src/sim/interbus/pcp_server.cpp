#include "sim/interbus/pcp_server.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

// Places in the blocks.
constexpr std::size_t kService = 0, kReference = 1;
constexpr std::size_t kIndex = 2, kSubIndex = 3, kLength = 4, kData = 5;  // invoke
constexpr std::size_t kError = 2, kAdditional = 3;                        // result; kLength and kData as above

constexpr Word kRead = 0x0081, kWrite = 0x0082, kInitiate = 0x008B;
constexpr Word kConfirmation = 0x0100, kInitiateError = 0x018C;
constexpr unsigned kFirstObject = 0x2000, kLastObject = 0x23E7;

constexpr unsigned kNotConnected = 0x0100, kHardware = 0x0602, kDenied = 0x0603, kInvalidParameter = 0x0605,
                   kNoObject = 0x0607, kNotAtPresent = 0x0800;
constexpr unsigned kBadSubIndex = 0x11, kTooLong = 0x12, kTooShort = 0x13, kTooHigh = 0x31, kTooLow = 0x32;

// A request of a few words, one per ring cycle, and the answer the same way.
constexpr int kCyclesPerService = 16;

}  // namespace

PcpServer::PcpServer(const IbsPcp& config, IbsRing& ring)
    : config_(config), ring_(ring), connected_(ring.robot().drives().size(), !config.initiate) {}

void PcpServer::write(unsigned address, Word value) noexcept {
  invoke_[address - config_.invoke_address] = value;
}

void PcpServer::invoked(Instant now) noexcept {
  order_ = invoke_;
  due_.reset();
  if (order_[kService] == 0) {
    result_ = {};
  } else {
    due_ = now + kCyclesPerService * ring_.cycleTime();
    if (const auto drive = driveOf(order_[kReference])) {
      *due_ += std::chrono::milliseconds(ring_.robot().drive(*drive).parameterSwitches().delay);
    }
  }
}

// A ring that stands carries nothing, and its connections have to be made anew.
void PcpServer::advance(Instant now) noexcept {
  if (!ring_.runs()) {
    std::fill(connected_.begin(), connected_.end(), !config_.initiate);
    due_.reset();
  }
  if (!due_ || now < *due_) return;
  due_.reset();
  carryOut();
}

std::optional<std::size_t> PcpServer::driveOf(Word reference) const noexcept {
  for (std::size_t drive = 0; drive < connected_.size(); ++drive) {
    if (reference == config_.first_reference + ring_.placeOf(drive)) return drive;
  }
  return std::nullopt;
}

void PcpServer::carryOut() noexcept {
  ++services_;
  result_ = {};
  const Word service = order_[kService];
  const auto drive = driveOf(order_[kReference]);
  if (drive && ring_.robot().drive(*drive).parameterSwitches().silent) return;
  result_[kReference] = order_[kReference];
  result_[kService] = static_cast<Word>(service + kConfirmation);
  Error error;
  if (service != kRead && service != kWrite && service != kInitiate) {
    error.class_and_code = 0x0500;
  } else if (!drive || (service != kInitiate && !connected_[*drive])) {
    error.class_and_code = kNotConnected;
  } else if (service == kInitiate) {
    connected_[*drive] = true;
  } else {
    error = access(ring_.robot().drive(*drive), service == kWrite);
  }
  if (error.class_and_code == 0) return;
  if (service == kInitiate) result_[kService] = kInitiateError;
  result_[kError] = static_cast<Word>(error.class_and_code);
  result_[kAdditional] = static_cast<Word>(error.additional);
}

PcpServer::Error PcpServer::access(DriveUnit& drive, bool write) noexcept {
  if (!drive.inverter().powered()) return {kHardware, 0};
  const unsigned index = order_[kIndex];
  if (index < kFirstObject || index > kLastObject) return {kNoObject, 0};
  const unsigned number = index - kFirstObject;
  const ParameterSwitches& switches = drive.parameterSwitches();
  const bool refused = switches.refuse && (!switches.refuse->number || *switches.refuse->number == number);
  ParameterStore& store = drive.parameters();
  const ParameterDefinition* definition = store.find(number);
  if (definition == nullptr || (refused && switches.refuse->error == 0)) return {kNoObject, 0};
  const bool indexed = definition->per_set || definition->elements > 0;
  const unsigned sub = order_[kSubIndex];
  if (indexed != (sub != 0)) return {kInvalidParameter, kBadSubIndex};
  const unsigned from_zero = indexed ? sub - 1 : 0;
  const unsigned set = definition->per_set ? from_zero % ParameterStore::kSets : 0;
  const bool by_table = drive.config().bus.as<IbsDriveConfig>().array_sub_by_table;
  const bool steps = definition->per_set || by_table;
  const unsigned element = steps ? from_zero / ParameterStore::kSets : from_zero;
  const bool between = steps && !definition->per_set && from_zero % ParameterStore::kSets != 0;
  if (between || element >= std::max<unsigned>(definition->elements, 1)) return {kInvalidParameter, kBadSubIndex};
  const unsigned length = definition->double_word ? 4 : 2;
  const auto wrong = [&](ParameterError error, std::int32_t raw) -> Error {
    switch (error) {
      case ParameterError::kNotChangeable:
        return {kDenied, 0};
      case ParameterError::kLimits:
        return {kNotAtPresent, raw > definition->maximum ? kTooHigh : kTooLow};
      case ParameterError::kSubIndex:
      case ParameterError::kNoArray:
        return {kInvalidParameter, kBadSubIndex};
      default:
        return {kNotAtPresent, 0};
    }
  };
  if (refused) return wrong(static_cast<ParameterError>(switches.refuse->error), definition->maximum + 1);
  if (!write) {
    const auto raw = static_cast<std::uint32_t>(store.value(number, set, element));
    result_[kLength] = static_cast<Word>(length);
    result_[kData] = static_cast<Word>(definition->double_word ? raw >> 16 : raw & 0xFFFFu);
    if (definition->double_word) result_[kData + 1] = static_cast<Word>(raw & 0xFFFFu);
    return {};
  }
  if (order_[kLength] != length) return {kInvalidParameter, order_[kLength] > length ? kTooLong : kTooShort};
  std::int32_t raw = definition->double_word
                         ? static_cast<std::int32_t>(std::uint32_t{order_[kData]} << 16 | order_[kData + 1])
                         : toSigned(order_[kData]);
  // Hexadecimal parameters use all 16 bits without a sign.
  if (!definition->double_word && definition->maximum > 0x7FFF) raw = order_[kData];
  const bool to_ram = store.find(560) != nullptr && store.value(560) == 0;
  const auto error = store.write(number, set, element, raw, to_ram ? Storage::kRam : Storage::kEeprom);
  return error ? wrong(*error, raw) : Error{};
}

}  // namespace nord_driver::sim
