#include "drive/ram_only_values.h"

#include "profile/parameter_shape.h"

namespace nord_driver::drive {

RamOnlyValues::Key RamOnlyValues::keyOf(const profile::ParameterRequest& request) noexcept {
  Key key;
  key.number = request.number;
  if (profile::hasSets(request.shape)) key.set = request.parameter_set;
  if (profile::isArray(request.shape)) key.index = request.index;
  return key;
}

std::size_t RamOnlyValues::find(const profile::ParameterRequest& request) const noexcept {
  const Key key = keyOf(request);
  std::size_t i = 0;
  while (i < keys_.size() &&
         (keys_[i].number != key.number || keys_[i].set != key.set || keys_[i].index != key.index)) {
    ++i;
  }
  return i;
}

bool RamOnlyValues::holds(const profile::ParameterRequest& request) const noexcept {
  return overflow_ || find(request) < keys_.size();
}

void RamOnlyValues::mark(const profile::ParameterRequest& request) noexcept {
  if (!holds(request) && !keys_.push_back(keyOf(request))) overflow_ = true;
}

void RamOnlyValues::unmark(const profile::ParameterRequest& request) noexcept {
  const std::size_t i = find(request);
  if (i == keys_.size()) return;
  keys_[i] = keys_[keys_.size() - 1];
  keys_.resize(keys_.size() - 1);
}

}  // namespace nord_driver::drive
