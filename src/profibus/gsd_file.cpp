#include "profibus/gsd_file.h"

#include <algorithm>
#include <array>

#include "profibus/gsd_lines.h"
#include "profibus/gsd_parameters.h"
#include "profibus/slave_config.h"

namespace nord_driver::profibus {

namespace {

struct RateName {
  const char* name;
  std::uint32_t bits_per_second;
};
constexpr std::array<RateName, 11> kRates{{{"9.6", 9'600},
                                           {"19.2", 19'200},
                                           {"31.25", 31'250},
                                           {"45.45", 45'450},
                                           {"93.75", 93'750},
                                           {"187.5", 187'500},
                                           {"500", 500'000},
                                           {"1.5m", 1'500'000},
                                           {"3m", 3'000'000},
                                           {"6m", 6'000'000},
                                           {"12m", 12'000'000}}};

/// Blocks for engineering tools: skipped to their end, but for the defaults of parameters. Their keys mean something
/// else inside.
struct BlockName {
  const char* begin;
  const char* end;
};
constexpr BlockName kParameter{"extuserprmdata", "endextuserprmdata"};
constexpr std::array<BlockName, 7> kSkipped{{{"prmtext", "endprmtext"},
                                             kParameter,
                                             {"unit_diag_area", "unit_diag_area_end"},
                                             {"unitdiagtype", "endunitdiagtype"},
                                             {"slotdefinition", "endslotdefinition"},
                                             {"channeldiag", "endchanneldiag"},
                                             {"physical_interface", "end_physical_interface"}}};

constexpr Duration kIntervalUnit = std::chrono::microseconds{100};
constexpr Duration kTimeoutUnit = std::chrono::milliseconds{10};
constexpr unsigned kMaxNumber = 1'000'000;

/// Ext_User_Prm_Data_Const of a module, or of the station without one.
struct Constants {
  std::optional<std::size_t> module;
  std::size_t offset = 0;
  std::vector<std::uint8_t> bytes;
};

class GsdReader {
 public:
  GsdFile read(const std::string& text) {
    for (const GsdStatement& statement : splitGsd(text)) take(statement);
    if (!skip_until_.empty()) problem(skip_from_, "this block has no end (" + skip_until_ + ")");
    if (module_) problem(module_line_, "this module has no EndModule");
    if (!seen_start_) problem(1, "no #Profibus_DP: this may be no GSD file");
    if (!file_.ident_number) problem(1, "no Ident_Number");
    finishParameters();
    return std::move(file_);
  }

 private:
  void take(const GsdStatement& statement) {
    if (!skip_until_.empty()) {
      if (statement.key == skip_until_) {
        skip_until_.clear();
      } else if (skip_until_ == kParameter.end) {
        parameters_.takeLine(statement);
      }
      return;
    }
    for (const BlockName& block : kSkipped) {
      if (statement.key != block.begin) continue;
      if (statement.key == kParameter.begin) parameters_.begin(statement);
      skip_until_ = block.end;
      skip_from_ = statement.line;
      return;
    }
    if (statement.key == "#profibus_dp") {
      seen_start_ = true;
    } else if (statement.key == "module") {
      beginModule(statement);
    } else if (statement.key == "endmodule") {
      if (!module_) problem(statement.line, "EndModule without Module");
      module_ = false;
    } else if (statement.key == "ext_user_prm_data_const") {
      takeConstants(statement);
    } else if (statement.key == "ext_user_prm_data_ref") {
      parameters_.refer(statement, moduleIndex());
    } else if (module_ && statement.key == "ext_module_prm_data_len") {
      takeNumber(statement, kMaxUserParameters, module_lengths_.back());
    } else if (!module_ && !takeRate(statement)) {
      takeKey(statement);
    }
  }

  void beginModule(const GsdStatement& statement) {
    if (module_) problem(statement.line, "Module inside of a Module");
    module_ = true;
    module_line_ = statement.line;
    GsdModule module;
    std::string rest;
    if (!gsdQuoted(statement.value, module.name, rest)) {
      problem(statement.line, "a module without a name in quotes");
      rest = statement.value;
    }
    if (!gsdBytes(rest, module.configuration)) {
      problem(statement.line, "module \"" + module.name + "\": \"" + rest + "\" is no list of bytes");
    }
    file_.modules.push_back(std::move(module));
    module_lengths_.push_back(0);
  }

  std::optional<std::size_t> moduleIndex() const {
    if (!module_) return std::nullopt;
    return file_.modules.size() - 1;
  }

  /// Bytes from an offset on.
  void takeConstants(const GsdStatement& statement) {
    const auto offset = gsdNumber(statement.argument, kMaxUserParameters);
    std::vector<std::uint8_t> bytes;
    if (!offset || !gsdBytes(statement.value, bytes) || *offset + bytes.size() > kMaxUserParameters) {
      return problem(statement.line, "Ext_User_Prm_Data_Const needs (offset) = bytes, 237 at most");
    }
    constants_.push_back({moduleIndex(), *offset, std::move(bytes)});
  }

  /// The constants of `module` (or of the station) over `target`.
  void layConstants(std::optional<std::size_t> module, std::vector<std::uint8_t>& target) const {
    for (const Constants& constants : constants_) {
      if (constants.module != module) continue;
      const std::size_t end = constants.offset + constants.bytes.size();
      if (target.size() < end) target.resize(end, 0);
      std::copy(constants.bytes.begin(), constants.bytes.end(),
                target.begin() + static_cast<std::ptrdiff_t>(constants.offset));
    }
  }

  /// "19.2_supp" and "MaxTsdr_19.2".
  bool takeRate(const GsdStatement& statement) {
    for (const RateName& rate : kRates) {
      const bool supported = statement.key == std::string{rate.name} + "_supp";
      if (!supported && statement.key != std::string{"maxtsdr_"} + rate.name) continue;
      GsdRate& entry = rateEntry(rate.bits_per_second);
      unsigned value = 0;
      if (!takeNumber(statement, supported ? 1 : 65'535, value)) return true;
      if (supported) {
        entry.supported = value != 0;
      } else {
        entry.max_tsdr_bits = value;
      }
      return true;
    }
    return false;
  }

  GsdRate& rateEntry(std::uint32_t bits_per_second) {
    for (GsdRate& entry : file_.rates) {
      if (entry.bits_per_second == bits_per_second) return entry;
    }
    file_.rates.push_back({bits_per_second, false, 0});
    return file_.rates.back();
  }

  void takeKey(const GsdStatement& statement) {
    unsigned number = 0;
    const std::string& key = statement.key;
    if (key == "vendor_name") {
      takeText(statement, file_.vendor);
    } else if (key == "model_name") {
      takeText(statement, file_.model);
    } else if (key == "ident_number") {
      if (takeNumber(statement, 0xFFFF, number)) file_.ident_number = static_cast<std::uint16_t>(number);
    } else if (key == "user_prm_data") {
      takeParameters(statement);
    } else if (key == "min_slave_intervall" || key == "min_slave_interval") {
      if (takeNumber(statement, 65'535, number)) file_.min_slave_interval = number * kIntervalUnit;
    } else if (key == "c1_response_timeout") {
      if (takeNumber(statement, 65'535, number)) file_.c1_response_timeout = number * kTimeoutUnit;
    } else if (!takeFlag(statement)) {
      takePlainNumber(statement);
    }
  }

  bool takeFlag(const GsdStatement& statement) {
    const std::array<std::pair<const char*, bool*>, 6> flags{{{"auto_baud_supp", &file_.auto_baud},
                                                              {"sync_mode_supp", &file_.sync_supported},
                                                              {"freeze_mode_supp", &file_.freeze_supported},
                                                              {"modular_station", &file_.modular},
                                                              {"dpv1_slave", &file_.dpv1},
                                                              {"c1_read_write_supp", &file_.c1_read_write}}};
    for (const auto& flag : flags) {
      if (statement.key != flag.first) continue;
      unsigned value = 0;
      if (takeNumber(statement, 1, value)) *flag.second = value != 0;
      return true;
    }
    return false;
  }

  /// Keys that are none of these are of no interest.
  void takePlainNumber(const GsdStatement& statement) {
    const std::array<std::pair<const char*, unsigned*>, 9> numbers{
        {{"gsd_revision", &file_.revision},
         {"max_module", &file_.max_modules},
         {"max_input_len", &file_.max_input_length},
         {"max_output_len", &file_.max_output_length},
         {"max_data_len", &file_.max_data_length},
         {"max_diag_data_len", &file_.max_diagnosis_length},
         {"max_user_prm_data_len", &file_.max_user_parameters},
         {"user_prm_data_len", &parameter_length_},
         {"c1_max_data_len", &file_.c1_max_length}}};
    for (const auto& number : numbers) {
      if (statement.key != number.first) continue;
      takeNumber(statement, kMaxNumber, *number.second);
      if (number.second == &parameter_length_) parameter_line_ = statement.line;
      return;
    }
  }

  void takeText(const GsdStatement& statement, std::string& text) {
    std::string rest;
    if (!gsdQuoted(statement.value, text, rest)) problem(statement.line, statement.key + " without quotes");
  }

  bool takeNumber(const GsdStatement& statement, unsigned limit, unsigned& number) {
    const auto value = gsdNumber(statement.value, limit);
    if (value) {
      number = *value;
      return true;
    }
    problem(statement.line,
            statement.key + " = \"" + statement.value + "\": expected a number of at most " + std::to_string(limit));
    return false;
  }

  void takeParameters(const GsdStatement& statement) {
    std::vector<std::uint8_t> bytes;
    if (!gsdBytes(statement.value, bytes) || bytes.size() > kMaxUserParameters) {
      return problem(statement.line, "User_Prm_Data is no list of at most 237 bytes");
    }
    if (file_.user_parameters.size() < bytes.size()) file_.user_parameters.resize(bytes.size(), 0);
    std::copy(bytes.begin(), bytes.end(), file_.user_parameters.begin());
  }

  /// Defaults lie over constants, and these over User_Prm_Data, wherever each stands. User_Prm_Data_Len and
  /// Ext_Module_Prm_Data_Len are lengths; bytes nobody gave are zero.
  void finishParameters() {
    layConstants(std::nullopt, file_.user_parameters);
    parameters_.lay(std::nullopt, file_.user_parameters);
    for (std::size_t i = 0; i < file_.modules.size(); ++i) {
      std::vector<std::uint8_t>& bytes = file_.modules[i].user_parameters;
      layConstants(i, bytes);
      parameters_.lay(i, bytes);
      bytes.resize(std::max<std::size_t>(bytes.size(), module_lengths_[i]), 0);
    }
    if (parameter_length_ == 0) return;
    if (parameter_length_ > kMaxUserParameters) return problem(parameter_line_, "User_Prm_Data_Len is above 237");
    if (file_.user_parameters.size() > parameter_length_) {
      return problem(parameter_line_, "User_Prm_Data_Len is " + std::to_string(parameter_length_) + ", but there are " +
                                          std::to_string(file_.user_parameters.size()) + " bytes: all are kept");
    }
    file_.user_parameters.resize(parameter_length_, 0);
  }

  void problem(std::size_t line, const std::string& text) { file_.problems.push_back({line, text}); }

  GsdFile file_;
  GsdParameters parameters_{file_.problems};
  std::vector<Constants> constants_;
  std::vector<unsigned> module_lengths_;  // Ext_Module_Prm_Data_Len
  bool seen_start_ = false;
  bool module_ = false;
  std::size_t module_line_ = 0;
  std::string skip_until_;
  std::size_t skip_from_ = 0;
  unsigned parameter_length_ = 0;
  std::size_t parameter_line_ = 1;
};

}  // namespace

const GsdModule* GsdFile::module(const std::string& name) const noexcept {
  const GsdModule* found = nullptr;
  for (const GsdModule& module : modules) {
    if (module.name != name) continue;
    if (found != nullptr) return nullptr;
    found = &module;
  }
  return found;
}

std::uint32_t GsdFile::maxTsdrBits(std::uint32_t bits_per_second) const noexcept {
  for (const GsdRate& rate : rates) {
    if (rate.bits_per_second == bits_per_second) return rate.max_tsdr_bits;
  }
  return 0;
}

GsdFile parseGsd(const std::string& text) {
  return GsdReader{}.read(text);
}

}  // namespace nord_driver::profibus
