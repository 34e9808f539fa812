// What an EDS or DCF file (the maker's data sheet of a CANopen device as text, CiA 306) says that a master needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nord_driver::canopen {

/// Something in the file that is not as it should be. It was left out, and the rest was read.
struct EdsProblem {
  std::size_t line = 0;  ///< from 1
  std::string text;
};

/// A number, which may have the node id added: "$NODEID+0x180".
struct EdsNumber {
  std::uint64_t value = 0;  ///< negative ones in two's complement
  bool plus_node_id = false;

  std::uint64_t at(std::uint8_t node_id) const noexcept { return value + (plus_node_id ? node_id : 0u); }
};

enum class EdsAccess : std::uint8_t {
  kUnknown,  ///< not told, or none of the words below
  kConst,
  kReadOnly,
  kWriteOnly,
  kReadWrite,
  kReadWriteInput,  ///< "rwr": into TPDOs only
  kReadWriteOutput  ///< "rww": into RPDOs only
};

/// An object without sub-indices, or one sub-index of an object.
struct EdsObject {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string name;
  std::optional<std::uint16_t> data_type;  ///< CiA 301 table 44; makers have types of their own
  EdsAccess access = EdsAccess::kUnknown;
  bool pdo_mapping = false;  ///< can be mapped into a PDO
  /// The value of this device (a DCF's ParameterValue), else the default; numbers only.
  std::optional<EdsNumber> value;
  std::optional<EdsNumber> low_limit, high_limit;
  std::string text;      ///< that value as it is written
  std::size_t line = 0;  ///< of its section

  bool writable() const noexcept {
    return access != EdsAccess::kConst && access != EdsAccess::kReadOnly && access != EdsAccess::kUnknown;
  }
  bool readable() const noexcept { return access != EdsAccess::kWriteOnly && access != EdsAccess::kUnknown; }
};

struct EdsFile {
  std::string vendor, product;
  std::optional<std::uint32_t> vendor_id, product_code, revision_number;
  std::optional<std::uint32_t> device_type;             ///< 1000h
  std::vector<std::uint32_t> bit_rates;                 ///< supported, bits per second, rising
  std::optional<unsigned> receive_pdos, transmit_pdos;  ///< how many there are, as the file tells
  std::optional<std::uint8_t> node_id;                  ///< of a DCF
  std::vector<std::uint16_t> dummies;                   ///< data types that may fill gaps of an RPDO (0001h..0007h)
  std::vector<EdsObject> objects;                       ///< by index and sub-index, rising
  std::vector<EdsProblem> problems;                     ///< by line

  /// Nothing when the file has no such object.
  const EdsObject* object(std::uint16_t index, std::uint8_t sub_index) const noexcept;
  bool hasIndex(std::uint16_t index) const noexcept;
  /// The value of an object for this node; nothing when there is none, or none that is a number.
  std::optional<std::uint64_t> value(std::uint16_t index, std::uint8_t sub_index, std::uint8_t node) const noexcept;
};

/// Reads the text of a file. Never throws for what is in the text: see `problems`.
EdsFile parseEds(const std::string& text);

/// Bits of a data type; nothing for strings, domains and unknown types.
std::optional<unsigned> edsBits(std::uint16_t data_type) noexcept;

}  // namespace nord_driver::canopen
