// A transport that hands everything on to another one: what stands between the driver and its bus derives from it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "nord_driver/transport/transport.h"

namespace nord_driver::test {

class PassingTransport : public Transport {
 public:
  explicit PassingTransport(std::unique_ptr<Transport> inner) : inner_(std::move(inner)) {}

  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override {
    inner_->configure(bus, drives, cycle_rate);
  }
  void close() noexcept override { inner_->close(); }

  void exchange(const std::vector<profile::ProcessOutput>& outputs,
                std::vector<DriveExchange>& inputs) noexcept override {
    inner_->exchange(outputs, inputs);
  }
  Instant now() const noexcept override { return inner_->now(); }
  void sleepUntil(Instant when) noexcept override { inner_->sleepUntil(when); }
  void setDriveTimeout(Duration timeout) noexcept override { inner_->setDriveTimeout(timeout); }
  void setShutdownTimeout(Duration timeout) noexcept override { inner_->setShutdownTimeout(timeout); }

  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override {
    return inner_->submit(drive, request);
  }
  std::optional<profile::ParameterResult> pollResult() noexcept override { return inner_->pollResult(); }
  profile::ParameterCapabilities parameterCapabilities(DriveIndex drive) const noexcept override {
    return inner_->parameterCapabilities(drive);
  }

  DriveIdentity identity(DriveIndex drive) const override { return inner_->identity(drive); }
  std::uint32_t identNumber(DriveIndex drive) const noexcept override { return inner_->identNumber(drive); }
  bool connected() const noexcept override { return inner_->connected(); }
  BusCounters counters() const noexcept override { return inner_->counters(); }
  DriveNote note(DriveIndex drive) const noexcept override { return inner_->note(drive); }
  Sentence busText() const noexcept override { return inner_->busText(); }
  std::optional<BusEvent> pollEvent() noexcept override { return inner_->pollEvent(); }

 protected:
  Transport& inner() noexcept { return *inner_; }

 private:
  std::unique_ptr<Transport> inner_;
};

}  // namespace nord_driver::test
