// A connection of a class-2 master to one station (DP-V1, MS2): opened when there is something to do, kept alive, and
// one record at a time on it. It needs no data exchange, and parameterises nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/timer_table.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"
#include "profibus/class2_pdu.h"
#include "profibus/fdl_request.h"
#include "profibus/record.h"

namespace nord_driver::profibus {

struct Class2Times {
  /// Told to the slave: it ends a connection on which it hears nothing for that long. 10 ms..kMaxSendTimeout; one that
  /// asks for more (Min_Send_Timeout) gets what it asks for.
  Duration send_timeout = std::chrono::seconds{1};
  /// For the connection to be there, and for one response.
  Duration response_timeout = std::chrono::seconds{2};
};

/// BU 2700 3.3: "established with the Initiate service ... disconnected with the Abort service". The order is that of
/// felser.ch, "MS2 Verbindungsaufbau": Initiate to the resource manager at access point 49, which is polled until it
/// names the access point of the connection; that one is polled until it has accepted. Records go as on MS1
/// (RecordChannel), with Idle in the pauses. A response that does not come in time ends the connection, so that a late
/// one cannot be taken for that to the next request; the next record opens another.
class Class2Connection {
 public:
  Class2Connection(std::size_t slave, const Class2Times& times) noexcept : slave_(slave), times_(times) {}

  /// False when a record is under way, a result has not been fetched, or the request is out of range. Otherwise exactly
  /// one result follows.
  bool submit(const RecordRequest& request) noexcept;
  std::optional<RecordResult> pollResult() noexcept;
  /// Ends the connection with an Abort, when there is one; a record under way ends as offline.
  void close() noexcept;

  bool isOpen() const noexcept { return step_ == Step::kOpen; }
  bool isClosed() const noexcept { return step_ == Step::kClosed; }
  /// Of the connection that is open, or was last.
  const Class2Peer& peer() const noexcept { return peer_; }
  /// Why the last connection or record came to nothing, a clause without subject; empty when nothing did.
  const Sentence& trouble() const noexcept { return trouble_; }

  struct Outgoing {
    std::uint8_t access_point = 0;
    ByteView pdu;       ///< empty: a poll. Valid until the next call
    bool last = false;  ///< an Abort: whether it is answered does not matter
  };
  /// Ends what is over its time; true when the connection has a telegram to send.
  bool wantsTelegram(Instant now) noexcept;
  Outgoing pollTelegram(Instant now) noexcept;
  /// When the next telegram is due on a connection that is quiet now.
  std::optional<Instant> nextDeadline() const noexcept;

  void handleAnswer(const FdlAnswer& answer, Instant now) noexcept;
  /// The telegram was not answered, retries included.
  void handleNoAnswer(Mismatch mismatch) noexcept;
  /// Nothing can be sent any more: the connection is forgotten, and a record under way ends.
  void drop(RecordOutcome outcome, const char* why) noexcept;

 private:
  enum class Step : std::uint8_t {
    kClosed,
    kToInitiate,
    kAwaitGrant,     ///< polls the resource manager
    kAwaitInitiate,  ///< polls the access point of the connection
    kOpen,
    kToAbort
  };
  enum class Record : std::uint8_t {
    kNone,
    kWaiting,  ///< has not been sent, or is to be sent again
    kSent,     ///< taken by the slave: polls
    kEnded     ///< the result waits to be fetched
  };
  enum class Timer : std::uint8_t {
    kResponse,  ///< set by the first sending
    kBusy,      ///< likewise: no repetition of a busy read beyond
    kIdle,      ///< the next sign of life is due
    kCount
  };

  void open() noexcept;
  void expire(Instant now) noexcept;
  bool recordUnderWay() const noexcept { return record_ == Record::kWaiting || record_ == Record::kSent; }
  void handleData(ByteView pdu, Instant now) noexcept;
  void handleGrant(ByteView pdu) noexcept;
  void handleInitiated(ByteView pdu, Instant now) noexcept;
  void handleOnConnection(ByteView pdu, Instant now) noexcept;
  void handleRecord(ByteView pdu, Instant now) noexcept;
  void handleRefusal(ResponseCode code) noexcept;
  void taken() noexcept;
  void finishRecord(RecordOutcome outcome) noexcept;
  void abort(const RecordPdu& pdu) noexcept;
  void closed() noexcept;

  std::size_t slave_;
  Class2Times times_;
  Step step_ = Step::kClosed;
  std::uint8_t server_sap_ = 0;
  Class2Peer peer_;
  RecordPdu control_;  // Initiate, Idle or Abort
  bool idle_to_send_ = false, idle_sent_ = false;
  bool request_under_way_ = false;  // the telegram under way carries a PDU
  bool reopened_ = false;           // for the record under way
  bool raised_ = false;             // Send_Timeout, because the slave asks for more
  Record record_ = Record::kNone;
  RecordRequest request_;
  RecordPdu pdu_;
  RecordResult result_;
  TimerTable<Timer> timers_;
  Sentence trouble_;
};

}  // namespace nord_driver::profibus
