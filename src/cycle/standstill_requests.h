// Carries out what users ask of drives that stand still: acknowledging faults and choosing a parameter set.
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cycle/completion_queue.h"
#include "cycle/request.h"
#include "drive/drive.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Neither moves anything, so the drives of a base may be asked one by one. Each cycle: `handleRequest` for what has
/// come, after the exchange `update`, then `pollCompletion`. A drive does one thing of a kind at a time: who asks for a
/// second meanwhile is refused, and never answered by the outcome of the first.
class StandstillRequests {
 public:
  /// `drives` must outlive the object and not move.
  /// `modules`: drives with the same number are behind the same bus module; may be empty.
  StandstillRequests(std::vector<drive::Drive>& drives, std::vector<std::string> names,
                     std::vector<std::optional<std::size_t>> modules = {});

  /// kAcknowledge and kSelectParameterSet.
  void handleRequest(const Request& request, Instant now) noexcept;
  void update(Instant now) noexcept;
  std::optional<Completion> pollCompletion() noexcept { return completions_.poll(); }

 private:
  struct Job {
    Request request;
    Instant deadline{};
    std::uint32_t token = 0;   // what the drives' reports carry while they are about this one
    Sentence refusal;          // of a drive that was busy with another's request and was not asked, or has refused
    bool fault_stood = false;  // when it was asked, at one of the drives
    std::bitset<128> ended;    // at these drives: their reports may be about another request meanwhile
  };

  template <typename Action>
  void forEach(const Request& request, Action action) noexcept;
  /// True when the job has ended.
  bool follow(Job& job, Instant now) noexcept;
  /// Its time is over, and `drive` is not done: what was seen of it last.
  Sentence unconfirmed(const Request& request, DriveIndex drive) const noexcept;
  /// What to answer when no fault stands any more.
  const char* acknowledged(const Job& job) noexcept;
  /// A drive with a fault behind the same bus module as those of the request, and not one of them.
  std::optional<DriveIndex> faultedNeighbour(const Request& request) const noexcept;
  /// What another's request keeps the drive busy with, in words; empty when nothing does.
  Sentence othersRequest(RequestKind kind, DriveIndex drive) const noexcept;
  const drive::RequestReport& reportOf(const Request& request, DriveIndex drive) const noexcept;

  std::vector<drive::Drive>& drives_;
  std::vector<std::string> names_;
  std::vector<std::optional<std::size_t>> modules_;
  FixedVector<Job, 16> jobs_;
  std::uint32_t last_token_ = 0;
  CompletionQueue<48> completions_;
};

}  // namespace nord_driver::cycle
