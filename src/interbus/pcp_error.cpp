#include "interbus/pcp_error.h"

namespace nord_driver::interbus {

namespace {

constexpr int kAny = -1;

struct ErrorRow {
  int error_class;
  int code;
  int additional;
  const char* meaning;
};

// The first row that fits.
constexpr ErrorRow kErrors[] = {
    {1, kAny, kAny, "the connection to the device was ended, or is in another state"},
    {2, kAny, kAny, "the device does not know what was asked for (application reference)"},
    {3, kAny, kAny, "the object directory does not know what was asked for"},
    {4, kAny, kAny, "the device has no room left for this"},
    {5, 1, kAny, "the service does not fit the present state"},
    {5, kAny, kAny, "the device does not take this service as it was sent"},
    {6, 1, kAny, "the object is invalid"},
    {6, 2, kAny, "a hardware fault of the device prevents it"},
    {6, 3, kAny, "access is denied: the parameter is read-only, or P509 does not select this bus"},
    {6, 4, kAny, "the address in the device is invalid"},
    {6, 5, 0x11, "the sub-index is wrong"},
    {6, 5, 0x12, "the data type is wrong: the value is too long"},
    {6, 5, 0x13, "the data type is wrong: the value is too short"},
    {6, 5, kAny, "the service has an invalid parameter"},
    {6, 6, kAny, "the object is no parameter"},
    {6, 7, kAny, "the inverter has no parameter of this number"},
    {6, 8, kAny, "the data type is wrong"},
    {7, kAny, kAny, "the object directory of the device refuses it"},
    {8, 0, 0x20, "the device cannot do it at present"},
    {8, 0, 0x21, "the inverter is under local control: does P509 select InterBus?"},
    {8, 0, 0x22, "the device's present state does not allow it"},
    {8, 0, 0x30, "the value is beyond the lower or upper limit"},
    {8, 0, 0x31, "the value is above the upper limit"},
    {8, 0, 0x32, "the value is below the lower limit"},
    {8, 0, 0x33, "the value of the sub-index is beyond the lower or upper limit"},
    {8, 0, 0x34, "the value of the sub-index is above the upper limit"},
    {8, 0, 0x35, "the value of the sub-index is below the lower limit"},
    {8, 0, 0x36, "the upper limit of the value is below its lower one"},
    {8, 0, 0x41, "the object cannot be part of the process data"},
    {8, 0, 0x42, "the process data would be too long"},
    {8, 0, 0x43, "the value does not fit other settings of the device"},
    {8, 0, kAny, "the device cannot do it"},
    {9, kAny, kAny, "the master in the gateway refuses it"},
};

bool fits(int row, unsigned value) noexcept {
  return row == kAny || static_cast<unsigned>(row) == value;
}

}  // namespace

const char* pcpErrorMeaning(const PcpError& error) noexcept {
  for (const ErrorRow& row : kErrors) {
    if (fits(row.error_class, error.error_class) && fits(row.code, error.code) &&
        fits(row.additional, error.additional)) {
      return row.meaning;
    }
  }
  return "an error no document lists";
}

}  // namespace nord_driver::interbus
