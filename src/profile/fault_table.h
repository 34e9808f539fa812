// What is known of the inverters' fault numbers, as one table: name, likely cause, what to do.
//
// The numbers the bus can cause are described in BU 0020 8.1, BU 0220 6.2 and BU 2700 8.3. Of the others those manuals
// give at most a name; there, cause and remedy are those of the whole group and point to the inverter's own manual.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nord_driver::profile {

struct FaultInfo {
  std::uint16_t
      raw;           ///< of P700 and P701: the printed number times ten (102 = 10.2); from 1000 on P170 of a bus module
  const char* text;  ///< the fault's name
  const char* cause;   ///< a clause
  const char* remedy;  ///< a clause; says so where series or firmware give the number different meanings
};

struct FaultTable {
  const FaultInfo* rows;  ///< in ascending order of their numbers
  std::size_t size;
  const FaultInfo* begin() const noexcept { return rows; }
  const FaultInfo* end() const noexcept { return rows + size; }
};
FaultTable faultTable() noexcept;

/// The row of a number; nullptr when it is not in the table.
const FaultInfo* findFault(std::uint16_t raw) noexcept;

}  // namespace nord_driver::profile
