#include "trace/process_data_history.h"

#include <algorithm>

namespace nord_driver::trace {

namespace {

constexpr std::size_t kDepth = 1024 + kTracedCycles;

}  // namespace

ProcessDataHistory::ProcessDataHistory(std::size_t drive_count)
    : drive_count_(std::max<std::size_t>(drive_count, 1)), ring_(drive_count_ * kDepth) {}

void ProcessDataHistory::record(const std::vector<profile::ProcessOutput>& outputs,
                                const std::vector<DriveExchange>& inputs, Instant now) noexcept {
  const std::uint64_t cycle = cycles();
  for (std::size_t drive = 0; drive < outputs.size(); ++drive) {
    ProcessDataRecord record;
    record.time = now;
    record.cycle = cycle;
    record.drive = static_cast<std::uint32_t>(drive);
    record.answered = inputs[drive].inverter_answers;
    record.output = outputs[drive];
    record.input = inputs[drive].input;
    ring_.push(record);
  }
}

std::vector<ProcessDataRecord> ProcessDataHistory::upTo(std::uint64_t last) const {
  const std::uint64_t first = last > kTracedCycles ? last - kTracedCycles : 0;
  std::vector<ProcessDataRecord> records;
  for (std::uint64_t number = first * drive_count_; number < (last + 1) * drive_count_; ++number) {
    if (const auto record = ring_.read(number)) records.push_back(*record);
  }
  return records;
}

}  // namespace nord_driver::trace
