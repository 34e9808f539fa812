// What a master counts, bus-wide and per slave, since it was constructed.
#pragma once

#include <cstdint>

#include "profibus/telegram_receiver.h"

namespace nord_driver::profibus {

struct Counters {
  std::uint64_t cycles = 0;
  std::uint64_t telegrams_sent = 0;      ///< retries included
  std::uint64_t telegrams_received = 0;  ///< well-formed ones, whoever sent them
  std::uint64_t retries = 0;
  std::uint64_t timeouts = 0;  ///< slots that ended without an answer
  std::uint64_t checksum_errors = 0;
  std::uint64_t discarded_bytes = 0;    ///< bytes in no telegram
  std::uint64_t unexpected = 0;         ///< well-formed telegrams that answer nothing, those of other masters included
  std::uint64_t foreign_telegrams = 0;  ///< tokens and requests of another master
  std::uint64_t busy = 0;               ///< cycles ended early because the line never fell silent
  std::uint64_t events_lost = 0;        ///< events nobody fetched in time
  ReceiverCounters receiver;            ///< the bytes in detail
};

struct SlaveCounters {
  std::uint64_t requests = 0;  ///< retries included
  std::uint64_t answers = 0;
  std::uint64_t retries = 0;
  std::uint64_t timeouts = 0;
  std::uint64_t unexpected = 0;  ///< telegrams in its slot that were no legal answer
  std::uint64_t exchanges = 0;
  std::uint64_t diagnoses = 0;
  std::uint64_t losses = 0;  ///< times it left data exchange, or fell silent there
  /// Times its start-up began after it had exchanged data: it said that it is not in data exchange, was found again with
  /// its watchdog run out, or was given up because of what it answered. Gone on with after a silence, it has not left.
  std::uint64_t departures = 0;
  std::uint64_t refusals = 0;  ///< times its start-up ended in a fault
};

}  // namespace nord_driver::profibus
