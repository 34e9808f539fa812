// Declares the transports of this package to pluginlib.
#include <pluginlib/class_list_macros.hpp>

#include "nord_driver/transport/canopen.h"
#include "nord_driver/transport/profibus_dp.h"

PLUGINLIB_EXPORT_CLASS(nord_driver::CanopenTransport, nord_driver::Transport)
PLUGINLIB_EXPORT_CLASS(nord_driver::ProfibusDpTransport, nord_driver::Transport)
