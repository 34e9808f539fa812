// One device's voice: its status, and what is told and counted of it.
#pragma once

#include "devicenet/devicenet_event.h"
#include "devicenet/counters.h"
#include "devicenet/node_status.h"
#include "core/node_report.h"

namespace nord_driver::devicenet {

using NodeReport = nord_driver::NodeReport<NodeStatus, Counters, DevicenetEvents>;

}  // namespace nord_driver::devicenet
