// What the EDS file of a DeviceNet device says that a scanner needs: who it is, and what process data it has.
//
// The format is that of CIP (volume 1, chapter 7), which is not free; it is read here as the files of makers show it:
// sections in brackets, entries "Key = field, field, ...;" that may go over several lines, text in quotes, and comments
// from a dollar sign to the end of the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nord_driver::devicenet {

/// Something in the file that is not as it should be. It was left out, and the rest was read.
struct EdsProblem {
  std::size_t line = 0;  ///< from 1
  std::string text;
};

struct EdsNumber {
  std::uint32_t value = 0;
  std::size_t line = 0;
};

/// Bits of the kinds of connections, as [IO_Info] has them.
namespace eds_kind {
constexpr std::uint32_t kPoll = 0x01;
constexpr std::uint32_t kStrobe = 0x02;
constexpr std::uint32_t kChangeOfState = 0x04;
constexpr std::uint32_t kCyclic = 0x08;
}  // namespace eds_kind

/// InputN: what the device produces; OutputN: what it consumes.
struct EdsProcessData {
  std::size_t line = 0;
  std::uint32_t bytes = 0;
  std::uint32_t kinds = 0;                 ///< by which it can be exchanged
  std::optional<std::uint8_t> assembly{};  ///< the instance of class 4 in its path
};

struct EdsFile {
  std::string product;
  std::optional<EdsNumber> vendor_id, device_type, product_code;  ///< each 0..65535
  /// The line of [IO_Info]; nothing: the file does not tell of process data.
  std::optional<std::size_t> io_line;
  /// PollInfo and so on: bits of the kinds with which each can be together.
  std::optional<EdsNumber> poll, strobe, change_of_state, cyclic;
  std::vector<EdsProcessData> inputs, outputs;
  std::vector<EdsProblem> problems;  ///< by line
};

/// Reads the text of a file. Never throws for what is in the text: see `problems`.
EdsFile parseEds(const std::string& text);

}  // namespace nord_driver::devicenet
