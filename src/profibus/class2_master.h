// A PROFIBUS class-2 master (DP-V1, MS2): reads and writes records of stations that nobody exchanges data with.
// Sans-IO: bytes and the time go in, bytes and the next deadline come out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/class2_connection.h"
#include "profibus/counters.h"
#include "profibus/dp_services.h"
#include "profibus/frame_count.h"
#include "profibus/listen_first.h"
#include "profibus/requester.h"

namespace nord_driver::profibus {

/// Calling order: `restart()` whenever the line was opened; then, as long as `wantsBus()`: pollTransmit, handleBytes
/// and handleTimeout as with DpMaster. A connection to each station is opened by its first record; they take turns,
/// telegram by telegram. A station may be in data exchange with nobody, and may have the address 126.
///
/// It is the only master of its segment: the token ring of another one is not joined. One that is heard, while it
/// listens or later, ends everything without another telegram until `restart()`.
class Class2Master {
 public:
  /// Throws std::invalid_argument with a sentence when a value of `bus` is out of range.
  Class2Master(const BusParameters& bus, const std::vector<StationAddress>& stations, const Class2Times& times = {});

  void restart(Instant now) noexcept;

  /// False when the station has a record under way or a result not fetched, or when the request is out of range;
  /// otherwise one result follows.
  bool submitRecord(std::size_t station, const RecordRequest& request) noexcept;
  std::optional<RecordResult> pollRecord() noexcept;
  /// Ends every connection with an Abort: what `wantsBus()` says no to afterwards is ended.
  void close() noexcept;

  /// Something is to be sent or waited for.
  bool wantsBus(Instant now) noexcept;
  void handleBytes(ByteView bytes, Instant now) noexcept;
  void handleTimeout(Instant now) noexcept;
  ByteView pollTransmit(Instant now) noexcept;
  /// The end of a slot, of listening, or the next sign of life on a quiet connection.
  std::optional<Instant> nextDeadline() const noexcept;

  bool isListening() const noexcept { return listen_.isListening(); }
  bool isConnected(std::size_t station) const noexcept { return connections_[station].isOpen(); }
  const Class2Peer& peer(std::size_t station) const noexcept { return connections_[station].peer(); }
  /// Why a record of this station came to nothing, as a clause whose subject is the station.
  const Sentence& trouble(std::size_t station) const noexcept { return connections_[station].trouble(); }
  /// The other master that was heard: nothing is sent.
  std::optional<std::uint8_t> refusedBy() const noexcept { return refused_by_; }
  /// The same as a sentence; empty when there was none.
  Sentence refusal() const noexcept;
  const Counters& counters() const noexcept { return requester_.counters(); }

 private:
  void advance(Instant now) noexcept;
  void onForeign(std::uint8_t master, bool certain, Instant now) noexcept;
  void dropAll(const char* why) noexcept;

  BusParameters bus_;
  Requester requester_;
  DpServices services_;
  ListenFirst listen_;
  std::vector<StationAddress> stations_;
  std::vector<Class2Connection> connections_;
  std::vector<FrameCount> frame_counts_;
  SlaveCounters slave_counters_;
  FdlRequest request_;
  std::size_t asked_ = 0;
  std::size_t cursor_ = 0, result_cursor_ = 0;
  std::optional<std::uint8_t> refused_by_;
};

}  // namespace nord_driver::profibus
