// What the campaign needs of a simulated robot, whatever bus it is on. Another bus is one more of these.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "campaign/acts.h"
#include "campaign/scenario.h"
#include "nord_driver/core/time.h"
#include "sim/drive_unit.h"
#include "system/driven_robot.h"

namespace nord_driver::test {

class CampaignRig {
 public:
  virtual ~CampaignRig() = default;

  virtual DrivenRobot& robot() = 0;
  /// After the first cycle, with which the bus is made: what a user has set at the drives.
  virtual void setUp() {}
  virtual sim::DriveUnit& unit(DriveIndex drive) = 0;
  /// "no rule broken", or which ones of the bus. Where something kept the one side from hearing the other, or the driver
  /// began anew, those are left out that nobody can keep who does not know what the other side knows: a control word with
  /// bit 10 = 0 to a drive that was commanded before (what it must not do to one that turns is an invariant), words to a
  /// module that has forgotten its connection, an order whose answer was lost.
  virtual std::string referee(bool undisturbed) = 0;
  /// Nobody runs the driver meanwhile.
  virtual void passWithoutTheDriver(Duration span) = 0;
  /// What was to be lost and has not been yet is not.
  virtual void endLosses() = 0;
  /// What may happen to this bus.
  virtual const std::vector<Act>& acts() const = 0;

  /// Who sends an answer knows whether it came, and sends it again: nobody else can tell that it was lost.
  virtual bool answersAreRepeated() const { return false; }
  /// Parameters can be read: P105 is, not typed.
  virtual bool readsParameters() const { return true; }
  /// And it may be any, and in each parameter set another one: it is not typed.
  virtual bool readsScaling() const { return true; }
  /// In its other profile an actual value is the speed of the shaft.
  virtual bool tellsShaft() const { return true; }
  /// Its words say whether the terminals have control.
  virtual bool tellsLocalControl() const { return true; }
  /// Its drives can turn backward; where not, that is a command to rest.
  virtual bool reverses() const { return true; }
  /// Stands at the address of a drive, and nobody knows of it; null: there is none.
  virtual sim::DriveUnit* twin() { return nullptr; }
  /// How old the last status word may be before the bus takes it for missing; drive_timeout counts from there.
  virtual Duration silence() const = 0;
  /// How much later than a cycle a change of its state is told.
  virtual Duration toldLate() const { return Duration::zero(); }
  /// The longest time from the last word of a master to the trip of the inverter.
  virtual Duration driveSideTimeout() const = 0;
  /// From the driver's decision to the inverter that has its word, beyond the cycle it is sent in.
  virtual Duration wireLatency() const = 0;
  /// From the end of the last cause to drives that answer again: 2 s, and what the protocol itself demands.
  virtual Duration backWithin() const = 0;
};

/// Which drives one bus module may serve in the rig.
enum class Shares { kNone, kFourOrSingles, kAny };

struct CampaignBus {
  const char* name;
  std::unique_ptr<CampaignRig> (*make)(const Layout& layout, const TransportWrap& wrap);
  const std::vector<Act>& (*acts)();
  unsigned ready_at;  ///< ms after the start: drives that start with the driver are ready to be enabled, as a rule
  Shares shares;
  bool module_carries_axes;  ///< one module may serve drives that go to positions
  unsigned most_with_axes;   ///< drives, where one of them goes to positions
  unsigned axes_ready_at;    ///< ms, as ready_at: what their words mean is read as well
};

CampaignBus profibusCampaign();
CampaignBus canopenCampaign();
CampaignBus devicenetCampaign();
CampaignBus interbusCampaign();

}  // namespace nord_driver::test
