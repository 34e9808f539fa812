// The server of acyclic records (DP-V1): one read or write at a time, fetched by polling.
//
// NORD: slot 0, index 100 the module, 101 to 104 its inverters, eight bytes that are laid out like the PKW of PPO 1
// (BU 0220 4.2.1, 8.3.4.4; "4 Byte" there is a slip, PKE, IND and PWE are eight).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "sim/inverter/pkw_server.h"
#include "sim/profibus/identification_records.h"

namespace nord_driver::sim {

struct RecordSettings {
  bool active = true;  ///< false: the access point answers RS, whatever Set_Prm says
  unsigned polls = 1;  ///< empty polls answered "nothing yet" before a response is there
  unsigned busy = 0;   ///< reads after a write answered "state conflict" (80 B5) before the answer can be read
  /// BU 2700 6.5 instead of BU 0220 4.2.1: slot 1 the module, slots 2 to 5 the inverters, any index.
  bool by_slot = false;
  /// Parameter numbers without the 1000 on top: "in cyclic data traffic" only it is added (BU 0220 5), in both says
  /// BU 2700 6.5.
  bool plain_numbers = false;
  IdentificationSettings identification;  ///< I&M, behind index 255
};

/// Who executes the orders in the records.
class RecordDevices {
 public:
  virtual ~RecordDevices() = default;
  /// `device`: 0 the module, 1 to 4 its inverters. The number in the order has the 1000 on top.
  virtual PkwWords executeRecord(unsigned device, const PkwWords& order) noexcept = 0;
  /// Error_Code_1 of a negative response to this order, or to the read that fetches its answer; none: it is executed.
  virtual std::optional<std::uint8_t> recordRefusal(unsigned /*device*/, const PkwWords& /*order*/,
                                                    bool /*at_answer*/) noexcept {
    return std::nullopt;
  }
};

class RecordServer {
 public:
  static constexpr unsigned kDevices = 5;
  using Pdu = FixedBytes<240>;

  /// `devices` must outlive the server.
  RecordServer(RecordDevices& devices, const RecordSettings& settings) noexcept
      : devices_(devices), settings_(settings), identification_(settings.identification) {}

  /// A request, or an empty one that asks for the response. None: nothing there yet.
  std::optional<Pdu> handle(ByteView request) noexcept;
  /// A request came whose response was not fetched.
  bool outstanding() const noexcept { return outstanding_; }
  /// The connection ended: no request, no answer to read.
  void reset() noexcept;
  RecordSettings& settings() noexcept { return settings_; }

 private:
  Pdu respond(ByteView request) noexcept;
  Pdu identify(ByteView request) noexcept;
  Pdu read(unsigned device, ByteView request) noexcept;
  Pdu write(unsigned device, ByteView request) noexcept;
  std::optional<unsigned> deviceOf(std::uint8_t slot, std::uint8_t index) const noexcept;

  RecordDevices& devices_;
  RecordSettings settings_;
  IdentificationRecords identification_;
  bool outstanding_ = false;
  unsigned polls_left_ = 0;
  Pdu response_;
  std::array<std::optional<PkwWords>, kDevices> answers_{};  // what a read fetches
  std::array<unsigned, kDevices> busy_left_{};
  std::array<std::optional<std::uint8_t>, kDevices> read_refusals_{};
};

}  // namespace nord_driver::sim
