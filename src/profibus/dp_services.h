// The requests of a DP class-1 master, byte for byte.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "profibus/bus_parameters.h"
#include "profibus/fdl_request.h"
#include "profibus/slave_config.h"

namespace nord_driver::profibus {

/// Builds requests in place. `count_bits` are FCB and FCV from the slave's FrameCount.
class DpServices {
 public:
  explicit DpServices(const BusParameters& bus) noexcept
      : master_(bus.master),
        retries_(bus.max_retries),
        send_sd3_(bus.send_sd3),
        sync_outputs_(bus.sync_outputs),
        freeze_inputs_(bus.freeze_inputs),
        sync_groups_(bus.sync_groups) {}

  /// Is anybody there? Never repeated: a station that does not answer is asked again later.
  void fdlStatus(FdlRequest& request, StationAddress slave) const noexcept;
  void slaveDiag(FdlRequest& request, StationAddress slave, std::uint8_t count_bits) const noexcept;
  void setPrm(FdlRequest& request, const SlaveConfig& slave, std::uint16_t ident,
              std::uint8_t count_bits) const noexcept;
  void chkCfg(FdlRequest& request, const SlaveConfig& slave, std::uint8_t count_bits) const noexcept;
  /// Get_Cfg: which configuration does the slave have?
  void getCfg(FdlRequest& request, StationAddress slave, std::uint8_t count_bits) const noexcept;
  void dataExchange(FdlRequest& request, const SlaveConfig& slave, ByteView outputs,
                    std::uint8_t count_bits) const noexcept;
  /// DP-V1 class 1: `pdu` to access point 51, or a poll when it is empty.
  void record(FdlRequest& request, StationAddress slave, ByteView pdu, std::uint8_t count_bits) const noexcept;
  /// DP-V1 class 2: `pdu` from access point 50 to `access_point`, or a poll when it is empty.
  void class2(FdlRequest& request, StationAddress slave, std::uint8_t access_point, ByteView pdu,
              std::uint8_t count_bits) const noexcept;
  /// Global_Control Operate to all slaves and all groups. There is no Clear: zeroed outputs do not stop a NORD drive
  /// (BU 2700 7.1.1), so that it would only pretend to be a stop.
  void operate(FdlRequest& request) const noexcept;
  /// SYNC or UNSYNC, FREEZE or UNFREEZE, as far as the bus uses them, to its groups.
  void synchronise(FdlRequest& request, bool on) const noexcept;
  /// Of the group that is synchronised.
  bool isSynchronised(const SlaveConfig& slave) const noexcept;

 private:
  void globalControl(FdlRequest& request, std::uint8_t command, std::uint8_t groups) const noexcept;

  struct Route {
    std::uint8_t function;  ///< FC before FCB and FCV
    std::optional<std::uint8_t> dsap, ssap{};
  };

  void ask(FdlRequest& request, StationAddress slave, std::uint8_t count_bits, const Route& route,
           ByteView data) const noexcept;
  /// SRD low; data may come, or an acknowledgement: nothing yet.
  void askAcyclic(FdlRequest& request, StationAddress slave, std::uint8_t dsap, std::uint8_t ssap, ByteView pdu,
                  std::uint8_t count_bits) const noexcept;
  /// SRD high, from the master's access point 62 to one of the slave's.
  static Route toServer(std::uint8_t dsap) noexcept;

  StationAddress master_;
  std::uint8_t retries_;
  bool send_sd3_;
  bool sync_outputs_;
  bool freeze_inputs_;
  std::uint8_t sync_groups_;
};

}  // namespace nord_driver::profibus
