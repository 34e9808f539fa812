// One drive's parameters through the services of the node that has its bus.
#pragma once

#include <ros/callback_queue.h>
#include <ros/service_client.h>
#include <ros/subscriber.h>

#include <functional>
#include <optional>
#include <string>

#include "config/writable_parameters.h"
#include "nord_driver/DriveStatus.h"
#include "tools/drive_nodes.h"

namespace nord_driver::tools {

/// Asks ~<drive>/read_parameter and ~<drive>/write_parameter. What is refused is refused by the node, in its words: it
/// knows whether the drive moves. ros::init() comes before it.
class NodeParameters final : public DriveParameters {
 public:
  /// `node`: with its leading slash. Throws Trouble when it does not offer the services now.
  NodeParameters(const std::string& node, DriveDescription drive);

  ParameterAnswer read(const catalogue::ParameterAddress& address) override;
  ParameterAnswer write(const catalogue::ParameterAccess& access) override;

  /// By the parameters of the node, in its words; they are looked up once.
  std::string whyNotWritten(std::uint16_t number) const override;
  /// As the node tells it now.
  std::string notAtRest() override;
  bool savesSame() const override { return false; }

  const std::string& name() const noexcept override { return drive_.name; }
  profile::Series series() const noexcept override { return drive_.series; }
  DriveIdentity identity() const override { return drive_.identity; }
  const catalogue::DriveCatalogue& known() const noexcept override { return drive_.known; }

 private:
  /// Throws Trouble where the node would make another raw value of what is written.
  void requireSameMeaning(const catalogue::ParameterAccess& access, std::uint8_t set);
  template <typename Service>
  void call(ros::ServiceClient& client, Service& service);
  /// The newest of the drive within two seconds of the first, or the first that is `enough`. Throws Trouble when none comes.
  DriveStatus statusOnce(const std::function<bool(const DriveStatus&)>& enough);
  /// Asked for, or in force; none where the drive does not tell it.
  std::optional<std::uint8_t> setFor(const catalogue::ParameterAccess& access);
  ParameterAnswer silent() const;

  /// What the node lets users write.
  struct Fence {
    WritableParameters writable;
    bool raw = false;  ///< also what is not in the catalogue
  };
  /// Throws Trouble where it is no list as the node takes it.
  Fence fence() const;

  std::string node_;
  DriveDescription drive_;
  mutable std::optional<Fence> fence_;  // none: not looked up yet
  ros::ServiceClient read_, write_;
  std::optional<DriveStatus> heard_;
  ros::CallbackQueue queue_;
  ros::Subscriber status_;  // from the first question on; goes before the queue its callbacks lie in
};

}  // namespace nord_driver::tools
