// What a master must know of a slave before it can parameterise it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/station_address.h"

namespace nord_driver::profibus {

/// Longest data of one exchange, of Set_Prm and of Chk_Cfg (EN 50170-8).
constexpr std::size_t kMaxIoLength = 244;
/// Set_Prm: seven bytes are the standard's, the rest is the user's.
constexpr std::size_t kMaxUserParameters = kMaxIoLength - 7;

/// When the configuration a slave has is read (Get_Cfg) and compared with the configured one.
enum class ConfigurationCheck : std::uint8_t {
  kNever,
  kAfterFault,  ///< in the start-up after a Cfg_Fault, so that both can be told
  kTell,        ///< in every start-up; a difference is told, Chk_Cfg decides
  kRequire      ///< in every start-up; a slave with another configuration is not parameterised
};

struct SlaveConfig {
  StationAddress address;
  std::uint16_t ident_number = 0;
  std::vector<std::uint8_t>
      configuration;  ///< Chk_Cfg bytes as the slave expects them, 1..244; zeros are never stripped
  std::vector<std::uint8_t> user_parameters;  ///< behind the seven standard bytes of Set_Prm, 0..237
  std::size_t output_length = 0;              ///< bytes per exchange to the slave, 0..244, as `configuration` says
  std::size_t input_length = 0;               ///< bytes per exchange from the slave, 0..244, likewise
  Duration watchdog{0};                       ///< 10 ms..650.25 s, a product f1 * f2 * 10 ms; 0 = off
  std::uint8_t min_tsdr_bits = 11;            ///< 11..255; 0 leaves the slave's own value
  std::uint8_t group = 0;                     ///< group bits of Set_Prm
  ConfigurationCheck configuration_check = ConfigurationCheck::kAfterFault;
  /// Acyclic records (DP-V1 class 1): `user_parameters` begin with DPV1_Status_1 to 3, and DPV1_Enable is set.
  bool dpv1 = false;
  Duration record_timeout = std::chrono::seconds{2};  ///< for one response: C1_Response_Timeout of the GSD
  /// True: a slave with another ident number is not parameterised. False: the number it reports is the one it is given.
  bool expect_exact_ident = true;
};

/// Throws std::invalid_argument with a sentence naming the station and what was expected.
void validate(const SlaveConfig& slave, const BusParameters& bus);
/// All of them, and no address twice.
void validate(const std::vector<SlaveConfig>& slaves, const BusParameters& bus);

}  // namespace nord_driver::profibus
