// The connections of class-2 masters to a simulated module (DP-V1, MS2): the resource manager at access point 49, and
// the access points it hands out. Beside data exchange, and without it.
//
// BU 0220 8.3.3.2: three class-2 masters at a time. The PDUs are those of felser.ch ("MS2 Verbindungsaufbau") and
// Balluff BTL7-T500 pp. 68, 69, the reasons of an abort those of ProSoft MVI69-PDPMV1 p. 123.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "sim/profibus/record_server.h"

namespace nord_driver::sim {

struct Class2Settings {
  unsigned connections = 3;  ///< 0: the module knows no class-2 master
  /// Of the simulator's choice: a connection whose master wants a shorter Send_Timeout is aborted.
  Duration min_send_timeout = std::chrono::milliseconds{200};
  /// A request of records is not answered at all: the master's time-out.
  bool mute = false;
  /// Ends every connection with this reason (MSAC_C2): instead of accepting it, or at its first record.
  std::optional<std::uint8_t> abort_initiate;
  std::optional<std::uint8_t> abort_record;
};

class Class2Server {
 public:
  using Pdu = RecordServer::Pdu;

  enum class Kind : std::uint8_t {
    kNothingYet,  ///< taken, or nothing to say
    kData,
    kNotActive,  ///< RS
    kNoResource  ///< RR
  };
  struct Answer {
    Kind kind = Kind::kNothingYet;
    Pdu pdu;
  };

  /// `devices` must outlive it.
  Class2Server(RecordDevices& devices, const RecordSettings& records, const Class2Settings& settings);

  /// Access point 49.
  Answer manage(std::uint8_t master, ByteView request) noexcept;
  /// Any other.
  Answer serve(std::uint8_t access_point, std::uint8_t master, ByteView request) noexcept;
  void advance(Duration span) noexcept;
  /// The module was switched off.
  void reset() noexcept;

  /// Connections that are open.
  unsigned open() const noexcept;
  Class2Settings& settings() noexcept { return settings_; }

 private:
  enum class State : std::uint8_t { kFree, kGranted, kOpen, kAborted };
  struct Connection {
    Connection(RecordDevices& devices, const RecordSettings& settings) noexcept : records(devices, settings) {}
    State state = State::kFree;
    std::uint8_t master = 0;
    Duration send_timeout{};
    Duration silence{};
    unsigned polls_left = 0;
    bool features_known = true;
    bool address_known = true;
    bool idle_asked = false;
    std::uint8_t reason = 0;  // of the abort
    RecordServer records;
  };

  Answer initiated(Connection& connection, ByteView request) noexcept;
  Answer executed(Connection& connection, ByteView request) noexcept;
  Answer aborted(Connection& connection, std::uint8_t reason) noexcept;
  static void free(Connection& connection) noexcept;

  RecordSettings record_settings_;
  Class2Settings settings_;
  std::vector<Connection> connections_;
  bool grant_waits_ = false;  // what a poll of access point 49 fetches
  std::uint8_t grant_master_ = 0;
  Pdu grant_;
};

}  // namespace nord_driver::sim
