// One node's voice: its status, and what is told and counted of it.
#pragma once

#include "canopen/canopen_event.h"
#include "canopen/counters.h"
#include "canopen/node_status.h"
#include "core/node_report.h"

namespace nord_driver::canopen {

using NodeReport = nord_driver::NodeReport<NodeStatus, Counters, CanopenEvents>;

}  // namespace nord_driver::canopen
