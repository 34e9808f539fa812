// The times of a PROFIBUS segment and of its master: held in bit times as the standard does, converted here only.
#pragma once

#include <cstdint>
#include <optional>

#include "core/baud_rate.h"
#include "nord_driver/core/time.h"
#include "profibus/station_address.h"

namespace nord_driver::profibus {

constexpr Duration kLongestListening = std::chrono::seconds{10};

struct BusParameters {
  BaudRate baud{19'200};
  StationAddress master;             ///< our own address, 0..125
  std::uint32_t slot_bits = 100;     ///< T_SL: how long an answer may be in coming, at most 16383
  std::uint32_t min_tsdr_bits = 11;  ///< min T_SDR: the earliest answer
  std::uint32_t max_tsdr_bits = 60;  ///< max T_SDR: the latest answer of a sound slave
  std::uint32_t quiet_bits = 0;      ///< T_QUI: repeater switching
  std::uint32_t setup_bits = 1;      ///< T_SET
  std::uint8_t max_retries = 1;      ///< repetitions of an unanswered request, 0..15

  /// Instead of T_SL, where the adapter is slower than the bus (a USB adapter holds answers back for up to 16 ms).
  /// Costs nothing but time with silent slaves.
  std::optional<Duration> slot_time;

  Duration probe_interval = std::chrono::milliseconds{250};  ///< a silent slave is asked for no more often than this
  Duration operate_interval = std::chrono::seconds{1};       ///< Global_Control Operate, 0 = never
  /// Before the first telegram, and for as long again whenever another master is heard meanwhile; 0 = do not listen, at
  /// most kLongestListening. A token comes round in far less than a second on any segment.
  Duration listen_first{0};
  /// Another master that is heard while we lead gets the bus: nothing more is sent until it has been silent for
  /// `listen_first`, or up to twice as long where it has given way again at once. For who only looks on and brings no
  /// watchdog: a driver does not leave its drives to anybody.
  bool gives_way = false;

  // Global_Control SYNC and FREEZE, off unless asked for: a slave in SYNC keeps its outputs, stop words included, and
  // data exchange feeds its watchdog all the same (BU 2700 6.3; BU 0020 5.3). So a master that uses them sends SYNC in
  // every cycle behind the exchanges, falls back to UNSYNC when one of the group did not exchange, and sends UNSYNC in
  // every cycle until it is switched on again: see DpMaster::setSynchronised().
  bool sync_outputs = false;     ///< new outputs act at the same moment
  bool freeze_inputs = false;    ///< inputs are of the same moment, one cycle older
  std::uint8_t sync_groups = 0;  ///< slaves with one of these group bits; 0 = all

  bool send_sd3 = false;  ///< requests of eight octets as SD3; both kinds are legal, slaves are seen to use SD2

  /// The usual values of a standard rate (9.6k, 19.2k, 45.45k, 93.75k, 187.5k, 500k, 1.5M, 3M, 6M, 12M).
  /// Throws std::invalid_argument when the rate is none of these.
  static BusParameters forBaudRate(BaudRate baud, StationAddress master);

  /// Throws std::invalid_argument with a sentence when a value is out of its range or the slot is too short for the
  /// answers.
  void validate() const;

  /// T_ID1 = 35 + 2 T_SET + T_QUI: idle time before a request; the standard's minimum of 33 (T_SYN) is in it.
  std::uint32_t idleBits() const noexcept { return 35 + 2 * setup_bits + quiet_bits; }
  /// T_ID2: idle time after a request nobody answers.
  std::uint32_t broadcastIdleBits() const noexcept { return idleBits() > max_tsdr_bits ? idleBits() : max_tsdr_bits; }

  Duration idleTime() const noexcept { return baud.bits(idleBits()); }
  Duration broadcastIdleTime() const noexcept { return baud.bits(broadcastIdleBits()); }
  Duration slotTime() const noexcept { return slot_time ? *slot_time : baud.bits(slot_bits); }
};

}  // namespace nord_driver::profibus
