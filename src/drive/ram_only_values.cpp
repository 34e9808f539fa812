#include "drive/ram_only_values.h"

#include "profile/parameter_shape.h"

namespace nord_driver::drive {

RamOnlyValues::Key RamOnlyValues::keyOf(const profile::ParameterRequest& request, bool has_no_sets) noexcept {
  Key key;
  key.number = request.number;
  if (profile::hasSets(request.shape) && !has_no_sets) key.set = request.parameter_set;
  if (profile::isArray(request.shape)) key.index = request.index;
  return key;
}

std::size_t RamOnlyValues::find(const Key& key) const noexcept {
  std::size_t i = 0;
  while (i < keys_.size() &&
         (keys_[i].number != key.number || keys_[i].set != key.set || keys_[i].index != key.index)) {
    ++i;
  }
  return i;
}

// By whichever set it is addressed, one without sets is the same.
bool RamOnlyValues::holds(const profile::ParameterRequest& request) const noexcept {
  return overflow_ || find(keyOf(request, false)) < keys_.size() || find(keyOf(request, true)) < keys_.size();
}

void RamOnlyValues::mark(const profile::ParameterRequest& request, bool has_no_sets) noexcept {
  const Key key = keyOf(request, has_no_sets);
  if (find(key) == keys_.size() && !keys_.push_back(key)) overflow_ = true;
}

void RamOnlyValues::unmark(const profile::ParameterRequest& request, bool has_no_sets) noexcept {
  const std::size_t i = find(keyOf(request, has_no_sets));
  if (i == keys_.size()) return;
  keys_[i] = keys_[keys_.size() - 1];
  keys_.resize(keys_.size() - 1);
}

}  // namespace nord_driver::drive
