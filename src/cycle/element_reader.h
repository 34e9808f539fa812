// Reads an element of a drive's position array (P613), when a user chooses it.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::cycle {

/// What stands in an element, or why nobody knows.
struct ReadElement {
  std::uint8_t element = 0;
  bool known = false;
  std::int32_t raw = 0;  ///< 0.001 revolutions
  Sentence why;
};

/// One at a time, asked for anew with each choice: others may have taught it another position since. An answer to what was
/// asked for before is not taken; its caller puts the next question behind it.
class ElementReader {
 public:
  /// `element`: of P613, from 1. What was asked for before is forgotten.
  void ask(std::uint8_t element) noexcept;
  void forget() noexcept;
  bool isAsked() const noexcept { return element_ != 0; }
  /// 0: none.
  std::uint8_t asked() const noexcept { return element_; }

  /// When it is to be asked for; its id is for the caller to choose.
  std::optional<profile::ParameterRequest> pollRequest() noexcept;
  /// The result of the request handed out last. `drive`: its name, for sentences.
  void handleResult(const profile::ParameterResult& result, const char* drive) noexcept;
  /// Once.
  std::optional<ReadElement> poll() noexcept;

 private:
  std::uint8_t element_ = 0;  // 0: none
  bool waiting_ = false;
  std::optional<ReadElement> read_;
};

}  // namespace nord_driver::cycle
