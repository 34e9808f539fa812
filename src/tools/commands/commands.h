// Every command of nord_param.
#pragma once

#include <memory>
#include <vector>

#include "tools/commands/param_command.h"

namespace nord_driver::tools {

/// In the order --help shows them.
std::vector<std::unique_ptr<ParamCommand>> paramCommands();

std::unique_ptr<ParamCommand> makeListCommand();
std::unique_ptr<ParamCommand> makeReadCommand();
std::unique_ptr<ParamCommand> makeWriteCommand();
std::unique_ptr<ParamCommand> makeDumpCommand();
std::unique_ptr<ParamCommand> makeCompareCommand();
std::unique_ptr<ParamCommand> makeDiffCommand();
std::unique_ptr<ParamCommand> makeRestoreCommand();
std::unique_ptr<ParamCommand> makeWatchCommand();
std::unique_ptr<ParamCommand> makeScanCommand();
std::unique_ptr<ParamCommand> makeScopeCommand();
std::unique_ptr<ParamCommand> makeFaultsCommand();
std::unique_ptr<ParamCommand> makeImageCommand();
std::unique_ptr<ParamCommand> makeCheckCommand();
std::unique_ptr<ParamCommand> makeCheckConfigCommand();

}  // namespace nord_driver::tools
