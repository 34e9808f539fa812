#include "cycle/element_reader.h"

#include "cycle/user_messages.h"

namespace nord_driver::cycle {

namespace {

constexpr std::uint16_t kArray = 613;  // BU 0050 p. 67: an array; whether it has parameter sets is not stated

}  // namespace

void ElementReader::ask(std::uint8_t element) noexcept {
  forget();
  element_ = element;
}

void ElementReader::forget() noexcept {
  element_ = 0;
  waiting_ = false;
  read_.reset();
}

std::optional<profile::ParameterRequest> ElementReader::pollRequest() noexcept {
  if (element_ == 0 || waiting_ || read_) return std::nullopt;
  waiting_ = true;
  profile::ParameterRequest request;
  request.number = kArray;
  request.shape = profile::ParameterShape::kArray;
  request.index = element_;
  return request;
}

void ElementReader::handleResult(const profile::ParameterResult& result, const char* drive) noexcept {
  if (!waiting_) return;
  waiting_ = false;
  // Not asked at all: the question is still to be put.
  if (result.outcome == profile::ParameterOutcome::kBusy) return;
  ReadElement read;
  read.element = element_;
  read.known = result.outcome == profile::ParameterOutcome::kDone;
  read.raw = result.raw;
  if (!read.known) {
    profile::ParameterResult told = result;
    told.refused_number = kArray;
    read.why = parameterMessage(drive, kArray, told);
  }
  read_ = read;
}

std::optional<ReadElement> ElementReader::poll() noexcept {
  const auto read = read_;
  if (read) forget();
  return read;
}

}  // namespace nord_driver::cycle
