// A driver that begins anew has a new transport, which owes it no answer to what the one before asked. In the campaign
// both have the same one, as the bus behind it is the same: this one keeps their questions apart.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "support/passing_transport.h"

namespace nord_driver::test {

class RebornTransport final : public PassingTransport {
 public:
  explicit RebornTransport(std::unique_ptr<Transport> inner) : PassingTransport(std::move(inner)) {}

  /// What was asked until now is answered to nobody.
  void beginAnew() {
    for (Asked& asked : asked_) asked.forgotten = true;
  }

  bool submit(DriveIndex drive, const profile::ParameterRequest& request) noexcept override {
    profile::ParameterRequest own = request;
    own.id = next_id_;
    if (!inner().submit(drive, own)) return false;
    asked_.push_back({next_id_++, request.id, false});
    return true;
  }
  std::optional<profile::ParameterResult> pollResult() noexcept override {
    while (auto result = inner().pollResult()) {
      const auto asked =
          std::find_if(asked_.begin(), asked_.end(), [&](const Asked& each) { return each.own_id == result->id; });
      if (asked == asked_.end()) return result;  // nobody asked: an invariant of the cycle sees it
      const Asked found = *asked;
      asked_.erase(asked);
      if (found.forgotten) continue;
      result->id = found.id;
      return result;
    }
    return std::nullopt;
  }

 private:
  struct Asked {
    std::uint32_t own_id = 0;
    std::uint32_t id = 0;
    bool forgotten = false;
  };

  std::uint32_t next_id_ = 1;
  std::vector<Asked> asked_;
};

}  // namespace nord_driver::test
