// nord_param image: the words of a gateway's image. Writes nothing.
#include "tools/image_command.h"

#include "tools/commands/commands.h"

namespace nord_driver::tools {

namespace {

class ImageCommand final : public ParamCommand {
 public:
  Command& addTo(CommandLine& line) override {
    namespace po = boost::program_options;
    Command& command =
        line.addCommand("image", "show the words of a gateway's image and those that change; writes nothing");
    command.options.add_options()("once", po::bool_switch(&options_.once), "show it once, and end")(
        "json", po::bool_switch(&options_.json), "one JSON object a line")(
        "count", po::value(&count_)->value_name("COUNT"),
        "so many words at least; without it up to the last one of a drive");
    return command;
  }

  int run(ParamProgram& program) override {
    options_.words = static_cast<std::size_t>(count_.value);
    options_.patience = program.timeout();
    return showImage(program.file(), program.transport(), options_, program.endAsked()) ? kDone : kFailed;
  }

 private:
  ImageOptions options_;
  WholeNumber<1, 256> count_;  // 0: not given
};

}  // namespace

std::unique_ptr<ParamCommand> makeImageCommand() {
  return std::make_unique<ImageCommand>();
}

}  // namespace nord_driver::tools
