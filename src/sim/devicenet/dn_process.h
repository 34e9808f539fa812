// Process data of a module: outputs to its inverters, inputs from them, its own byte. BU 0280 4.2.
#pragma once

#include <array>

#include "sim/devicenet/ac_drive.h"
#include "sim/devicenet/dn_io_message.h"
#include "sim/devicenet/dn_layout.h"

namespace nord_driver::sim {

class DnProcess {
 public:
  static constexpr std::size_t kInverters = DnLayout::kInverters;

  /// It must outlive the process data.
  void connect(std::size_t place, DriveUnit& drive) noexcept;
  DriveUnit* drive(std::size_t place) noexcept { return places_[place].drive; }
  /// Connected, linked, with mains.
  bool present(std::size_t place) const noexcept;

  struct Taken {
    bool valid = false;  ///< a control word with bit 10 = 1 was among them
    bool zero = false;   ///< one without bit 10 followed one with it
  };
  /// Outputs of the length the layout has. `locked`: the module is in its time-out.
  Taken take(ByteView outputs, const DnLayout& layout, bool locked) noexcept;
  /// The outputs as they were taken last.
  const DnProcessBytes& outputs() const noexcept { return outputs_; }
  DnProcessBytes inputs(const DnLayout& layout) const noexcept;
  /// Commands of class 41 and 42 for one inverter: `acDrive(place).command`.
  AcDrive& acDrive(std::size_t place) noexcept { return places_[place].ac; }
  Taken commit(std::size_t place, bool locked) noexcept;

  /// The master may look before it commands.
  void beginExchange() noexcept;
  void forget() noexcept;

  void setInputs(std::uint8_t inputs) noexcept { module_inputs_ = inputs & 0x0Fu; }
  std::uint8_t moduleInputs() const noexcept { return module_inputs_; }
  std::uint8_t outputByte() const noexcept { return output_byte_; }
  void clearOutputByte() noexcept { output_byte_ = 0; }

  Word lastControl(std::size_t place) const noexcept { return places_[place].data.control; }
  const ProcessData& lastData(std::size_t place) const noexcept { return places_[place].data; }

 private:
  struct Place {
    DriveUnit* drive = nullptr;
    AcDrive ac;
    ProcessData data;
    bool valid_seen = false;
    bool third_before_second = false;

    /// Which value (0 to 2) the word `n` behind control or status word is, of `count` ones.
    unsigned valueAt(unsigned n, std::size_t count) const noexcept {
      return third_before_second && count == 3 && n > 0 ? 3 - n : n;
    }
  };
  Taken hand(Place& place, bool there, bool locked) noexcept;

  std::array<Place, kInverters> places_{};
  DnProcessBytes outputs_;
  std::uint8_t module_inputs_ = 0;
  std::uint8_t output_byte_ = 0;
};

}  // namespace nord_driver::sim
