#include "campaign/invariant.h"

#include "campaign/answer_invariants.h"
#include "campaign/following_invariants.h"
#include "campaign/motion_invariants.h"
#include "campaign/position_invariants.h"
#include "campaign/report_invariants.h"

namespace nord_driver::test {

std::vector<std::unique_ptr<Invariant>> allInvariants() {
  std::vector<std::unique_ptr<Invariant>> all;
  all.push_back(std::make_unique<NeverOneWheelAlone>());
  all.push_back(std::make_unique<NothingEnabledUnasked>());
  all.push_back(std::make_unique<NobodyUnknownEnabled>());
  all.push_back(std::make_unique<TurnsOnlyAsCommanded>());
  all.push_back(std::make_unique<FollowsItsCommand>());
  all.push_back(std::make_unique<TurnsTheCommandedWay>());
  all.push_back(std::make_unique<SetpointWithinRamp>());
  all.push_back(std::make_unique<AxisMovesOnlyAsAsked>());
  all.push_back(std::make_unique<AxisWithinItsLimits>());
  all.push_back(std::make_unique<AxisTargetsCount>());
  all.push_back(std::make_unique<AxisPositionTrue>());
  all.push_back(std::make_unique<OdometryContinuous>());
  all.push_back(std::make_unique<MotionToldAsItIs>());
  all.push_back(std::make_unique<PoseAsTheWheels>());
  all.push_back(std::make_unique<EveryLossNamed>());
  all.push_back(std::make_unique<EveryCallAnswered>());
  all.push_back(std::make_unique<NoCallAnsweredTwice>());
  all.push_back(std::make_unique<AnswersAreTrue>());
  return all;
}

}  // namespace nord_driver::test
