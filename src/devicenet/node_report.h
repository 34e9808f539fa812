// One device's voice: its status, and what is told and counted of it.
#pragma once

#include "core/node_report.h"
#include "devicenet/counters.h"
#include "devicenet/devicenet_event.h"
#include "devicenet/node_status.h"

namespace nord_driver::devicenet {

using NodeReport = nord_driver::NodeReport<NodeStatus, Counters, DevicenetEvents>;

}  // namespace nord_driver::devicenet
