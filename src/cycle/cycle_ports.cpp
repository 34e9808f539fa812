#include "cycle/cycle_ports.h"

#include <errno.h>
#include <time.h>

#include <cmath>

namespace nord_driver::cycle {

CyclePorts::CyclePorts(std::size_t drive_count)
    : positions_written_(drive_count),
      words_written_(drive_count),
      drives_moved_(drive_count),
      snapshot_(CycleSnapshot{drive_count}) {
  for (std::size_t i = 0; i < drive_count; ++i) {
    drive_commands_.push_back(std::make_unique<LatestValue<JointCommand>>());
    positions_.push_back(std::make_unique<LatestValue<PositionCommand>>());
    words_.push_back(std::make_unique<LatestValue<WordCommands>>());
  }
  sem_init(&completed_, 0, 0);
}

CyclePorts::~CyclePorts() {
  sem_destroy(&completed_);
}

bool CyclePorts::commandBase(const TwistCommand& command) {
  if (!robot::isFinite(command.twist)) return false;
  const std::lock_guard<std::mutex> lock(writers_);
  if (command.twist != robot::Twist2d{}) base_moved_ = command.received;
  TwistCommand kept = command;
  kept.moved = base_moved_;
  base_command_.write(kept);
  return true;
}

bool CyclePorts::commandDrive(DriveIndex drive, const JointCommand& command) {
  if (!std::isfinite(command.velocity)) return false;
  const std::lock_guard<std::mutex> lock(writers_);
  if (command.velocity != 0.0) drives_moved_.at(drive) = command.received;
  JointCommand kept = command;
  kept.moved = drives_moved_.at(drive);
  drive_commands_.at(drive)->write(kept);
  return true;
}

bool CyclePorts::commandPosition(DriveIndex drive, double target) {
  if (!std::isfinite(target)) return false;
  const std::lock_guard<std::mutex> lock(writers_);
  PositionCommand& newest = positions_written_.at(drive);
  newest.target = target;
  newest.element.reset();
  newest.increments = 0.0;
  ++newest.number;
  positions_.at(drive)->write(newest);
  return true;
}

void CyclePorts::commandElement(DriveIndex drive, std::uint8_t element) {
  const std::lock_guard<std::mutex> lock(writers_);
  PositionCommand& newest = positions_written_.at(drive);
  newest.element = element;
  newest.increments = 0.0;
  ++newest.number;
  positions_.at(drive)->write(newest);
}

bool CyclePorts::commandIncrement(DriveIndex drive, double increment) {
  if (!std::isfinite(increment) || std::fabs(increment) > kMostIncrement) return false;
  const std::lock_guard<std::mutex> lock(writers_);
  PositionCommand& newest = positions_written_.at(drive);
  newest.increments += increment;
  ++newest.increased;
  positions_.at(drive)->write(newest);
  return true;
}

bool CyclePorts::commandSetpoint(DriveIndex drive, std::size_t index, double value, Instant received) {
  if (!std::isfinite(value)) return false;
  const std::lock_guard<std::mutex> lock(writers_);
  WordCommands& all = words_written_.at(drive);
  WordCommand& command = all.setpoints.at(index);
  command.value = value;
  command.received = received;
  command.given = true;
  if (value != 0.0) command.moved = received;
  words_.at(drive)->write(all);
  return true;
}

void CyclePorts::commandOutput(DriveIndex drive, std::size_t index, bool on, Instant received) {
  const std::lock_guard<std::mutex> lock(writers_);
  WordCommands& all = words_written_.at(drive);
  BitCommand& output = all.outputs.at(index);
  output = {on, received, true, on ? output.off : received};
  words_.at(drive)->write(all);
}

void CyclePorts::tuneBase(const BaseTuning& tuning) {
  const std::lock_guard<std::mutex> lock(writers_);
  base_tuning_.write(tuning);
}

void CyclePorts::commanderConnected(Instant when) {
  const std::lock_guard<std::mutex> lock(writers_);
  commander_.write(when);
}

bool CyclePorts::submit(const Request& request) {
  const std::lock_guard<std::mutex> lock(writers_);
  return requests_.push(request);
}

void CyclePorts::complete(const Completion& completion) noexcept {
  if (completion.id != 0 && completions_.push(completion)) ++unpublished_;
}

void CyclePorts::publish(const CycleSnapshot& snapshot) noexcept {
  snapshot_.write(snapshot);
  for (; unpublished_ > 0; --unpublished_) sem_post(&completed_);
}

// Who only looks does not ask the kernel: there, a wait that is over at once lasts as long as a short sleep.
std::optional<Completion> CyclePorts::waitCompletion(Duration limit) {
  if (limit <= Duration::zero()) return sem_trywait(&completed_) == 0 ? completions_.pop() : std::nullopt;
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  const std::int64_t nanoseconds = until.tv_nsec + limit.count();
  until.tv_sec += static_cast<time_t>(nanoseconds / 1'000'000'000);
  until.tv_nsec = static_cast<long>(nanoseconds % 1'000'000'000);
  while (sem_clockwait(&completed_, CLOCK_MONOTONIC, &until) != 0) {
    if (errno != EINTR) return std::nullopt;
  }
  return completions_.pop();
}

}  // namespace nord_driver::cycle
