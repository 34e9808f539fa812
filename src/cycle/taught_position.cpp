#include "cycle/taught_position.h"

#include <cmath>
#include <cstdint>

namespace nord_driver::cycle {

namespace {

constexpr std::uint16_t kArray = 613;  // BU 0050 p. 67: an array; whether it has parameter sets is not stated
constexpr double kStepsPerRevolution = 1000.0;

}  // namespace

Completion withTaughtElement(Completion taught, const PositionSetup& setup,
                             const std::function<Completion(const profile::ParameterRequest&)>& read) {
  if (!taught.success || !setup.teach) return taught;
  const auto note = [&taught](const char* text) {
    Sentence message;
    message.format("%s%s", taught.message.c_str(), text);
    taught.message = message;
  };
  if (!setup.teach->array) {
    note("; without position/array_bit nobody knows into which element");
    return taught;
  }
  profile::ParameterRequest request;
  request.number = kArray;
  request.shape = profile::ParameterShape::kArray;
  request.index = setup.teach->element;
  const Completion element = read(request);
  FixedText<96> found;
  if (!element.success) {
    found.format("; P613[-%02u] could not be read, so that it is not compared", unsigned{request.index});
    note(found.c_str());
    return taught;
  }
  const std::int32_t wanted = taught.parameter.raw;
  const double tolerance =
      std::fabs(setup.axis.tolerance * setup.axis.scale.revolutions_per_unit) * kStepsPerRevolution;
  taught.success =
      std::fabs(static_cast<double>(element.parameter.raw) - static_cast<double>(wanted)) <= tolerance + 1.0;
  found.format(
      taught.success ? "; P613[-%02u] is %.3f revolutions" : ", but P613[-%02u] is %.3f and not %.3f revolutions",
      unsigned{request.index}, element.parameter.raw / kStepsPerRevolution, wanted / kStepsPerRevolution);
  note(found.c_str());
  return taught;
}

}  // namespace nord_driver::cycle
