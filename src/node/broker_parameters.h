// One drive's parameters as a job in the node asks them: each access waits its turn behind those of the services.
#pragma once

#include <functional>
#include <string>

#include "cycle/cycle_config.h"
#include "cycle/request.h"
#include "state/drive_eeprom.h"
#include "tools/drive_parameters.h"

namespace nord_driver::node {

/// How a request is carried out: RequestBroker::call.
using CarryOut = std::function<cycle::Completion(const cycle::Request&)>;

/// The drive an access goes to, and what is known of it; all of it must outlive the object.
struct BrokerDrive {
  DriveIndex index;
  const cycle::DriveSetup& setup;
  const DriveIdentity& identity;
  const catalogue::DriveCatalogue& known;
  state::DriveEeprom& eeprom;
};

/// One access at a time: the cycle takes eight for a drive, and users have the others.
class BrokerParameters final : public tools::DriveParameters {
 public:
  /// `patience`: of each access.
  BrokerParameters(const BrokerDrive& drive, Duration patience, CarryOut carry_out);

  tools::ParameterAnswer read(const catalogue::ParameterAddress& address) override;
  tools::ParameterAnswer write(const catalogue::ParameterAccess& access) override;

  const std::string& name() const override { return drive_.setup.name; }
  profile::Series series() const override { return drive_.setup.series; }
  DriveIdentity identity() const override { return drive_.identity; }
  const catalogue::DriveCatalogue& known() const override { return drive_.known; }

 private:
  cycle::Completion ask(cycle::RequestKind kind, const catalogue::ParameterAccess& access) const;

  BrokerDrive drive_;
  Duration patience_;
  CarryOut carry_out_;
};

}  // namespace nord_driver::node
