// A transport with a fault planted in it: what a driver that errs would send or read. The campaign has to catch each.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "support/passing_transport.h"

namespace nord_driver::test {

/// Hands everything on, but what `change` makes of the words for the drives and of those from them.
class PlantedTransport final : public PassingTransport {
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
      : PassingTransport(std::move(inner)), plant_(std::move(plant)) {}

  void exchange(const Outputs& outputs, Inputs& inputs) noexcept override {
    sent_ = outputs;
    if (plant_.outputs) plant_.outputs(sent_);
    inner().exchange(sent_, inputs);
    if (plant_.inputs) plant_.inputs(inputs);
  }
  std::optional<profile::ParameterResult> pollResult() noexcept override {
    while (auto result = inner().pollResult()) {
      if (!plant_.result || plant_.result(*result)) return result;
    }
    return std::nullopt;
  }

 private:
  Plant plant_;
  Outputs sent_;
};

}  // namespace nord_driver::test
