// A transport with a fault planted in it: what a driver that errs would send or read. The campaign has to catch each.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "nord_driver/transport/transport.h"

namespace nord_driver::test {

/// Hands everything on, but what `change` makes of the words for the drives and of those from them.
class PlantedTransport final : public Transport {
 public:
  using Outputs = std::vector<profile::ProcessOutput>;
  using Inputs = std::vector<DriveExchange>;
  struct Plant {
    std::function<void(Outputs&)> outputs;
    std::function<void(Inputs&)> inputs;
    /// Parameter results: false, it is lost.
    std::function<bool(profile::ParameterResult&)> result;
  };

  PlantedTransport(std::unique_ptr<Transport> inner, Plant plant)
      : inner_(std::move(inner)), plant_(std::move(plant)) {}

  void configure(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate) override {
    inner_->configure(bus, drives, cycle_rate);
  }
  void close() noexcept override { inner_->close(); }

  void exchange(const Outputs& outputs, Inputs& inputs) noexcept override {
    sent_ = outputs;
    if (plant_.outputs) plant_.outputs(sent_);
    inner_->exchange(sent_, inputs);
    if (plant_.inputs) plant_.inputs(inputs);
  }
  Instant now() const noexcept override { return inner_->now(); }
  void sleepUntil(Instant when) noexcept override { inner_->sleepUntil(when); }
  void setDriveTimeout(Duration timeout) noexcept override { inner_->setDriveTimeout(timeout); }
  void setShutdownTimeout(Duration timeout) noexcept override { inner_->setShutdownTimeout(timeout); }

  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override {
    return inner_->submit(drive, request);
  }
  std::optional<profile::ParameterResult> pollResult() noexcept override {
    while (auto result = inner_->pollResult()) {
      if (!plant_.result || plant_.result(*result)) return result;
    }
    return std::nullopt;
  }
  profile::ParameterCapabilities parameterCapabilities(DriveIndex drive) const noexcept override {
    return inner_->parameterCapabilities(drive);
  }

  DriveIdentity identity(DriveIndex drive) const override { return inner_->identity(drive); }
  bool connected() const noexcept override { return inner_->connected(); }
  BusCounters counters() const noexcept override { return inner_->counters(); }
  DriveNote note(DriveIndex drive) const noexcept override { return inner_->note(drive); }
  Sentence busText() const noexcept override { return inner_->busText(); }
  std::optional<BusEvent> pollEvent() noexcept override { return inner_->pollEvent(); }

 private:
  std::unique_ptr<Transport> inner_;
  Plant plant_;
  Outputs sent_;
};

}  // namespace nord_driver::test
