#include "tools/commands/commands.h"

namespace nord_driver::tools {

std::vector<std::unique_ptr<ParamCommand>> paramCommands() {
  std::vector<std::unique_ptr<ParamCommand>> commands;
  commands.push_back(makeListCommand());
  commands.push_back(makeReadCommand());
  commands.push_back(makeWriteCommand());
  commands.push_back(makeDumpCommand());
  commands.push_back(makeCompareCommand());
  commands.push_back(makeDiffCommand());
  commands.push_back(makeRestoreCommand());
  commands.push_back(makeWatchCommand());
  commands.push_back(makeScanCommand());
  commands.push_back(makeScopeCommand());
  commands.push_back(makeFaultsCommand());
  commands.push_back(makeCheckCommand());
  commands.push_back(makeImageCommand());
  commands.push_back(makeCheckConfigCommand());
  return commands;
}

}  // namespace nord_driver::tools
