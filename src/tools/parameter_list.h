// What nord_param can tell without a bus: the drives of a configuration and what is known of their parameters.
#pragma once

#include <string>

#include "catalogue/drive_catalogue.h"
#include "nord_driver/transport/transport.h"
#include "tools/tool_config.h"

namespace nord_driver::tools {

/// All drives of the configuration, and a line for each parameter known of them. `transport` is configured.
std::string listText(const ToolConfig& config, const Transport& transport, const catalogue::Catalogues& catalogues);

/// Everything known of one parameter of every kind of drive in the configuration; `name` is its number or name. Throws
/// UsageError when no drive has it.
std::string descriptionText(const ToolConfig& config, const Transport& transport,
                            const catalogue::Catalogues& catalogues, const std::string& name);

/// One parameter: range, default, elements, names of values and bits, notes and sources.
std::string descriptionOf(const catalogue::ParameterEntry& entry);

/// The same for programs: the drives, and what is known of their parameters, or of the one of that name (empty: all).
/// Throws UsageError when there is no such parameter.
std::string listJson(const ToolConfig& config, const Transport& transport, const catalogue::Catalogues& catalogues,
                     const std::string& name);

}  // namespace nord_driver::tools
