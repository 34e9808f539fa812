#include "sim/profibus/class2_server.h"

namespace nord_driver::sim {

namespace {

constexpr std::uint8_t kIdle = 0x48;
constexpr std::uint8_t kDataTransport = 0x51;
constexpr std::uint8_t kResourceManager = 0x56;
constexpr std::uint8_t kInitiate = 0x57;
constexpr std::uint8_t kInitiateRefused = 0xD7;
constexpr std::uint8_t kAbort = 0x58;
constexpr std::uint8_t kRead = 0x5E;
constexpr std::uint8_t kWrite = 0x5F;
constexpr std::size_t kRecordHeader = 4;

// Instance MSAC_C2 in bits 4 and 5.
constexpr std::uint8_t kSequenceError = 0x11;
constexpr std::uint8_t kInvalidRequest = 0x12;
constexpr std::uint8_t kTimeOut = 0x13;
constexpr std::uint8_t kSendTimeoutTooSmall = 0x16;
constexpr std::uint8_t kInvalidAddress = 0x17;
constexpr std::uint8_t kSubnetLocal = 0x01;

constexpr unsigned kFirstAccessPoint = 48;  // and downwards
constexpr Duration kUnit = std::chrono::milliseconds{10};
constexpr std::size_t kShortestInitiate = 16;  // up to the lengths of the addresses
constexpr std::uint8_t kReadAndWrite = 0x01;

std::uint8_t instance(std::uint8_t reason) noexcept {
  return static_cast<std::uint8_t>(0x10u | (reason & 0x0Fu));
}

std::uint8_t low(unsigned value) noexcept {
  return static_cast<std::uint8_t>(value & 0xFFu);
}

}  // namespace

Class2Server::Class2Server(RecordDevices& devices, const RecordSettings& records, const Class2Settings& settings)
    : record_settings_(records), settings_(settings) {
  connections_.reserve(settings.connections);
  for (unsigned i = 0; i < settings.connections; ++i) connections_.emplace_back(devices, records);
}

Class2Server::Answer Class2Server::manage(std::uint8_t master, ByteView request) noexcept {
  if (connections_.empty()) return {Kind::kNotActive, {}};
  if (request.empty()) {
    if (!grant_waits_ || grant_master_ != master) return {};
    grant_waits_ = false;
    return {Kind::kData, grant_};
  }
  if (grant_waits_ && grant_master_ != master) return {Kind::kNoResource, {}};
  grant_master_ = master;
  if (request[0] != kInitiate || request.size() < kShortestInitiate) {
    grant_waits_ = true;
    grant_ = {kAbort, kSubnetLocal, kInvalidRequest};
    return {};
  }
  std::size_t place = 0;
  while (place < connections_.size() && connections_[place].state != State::kFree &&
         connections_[place].state != State::kAborted) {
    ++place;
  }
  if (place == connections_.size()) return {Kind::kNotActive, {}};
  Connection& connection = connections_[place];
  free(connection);
  ByteReader reader{request.sub(4)};
  connection.state = State::kGranted;
  connection.master = master;
  connection.send_timeout = reader.u16be() * kUnit;
  connection.features_known = (reader.u8() & kReadAndWrite) != 0;
  connection.polls_left = record_settings_.polls;
  // Behind it the module knows no network: API 0 on its side.
  connection.address_known = true;
  if (request.size() >= kShortestInitiate + 4) connection.address_known = request[kShortestInitiate + 2] == 0;
  const auto units = static_cast<unsigned>(settings_.min_send_timeout / kUnit);
  grant_ = {kResourceManager, low(kFirstAccessPoint - static_cast<unsigned>(place)), low(units >> 8), low(units)};
  grant_waits_ = true;
  return {};
}

Class2Server::Answer Class2Server::serve(std::uint8_t access_point, std::uint8_t master, ByteView request) noexcept {
  const std::size_t place = kFirstAccessPoint - access_point;
  if (access_point > kFirstAccessPoint || place >= connections_.size()) return {Kind::kNotActive, {}};
  Connection& connection = connections_[place];
  if (connection.state == State::kFree || connection.master != master) return {Kind::kNotActive, {}};
  if (!request.empty() && request[0] == kAbort) {
    free(connection);
    return {};
  }
  switch (connection.state) {
    case State::kAborted:
      return aborted(connection, connection.reason);
    case State::kGranted:
      return initiated(connection, request);
    case State::kOpen:
    case State::kFree:
      break;
  }
  return executed(connection, request);
}

Class2Server::Answer Class2Server::initiated(Connection& connection, ByteView request) noexcept {
  if (!request.empty()) return aborted(connection, kSequenceError);
  if (connection.polls_left > 0) {
    --connection.polls_left;
    return {};
  }
  if (settings_.abort_initiate) return aborted(connection, instance(*settings_.abort_initiate));
  if (connection.send_timeout < settings_.min_send_timeout) return aborted(connection, kSendTimeoutTooSmall);
  if (!connection.address_known) return aborted(connection, kInvalidAddress);
  if (!connection.features_known) {
    free(connection);
    return {Kind::kData, {kInitiateRefused, 0x80, 0xA9, 0x00}};
  }
  connection.state = State::kOpen;
  connection.silence = Duration::zero();
  return {Kind::kData, {kInitiate, 0xF0, kReadAndWrite, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 0, 0, 0}};
}

Class2Server::Answer Class2Server::executed(Connection& connection, ByteView request) noexcept {
  if (request.empty()) {
    if (connection.idle_asked) {
      connection.idle_asked = false;
      return {Kind::kData, {kIdle}};
    }
    if (settings_.mute) return {};
    const auto response = connection.records.handle({});
    if (!response) return {};
    return {Kind::kData, *response};
  }
  if (connection.idle_asked || connection.records.outstanding()) return aborted(connection, kSequenceError);
  connection.silence = Duration::zero();
  switch (request[0]) {
    case kIdle:
      connection.idle_asked = true;
      return {};
    case kRead:
    case kWrite:
    case kDataTransport:
      if (request.size() < kRecordHeader) break;
      if (settings_.abort_record) return aborted(connection, instance(*settings_.abort_record));
      connection.records.handle(request);
      return {};
    default:
      break;
  }
  return aborted(connection, kInvalidRequest);
}

Class2Server::Answer Class2Server::aborted(Connection& connection, std::uint8_t reason) noexcept {
  free(connection);
  return {Kind::kData, {kAbort, kSubnetLocal, reason}};
}

void Class2Server::free(Connection& connection) noexcept {
  connection.state = State::kFree;
  connection.idle_asked = false;
  connection.silence = Duration::zero();
  connection.records.reset();
}

// A master that says nothing for its Send_Timeout is gone. While it waits for a response it polls, and has nothing to
// say.
void Class2Server::advance(Duration span) noexcept {
  for (Connection& connection : connections_) {
    if (connection.state != State::kOpen && connection.state != State::kGranted) continue;
    if (connection.records.outstanding()) continue;
    connection.silence += span;
    if (connection.silence <= connection.send_timeout) continue;
    connection.state = connection.state == State::kOpen ? State::kAborted : State::kFree;
    connection.reason = kTimeOut;
    connection.records.reset();
  }
}

void Class2Server::reset() noexcept {
  for (Connection& connection : connections_) free(connection);
  grant_waits_ = false;
}

unsigned Class2Server::open() const noexcept {
  unsigned count = 0;
  for (const Connection& connection : connections_) count += connection.state == State::kOpen ? 1u : 0u;
  return count;
}

}  // namespace nord_driver::sim
