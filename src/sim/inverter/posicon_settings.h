// What a simulated position control (POSICON) is told, and every choice where the bus manuals are silent.
//
// Of POSICON the manuals of the buses say what travels: BU 0020 6.1.2, 6.2.2, 7.3.4, 7.3.5, 7.3.7; BU 2700 5.3, 6.4.4;
// BU 0220 7.2.1.4; BU 0280 4.2.1.1, 7.2.3; BU 0070 6.1. What the inverter does with it stands in BU 0510 and BU 0710,
// which are not at hand: whatever could be otherwise there is a member of this file.
#pragma once

#include <cstdint>
#include <optional>

namespace nord_driver::sim {

enum class EncoderKind : std::uint8_t {
  kAbsolute,     ///< knows its position without mains
  kIncremental,  ///< counts from 0 at mains on, and has no reference point then
};

/// Functions of digital inputs, for the bus I/O in bits (P480). The list is in the inverters' own manuals (P420): the
/// numbers are the simulator's.
struct PosiconInputs {
  std::int32_t reference_run = 22;
  std::int32_t reference_point = 23;
  std::int32_t teach_in = 24;
  std::int32_t quit_teach_in = 25;
  std::int32_t first_array_bit = 55;  ///< and the five that follow
  std::int32_t reset_position = 61;
};

/// Functions of digital outputs, for bus I/O out bits and bits 10 and 13 of the status word (P481); likewise.
struct PosiconOutputs {
  std::int32_t referenced = 20;
  std::int32_t position_reached = 21;
};

struct PosiconSettings {
  EncoderKind encoder = EncoderKind::kAbsolute;
  double position = 0.0;  ///< revolutions, what the encoder shows at first

  /// Revolutions of the shaft since the simulation began; the switch of the reference point is on there and beyond, in
  /// the direction of the run. Nothing: there is no switch.
  std::optional<double> reference_switch;
  double reference_speed = -5.0;  ///< Hz, how the reference run looks for it; it is left at a fifth of that

  /// One revolution in the codes that have "increment" in their name. SK 700E and 750E: BU 0020 6.1.2, footnote 4. The
  /// others: BU 2700 5.3 calls 10, 15, 23 and 24 "incl.", and has at most 1000 increments in a revolution (6.4.4).
  double older_increments = 8192.0;
  double increments = 1000.0;

  /// Array element by the bits: 1 is P613 [-01], 0 chooses none. True: 0 is [-01].
  bool array_from_zero = false;
  bool torn_words = false;        ///< at first: InverterModel::setTornWords
  std::int32_t slip_fault = 145;  ///< as P700 has it, 14.5: the shaft is farther from its path than P630 allows

  PosiconInputs inputs;
  PosiconOutputs outputs;
};

/// Parameters of the position control. P607, P608 and P613 have sources (BU 2700 6.4.4, BU 0050 p. 67), P610 its
/// meaning (BU 0020 7.3.5); the other numbers are the simulator's, all ranges too.
namespace posicon {
constexpr unsigned kControl = 600;         ///< 0 off, 1 with P105 as top speed, 2 with the setpoint frequency
constexpr unsigned kActualPosition = 601;  ///< shown
constexpr unsigned kSetPosition = 602;     ///< shown
constexpr unsigned kDifference = 603;      ///< shown
constexpr unsigned kRatio = 607;
constexpr unsigned kReduction = 608;
constexpr unsigned kMode = 610;  ///< 0 the bits choose an array element, 1 each adds an increment
constexpr unsigned kWindow = 612;
constexpr unsigned kArray = 613;
constexpr unsigned kMaximum = 615;
constexpr unsigned kMinimum = 616;
constexpr unsigned kSlipError = 630;
constexpr double kResolution = 0.001;  ///< revolutions (BU 0020 7.3.5)
constexpr double kRange = 50'000.0;    ///< revolutions (BU 0020 7.3.5)
}  // namespace posicon

}  // namespace nord_driver::sim
