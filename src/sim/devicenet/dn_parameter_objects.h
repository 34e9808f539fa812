// Parameters as attributes: of FI 1 to 4 by classes 100 to 139 or by class 199, of the module by class 181.
//
// BU 0280 4.3.9, 4.3.10. Class = 100 + P / 100 + 10 (FI - 1), attribute = P mod 100, instance = sub-index + 1; the
// sub-index is the one of the parameter channel: 4 (n - 1) + set - 1 for element n of a set-dependent one, else n - 1.
#pragma once

#include <array>

#include "sim/devicenet/dn_objects.h"
#include "sim/devicenet/dn_process.h"
#include "sim/inverter/parameter_store.h"

namespace nord_driver::sim {

class DnParameterObjects : public DnObjects {
 public:
  /// `module`: null for a module without parameters of its own. Both must outlive the objects.
  DnParameterObjects(DnProcess& process, ParameterStore* module) noexcept : process_(process), module_(module) {}

  bool hasClass(std::uint8_t class_id) const noexcept override;
  CipStatus get(const CipAddress& at, CipBytes& value) noexcept override;
  CipStatus set(const CipAddress& at, ByteView value, CipBytes& answer) noexcept override;

  /// The inverter whose parameters, or whose data of classes 40 to 42, are asked for; null: none.
  DriveUnit* driveOf(const CipAddress& at) noexcept;
  void forget() noexcept { index_ = {}; }

 private:
  struct Place {
    CipStatus refusal = CipStatus::kOk;
    ParameterStore* store = nullptr;
    const ParameterDefinition* definition = nullptr;
    unsigned set = 0;
    unsigned element = 0;
    bool of_module = false;
    bool nothing = false;  ///< class 199 with parameter 0
    std::size_t size = 2;  ///< bytes
  };
  struct Index {
    std::uint16_t number = 0;
    std::uint8_t sub_index = 0;
  };
  Place find(const CipAddress& at) noexcept;
  Place findIn(std::size_t place, unsigned number, unsigned sub_index) noexcept;
  static Place findIn(ParameterStore& store, unsigned number, unsigned sub_index) noexcept;

  DnProcess& process_;
  ParameterStore* module_;
  std::array<Index, DnProcess::kInverters> index_{};
};

}  // namespace nord_driver::sim
