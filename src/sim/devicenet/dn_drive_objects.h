// Motor data (class 40), control supervisor (41) and AC drive (42) of FI 1 to 4: BU 0280 4.3.5 to 4.3.7.
#pragma once

#include "sim/devicenet/dn_objects.h"
#include "sim/devicenet/dn_process.h"

namespace nord_driver::sim {

/// The rating plate: P201 and the following are not among the simulator's parameters.
struct DnMotorData {
  std::uint16_t current = 36;    ///< 0.1 A
  std::uint16_t voltage = 230;   ///< V
  std::uint32_t power = 1500;    ///< W
  std::uint16_t frequency = 50;  ///< Hz
};

class DnDriveObjects : public DnObjects {
 public:
  /// It must outlive the objects.
  explicit DnDriveObjects(DnProcess& process) noexcept : process_(process) {}

  bool hasClass(std::uint8_t class_id) const noexcept override { return class_id >= 40 && class_id <= 42; }
  CipStatus get(const CipAddress& at, CipBytes& value) noexcept override;
  CipStatus set(const CipAddress& at, ByteView value, CipBytes& answer) noexcept override;

  DnMotorData& motor(std::size_t place) noexcept { return motors_[place]; }

 private:
  CipStatus getMotor(std::size_t place, std::uint8_t attribute, CipBytes& value) noexcept;
  CipStatus getSupervisor(std::size_t place, std::uint8_t attribute, CipBytes& value) noexcept;
  CipStatus getDrive(std::size_t place, std::uint8_t attribute, CipBytes& value) noexcept;
  CipStatus setMotor(std::size_t place, std::uint8_t attribute, ByteView value) noexcept;
  CipStatus setSupervisor(std::size_t place, std::uint8_t attribute, ByteView value) noexcept;
  CipStatus setDrive(std::size_t place, std::uint8_t attribute, ByteView value) noexcept;
  CipStatus setParameter(std::size_t place, unsigned number, double in_unit) noexcept;

  DnProcess& process_;
  std::array<DnMotorData, DnProcess::kInverters> motors_{};
};

}  // namespace nord_driver::sim
