// The words of the parameter channel's error numbers (BU 2700 6.5.1.1, BU 0020 7.5.1).
#include "profile/pkw.h"

namespace nord_driver::profile {

namespace {

struct ErrorRow {
  std::uint16_t number;
  ParameterReason reason;
  const char* meaning;
};

constexpr ErrorRow kErrors[] = {
    {0, ParameterReason::kNoSuchParameter, "the inverter has no parameter of this number"},
    {1, ParameterReason::kReadOnly,
     "the parameter cannot be changed (it is read-only, or P509 does not select this bus)"},
    {2, ParameterReason::kOutOfLimits, "the value is beyond the lower or upper limit"},
    {3, ParameterReason::kNoSuchElement, "the sub-index is wrong"},
    {4, ParameterReason::kNotIndexed, "the parameter is no array"},
    {5, ParameterReason::kWrongType, "the data type is wrong"},
    {6, ParameterReason::kOutOfLimits, "the parameter can only be reset (only 0 may be written)"},
    {7, ParameterReason::kReadOnly, "the description element cannot be changed"},
    {9, ParameterReason::kOther, "there are no description data (acyclic: a READ came without a WRITE before it)"},
    {101, ParameterReason::kNoInverter, "the addressed inverter does not exist"},
    {102, ParameterReason::kNoInverter, "the addressed inverter does not exist"},
    {103, ParameterReason::kNotNow, "the addressed inverter exists, but another bus participant blocks the access"},
    {201, ParameterReason::kNotSupported, "the order label of the last order is invalid"},
    {202, ParameterReason::kUnreadable,
     "the internal answer label cannot be represented: the answer does not fit this process data type, use PPO 2 or "
     "acyclic access"},
};

}  // namespace

Sentence pkwErrorText(std::uint16_t number) noexcept {
  const char* meaning = "an error number the manuals do not list";
  for (const ErrorRow& row : kErrors) {
    if (row.number == number) meaning = row.meaning;
  }
  Sentence text;
  text.format("PKW error %u, %s", unsigned{number}, meaning);
  return text;
}

ParameterReason pkwReason(std::uint16_t number) noexcept {
  for (const ErrorRow& row : kErrors) {
    if (row.number == number) return row.reason;
  }
  return ParameterReason::kOther;
}

}  // namespace nord_driver::profile
