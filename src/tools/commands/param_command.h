// One command of nord_param: its words on the command line, and what it does. A file per command; commands.cpp lists them.
#pragma once

#include "tools/command_line.h"
#include "tools/commands/param_program.h"

namespace nord_driver::tools {

class ParamCommand {
 public:
  virtual ~ParamCommand() = default;

  /// Adds name, arguments and options; what they fill is a member of the command.
  virtual Command& addTo(CommandLine& line) = 0;
  /// Once the command line was read. Returns the exit code. Throws UsageError and ConfigError before the bus is touched;
  /// Trouble.
  virtual int run(ParamProgram& program) = 0;

 protected:
  ParamCommand() = default;
  ParamCommand(const ParamCommand&) = default;
  ParamCommand& operator=(const ParamCommand&) = default;
};

}  // namespace nord_driver::tools
