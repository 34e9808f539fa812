// The machine's CAN interfaces, made and changed as an administrator does it, and a bare socket on one of them.
#pragma once

#include <string>

#include "core/can_frame.h"
#include "link/can/can_link.h"
#include "link/can/can_settings.h"

namespace nord_driver::link {

/// "link set vcan0 down" for ip(8), "qdisc add ..." for tc(8). A failure is a failed assertion.
void ip(const std::string& words);
void tc(const std::string& words);
bool exists(const std::string& interface);

/// A vcan interface that lives as long as this.
class VcanInterface {
 public:
  explicit VcanInterface(std::string name);
  ~VcanInterface();
  VcanInterface(const VcanInterface&) = delete;
  VcanInterface& operator=(const VcanInterface&) = delete;

  const std::string& name() const { return name_; }
  CanSettings settings(std::vector<std::uint32_t> ids = {}) const;
  void add() const;
  void remove() const;

 private:
  std::string name_;
};

CanSettings settingsFor(const std::string& interface, std::vector<std::uint32_t> ids = {});

/// Sends what a link does not: error frames, as a driver of a controller would, and what others on the bus might say.
class BareSocket {
 public:
  explicit BareSocket(const std::string& interface);
  ~BareSocket();
  BareSocket(const BareSocket&) = delete;
  BareSocket& operator=(const BareSocket&) = delete;

  void sendError(std::uint32_t classes, const std::array<std::uint8_t, 8>& data = {});
  /// A frame with eight zeros.
  void sendZeros(std::uint32_t id);
  void send(const CanFrame& frame);
  /// What is sent from now on is heard at the other end of a pair only, not by other sockets on this interface.
  void sendOutOnly();
  /// True when a filter of `count` identifiers is taken.
  bool takesFilters(std::size_t count);

 private:
  void write(std::uint32_t id, ByteView data);

  int descriptor_ = -1;
};

/// A frame of two bytes that can be told from others.
CanFrame numberedFrame(std::uint32_t id, std::uint16_t number);
std::uint16_t numberOf(const CanFrame& frame);

/// Plenty on an emulated machine; a wait ends as soon as it can.
constexpr std::chrono::seconds kPatience{20};

/// The next frame, within kPatience.
bool next(CanLink& link, CanFrame& frame);
/// Waits until `link` is in this state or closed, within kPatience, taking what arrives.
bool reaches(CanLink& link, CanState state);

}  // namespace nord_driver::link
