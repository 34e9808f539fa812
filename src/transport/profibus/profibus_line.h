// How an engine of PROFIBUS talks on its line: the same for every one of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "link/serial/byte_link.h"
#include "link/serial/serial_settings.h"
#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "transport/profibus/profibus_recorder.h"

namespace nord_driver {

std::unique_ptr<link::ByteLink> openSerialPort(const link::SerialSettings& settings);

/// Hands `engine` what the link has received.
template <typename Engine>
void handOver(Engine& engine, link::ByteLink& link, ProfibusRecorder& recorder) noexcept {
  std::uint8_t buffer[512];
  const std::size_t count = link.read(buffer, sizeof buffer);
  const Instant read = link.now();
  recorder.handleReceived({buffer, count}, read);
  engine.handleBytes({buffer, count}, read);
}

/// Carries bytes between `engine` and an open link until `done()`, the engine has nothing to wait for, or the link is
/// closed. Waits no longer than `until` for what comes next; `done()` tells when that is over.
///
/// What has come is read before anything is sent: a late or doubled answer, left from before a request, would count as
/// the answer to it, and so would every one after it.
template <typename Engine, typename Done>
void talkOnLine(Engine& engine, link::ByteLink& link, ProfibusRecorder& recorder, Instant until, Done done) noexcept {
  while (!done() && link.isOpen()) {
    if (link.waitReadable(link.now())) {
      handOver(engine, link, recorder);
      if (done() || !link.isOpen()) break;
    }
    const Instant start = link.now();
    const ByteView telegram = engine.pollTransmit(start);
    if (!telegram.empty()) {
      recorder.handleSent(telegram, start);
      link.write(telegram);
      continue;
    }
    const auto deadline = engine.nextDeadline();
    if (!deadline) break;
    if (link.waitReadable(std::min(*deadline, until))) handOver(engine, link, recorder);
    if (link.now() >= *deadline) engine.handleTimeout(link.now());
  }
}

}  // namespace nord_driver
