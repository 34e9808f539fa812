// One exchange of images with the server: writes first, then reads, in as few requests as they fit into. Or it only reads.
#pragma once

#include <cstddef>

#include "link/modbus/modbus_connection.h"
#include "link/modbus/register_link.h"

namespace nord_driver::link {

/// The parts of an image, each by its place in the settings.
using PartOrder = FixedVector<std::uint8_t, kMostImageWords>;

/// In which order to write: the part in which most control words stop to allow motion goes first, the others keep
/// their order.
PartOrder stopsFirst(const ModbusSettings& settings, const RegisterImage& written, const RegisterImage& next) noexcept;

class ModbusExchange {
 public:
  /// Both are kept by reference.
  ModbusExchange(const ModbusSettings& settings, ModbusConnection& connection) noexcept
      : settings_(settings), connection_(connection) {}

  /// Writes `outputs`, reads `inputs`. False: `inputs` are of no use, `reason()`. Where the server refuses a part in due form
  /// those behind it that stop a drive are written all the same.
  bool run(const RegisterImage& outputs, RegisterInputs& inputs, const Wakeup& stop) noexcept;
  /// Reads `inputs` alone; by function 3 those that function 23 reads, which cannot read without writing.
  bool look(RegisterInputs& inputs, const Wakeup& stop) noexcept;

  /// A control word would allow no motion, and less than what the server may hold: one that ran stops, or one that goes
  /// down the ramp stops quickly; 0000 does not. What was written on earlier connections counts, too: the server may hold it still.
  bool stops(const RegisterImage& next) const noexcept;

  // What went wrong last in a run() or look() that was false. The connection may have had good answers since.
  const Sentence& reason() const noexcept { return reason_; }
  ModbusTrouble trouble() const noexcept { return trouble_; }
  unsigned exception() const noexcept { return exception_; }  ///< its code, of kException
  /// How many of its requests were refused.
  std::uint64_t refusals() const noexcept { return refusals_; }
  std::uint64_t requests() const noexcept { return requests_; }

 private:
  bool ask(const ModbusRequest& request, const Wakeup& stop) noexcept;
  bool mayWrite(std::size_t part, const RegisterImage& outputs) const noexcept;
  void addWrite(std::size_t part, const RegisterImage& outputs, ModbusRequest& request) noexcept;
  void addRead(std::size_t part, ModbusRequest& request) const noexcept;
  /// What was written, or while nobody knows whether it came through (`answered` is false), of that what runs.
  void note(std::size_t part, const RegisterImage& outputs, bool answered) noexcept;
  void takeRead(std::size_t part, RegisterInputs& inputs) noexcept;
  bool readImage(ModbusFunction function, RegisterInputs& inputs, const Wakeup& stop) noexcept;
  bool moveImages(const RegisterImage& outputs, RegisterInputs& inputs, const Wakeup& stop) noexcept;

  const ModbusSettings& settings_;
  ModbusConnection& connection_;
  // Control words alone, the last that order something, as the server may hold them: an answer that was lost leaves the
  // word that runs.
  RegisterImage written_;
  Sentence reason_;
  ModbusTrouble trouble_ = ModbusTrouble::kNone;
  unsigned exception_ = 0;
  std::uint64_t refusals_ = 0;
  std::uint64_t requests_ = 0;
};

}  // namespace nord_driver::link
