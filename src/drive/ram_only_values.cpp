#include "drive/ram_only_values.h"

namespace nord_driver::drive {

using profile::ParameterShape;

RamOnlyValues::Key RamOnlyValues::keyOf(const ParameterTask& task) noexcept {
  const bool has_sets = task.shape == ParameterShape::kPerSet || task.shape == ParameterShape::kArrayPerSet;
  const bool is_array = task.shape == ParameterShape::kArray || task.shape == ParameterShape::kArrayPerSet;
  Key key;
  key.number = task.number;
  if (has_sets) key.set = task.set;
  if (is_array) key.index = task.index;
  return key;
}

std::size_t RamOnlyValues::find(const ParameterTask& task) const noexcept {
  const Key key = keyOf(task);
  std::size_t i = 0;
  while (i < keys_.size() &&
         (keys_[i].number != key.number || keys_[i].set != key.set || keys_[i].index != key.index)) {
    ++i;
  }
  return i;
}

bool RamOnlyValues::holds(const ParameterTask& task) const noexcept {
  return overflow_ || find(task) < keys_.size();
}

void RamOnlyValues::mark(const ParameterTask& task) noexcept {
  if (!holds(task) && !keys_.push_back(keyOf(task))) overflow_ = true;
}

void RamOnlyValues::unmark(const ParameterTask& task) noexcept {
  const std::size_t i = find(task);
  if (i == keys_.size()) return;
  keys_[i] = keys_[keys_.size() - 1];
  keys_.resize(keys_.size() - 1);
}

}  // namespace nord_driver::drive
