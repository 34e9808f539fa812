// What a GSD file (the maker's data sheet of a slave, as text) says that a master needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/core/time.h"

namespace nord_driver::profibus {

/// Something in the file that is not as it should be. It was left out, and the rest was read.
struct GsdProblem {
  std::size_t line = 0;  ///< from 1
  std::string text;
};

struct GsdModule {
  std::string name;
  std::vector<std::uint8_t> configuration;  ///< its identifiers in Chk_Cfg
  /// Ext_User_Prm_Data_Const with the defaults of Ext_User_Prm_Data_Ref over it; appended to the station's, in the
  /// order of the slots.
  std::vector<std::uint8_t> user_parameters;
};

struct GsdRate {
  std::uint32_t bits_per_second = 0;
  bool supported = false;
  std::uint32_t max_tsdr_bits = 0;  ///< 0: not told
};

struct GsdFile {
  unsigned revision = 0;
  std::string vendor, model;
  std::optional<std::uint16_t> ident_number;

  std::vector<GsdRate> rates;  ///< those the file speaks of
  bool auto_baud = false;
  bool sync_supported = false, freeze_supported = false;
  Duration min_slave_interval{0};  ///< between two exchanges with this slave

  bool modular = false;
  unsigned max_modules = 0;  ///< modules, however many identifiers each has; 0: not told
  /// Bytes per exchange; 0: not told.
  unsigned max_input_length = 0, max_output_length = 0, max_data_length = 0;
  unsigned max_diagnosis_length = 0, max_user_parameters = 0;
  /// User_Prm_Data, with Ext_User_Prm_Data_Const laid over it, and the defaults of Ext_User_Prm_Data_Ref over both,
  /// wherever in the file each stands. With DP-V1 the first three are DPV1_Status_1 to 3.
  std::vector<std::uint8_t> user_parameters;

  bool dpv1 = false;  ///< DPV1_Slave
  bool c1_read_write = false;
  unsigned c1_max_length = 0;       ///< of a record
  Duration c1_response_timeout{0};  ///< 0: not told

  std::vector<GsdModule> modules;
  std::vector<GsdProblem> problems;

  /// Nothing when there is none, or more than one, of that name.
  const GsdModule* module(const std::string& name) const noexcept;
  /// 0: the file does not tell.
  std::uint32_t maxTsdrBits(std::uint32_t bits_per_second) const noexcept;
};

/// Reads the text of a file. Keys are taken in any case; comments, continuation lines and keys of no interest are
/// known. Never throws for what is in the text: see `problems`.
GsdFile parseGsd(const std::string& text);

}  // namespace nord_driver::profibus
