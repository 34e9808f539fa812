// Declares the transports of this package to pluginlib.
#include <pluginlib/class_list_macros.hpp>

#include "transport/canopen/canopen.h"
#include "transport/devicenet/devicenet.h"
#include "transport/interbus/interbus.h"
#include "transport/profibus/profibus_dp.h"
#include "transport/profibus/profibus_ms2.h"

PLUGINLIB_EXPORT_CLASS(nord_driver::CanopenTransport, nord_driver::Transport)
PLUGINLIB_EXPORT_CLASS(nord_driver::DeviceNetTransport, nord_driver::Transport)
PLUGINLIB_EXPORT_CLASS(nord_driver::InterbusTransport, nord_driver::Transport)
PLUGINLIB_EXPORT_CLASS(nord_driver::ProfibusDpTransport, nord_driver::Transport)
PLUGINLIB_EXPORT_CLASS(nord_driver::ProfibusMs2Transport, nord_driver::Transport)
